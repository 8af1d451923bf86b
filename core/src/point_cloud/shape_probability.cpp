// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/nearest_rotation.hpp"
#include "point_cloud/any_of.hpp"
#include "point_cloud/gaussian.hpp"
#include "point_cloud/looks.hpp"
#include "point_cloud/noisy_cloud_data.hpp"
#include "point_cloud/probability_goal.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kCurvedTolerance = 1e-6;  // of the spread: accuracy of distances

bool isConvexShape(const Shape& shape) {
  return !std::holds_alternative<TriangleMesh>(shape) && !std::holds_alternative<PointCloud>(shape);
}

/// m. Distance from a shape's origin to its farthest point; 0 for planes, whose offset is in the
/// points' distances.
double extentOf(const Shape& shape) {
  const BoundingSphere ball = boundingSphere(shape);
  return std::isfinite(ball.radius) ? ball.center.norm() + ball.radius : 0.0;
}

class ShapeQuery {
 public:
  ShapeQuery(const NoisyCloudData& cloud, const Shape& shape, const Isometry3d& cloud_from_shape,
             const ProbabilityGoal& goal)
      : cloud_(cloud),
        shape_(shape),
        cloud_from_shape_(cloud_from_shape),
        shape_from_cloud_(cloud_from_shape.inverse()),
        goal_(goal),
        look_(shape),
        extent_(extentOf(shape)) {
    // The tail this far out is at most its share of kFarTail.
    const double share = kFarTail / static_cast<double>(cloud.points.size());
    while (tailBeyond(enough_) > share) enough_ += 0.125;
  }

  CollisionProbability run() {
    if (lookAtNear()) refine();
    return result();
  }

 private:
  /// m, proven: distance from the shape to a node's box; not computed beyond `enough`.
  double boxDistance(const Aabb& box, double enough) const {
    Isometry3d at = shape_from_cloud_;
    at.translation() = shape_from_cloud_ * box.center();
    const Vector3d half = 0.5 * (box.upper - box.lower);
    const double rounding = roundingAt(at.translation(), half.norm());
    DistanceOptions options;
    options.enough = enough + rounding;
    return distance(shape_, Box{half}, at, options).lower - rounding;
  }

  /// m, rounding of positions around `center`.
  double roundingAt(const Vector3d& center, double reach) const {
    const double size = center.norm() + reach + extent_ + cloud_from_shape_.translation().norm();
    return 4.0 * tolerance::kSupportRounding * size + kPositionUnderflow;
  }

  /// False once the goal is reached: the rest can be skipped.
  bool lookAtNear() {
    std::vector<int> waiting{0};
    while (!waiting.empty()) {
      const int index = waiting.back();
      waiting.pop_back();
      if (isFar(index)) continue;
      const auto& node = cloud_.tree.node(index);
      if (!node.isLeaf()) {
        waiting.push_back(node.rightChild);
        waiting.push_back(index + 1);
        continue;
      }
      for (int slot = node.first; slot < node.first + node.count; ++slot) {
        const int point = cloud_.tree.order()[static_cast<std::size_t>(slot)];
        if (!lookAtPoint(static_cast<std::size_t>(point))) return false;
      }
    }
    isComplete_ = true;
    return !goal_.isReached(any_.range(far_));
  }

  bool isFar(int index) {
    ++effort_.nodes;
    const auto at = static_cast<std::size_t>(index);
    const double radius = cloud_.nodeRadius[at];
    const double spread = cloud_.nodeSpread[at];
    const double enough = radius + enough_ * spread;
    const double apart = boxDistance(cloud_.tree.node(index).volume, enough);
    if (!(apart > enough)) return false;
    if (spread > 0.0) {
      far_ += cloud_.tree.node(index).count * tailBeyond((apart - radius) / spread);
    }
    return true;
  }

  bool lookAtPoint(std::size_t point) {
    if (effort_.looks >= goal_.options.maxLooks) return false;
    ++effort_.near;
    if (cloud_.spreads[point] > 0.0) {
      integrals_.push_back(integralOf(point));
      effort_.looks += integrals_.back().looks();
      any_.add(integrals_.back().range());
    } else {
      ++effort_.looks;
      certain_.push_back(withoutNoise(point));
      any_.add(certain_.back());
    }
    // Remaining points may have any probability.
    ProbabilityRange range = any_.range(far_);
    range.upper = 1.0;
    return !goal_.isReached(range);
  }

  ProbabilityRange withoutNoise(std::size_t point) const {
    Isometry3d point_from_shape = cloud_from_shape_;
    point_from_shape.translation() -= cloud_.points[point];
    switch (collide(Sphere{cloud_.radii[point]}, shape_, point_from_shape)) {
      case Contact::Touching:
        return {1.0, 1.0, 1.0};
      case Contact::Separate:
        return {0.0, 0.0, 0.0};
      case Contact::Unknown:
        break;
    }
    return {};
  }

  EventIntegral integralOf(std::size_t point) const {
    EventIntegral::Noise noise;
    const double radius = cloud_.radii[point];
    noise.mean = shape_from_cloud_ * cloud_.points[point];
    noise.factor = shape_from_cloud_.linear() * cloud_.factor(point);
    noise.spread = cloud_.spreads[point];
    noise.rounding = roundingAt(noise.mean, radius + kFarthestLook * noise.spread);
    noise.isConvex = isConvexShape(shape_);
    const double tolerance = kCurvedTolerance * noise.spread;
    return EventIntegral(noise, [this, radius, tolerance](const Vector3d& position) {
      return look_.at(position, radius, tolerance);
    });
  }

  /// Weight of a point's gap in that of all points: points beside one that almost certainly touches
  /// do not matter.
  static double weightOf(const EventIntegral& integral) {
    constexpr double kSure = 1e-3;
    return integral.range().gap() / (1.0 - integral.range().estimate + kSure);
  }

  void refine() {
    std::vector<std::pair<double, std::size_t>> widest;
    for (std::size_t i = 0; i < integrals_.size(); ++i) {
      widest.emplace_back(weightOf(integrals_[i]), i);
    }
    std::make_heap(widest.begin(), widest.end());
    while (!widest.empty() && effort_.looks < goal_.options.maxLooks &&
           !goal_.isReached(any_.range(far_))) {
      std::pop_heap(widest.begin(), widest.end());
      EventIntegral& integral = integrals_[widest.back().second];
      const int before = integral.looks();
      any_.remove(integral.range());
      const bool more = integral.refine();
      any_.add(integral.range());
      effort_.looks += integral.looks() - before;
      if (more && integral.range().gap() > 0.0) {
        widest.back().first = weightOf(integral);
        std::push_heap(widest.begin(), widest.end());
      } else {
        widest.pop_back();
      }
    }
  }

  // Sums anew: adding and subtracting has left roundings.
  CollisionProbability result() const {
    AnyOfRanges any;
    for (const ProbabilityRange& range : certain_) any.add(range);
    for (const EventIntegral& integral : integrals_) any.add(integral.range());
    const ProbabilityRange range = any.range(far_);
    CollisionProbability result;
    result.probability = range.estimate;
    result.lower = range.lower;
    result.upper = isComplete_ ? range.upper : 1.0;
    result.effort = effort_;
    return result;
  }

  const NoisyCloudData& cloud_;
  const Shape& shape_;
  const Isometry3d& cloud_from_shape_;
  const Isometry3d shape_from_cloud_;
  const ProbabilityGoal& goal_;
  const ShapeLook look_;
  const double extent_;  ///< m
  double enough_ = 0.0;  ///< standard deviations
  double far_ = 0.0;     ///< upper bound on the probability that any of the far points touches
  bool isComplete_ = false;
  std::vector<ProbabilityRange> certain_;  ///< of points without noise
  std::vector<EventIntegral> integrals_;
  AnyOfRanges any_;
  ProbabilityEffort effort_;
};

}  // namespace

CollisionProbability shapeProbability(const NoisyCloudData& a, const Shape& b,
                                      const Isometry3d& a_from_b, const ProbabilityGoal& goal) {
  const Isometry3d rigid = rigidPose(a_from_b);
  if (!rigid.matrix().allFinite()) return {};
  return ShapeQuery(a, b, rigid, goal).run();
}

}  // namespace swept::detail
