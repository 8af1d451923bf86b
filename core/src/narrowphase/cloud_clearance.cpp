// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "bvh/near_boxes.hpp"
#include "bvh/pending_boxes.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/segment_query.hpp"

namespace swept {

namespace {

using detail::PendingBoxes;
using detail::WideBvh;
using detail::WideNode;
using Eigen::Vector3d;

/// The nearest boxes first; boxes farther than the nearest ball so far are skipped.
class NearestBall {
 public:
  NearestBall(const PointCloud& cloud, const Vector3d& point, double enough)
      : cloud_(cloud), bvh_(cloud.bvh()), point_(point), least_(enough) {
    const Aabb& bounds = bvh_.bounds();
    const double away = (point - bounds.center()).lpNorm<1>();
    const double extent = (bounds.upper - bounds.lower).lpNorm<1>();
    // Lemma: see pointBoxes. The origin of each node is within the bounds, and no box reaches
    // farther from it than two and a half times their extent.
    boxRounding_ = 50.0 * 0x1p-24 * (away + 3.0 * extent);
  }

  double run() {
    PendingBoxes pending;
    alignas(32) std::array<float, WideNode::kLanes> squared;
    while (!pending.isEmpty()) {
      const PendingBoxes::Box top = pending.pop();
      const float most = limit();
      if (top.squared > most) continue;
      if (bvh_.isBucket(top.child)) {
        look(top.child);
        continue;
      }
      const WideNode& node = bvh_.nodes()[static_cast<std::size_t>(top.child)];
      for (std::uint32_t near = pointBoxes(node, point_, most, squared); near != 0;
           near &= near - 1) {
        const int lane = std::countr_zero(near);
        pending.push({squared[lane], node.child[lane]});
      }
    }
    return least_;
  }

 private:
  void look(std::int32_t bucket) {
    const auto [first, last] = bvh_.pointsOf(bucket);
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      least_ = std::min(least_, length(point_ - cloud_.points()[i]) - cloud_.radius(i));
  }
  static double length(const Vector3d& v) {
    constexpr double kGreatest = 1e300;  // m^2; greater squares may overflow
    const double squared = v.squaredNorm();
    return squared < kGreatest ? std::sqrt(squared) : v.stableNorm();
  }

  /// m^2; boxes at more than this hold nothing that is nearer. Squares beyond single precision
  /// decide nothing: then no box is skipped.
  float limit() const {
    constexpr double kGreatest = 1e38;
    const double most = std::max(least_, 0.0) + boxRounding_;
    const double squared = most * most * (1.0 + 0x1p-22) + detail::kNormalSquare;
    if (!(squared < kGreatest)) return std::numeric_limits<float>::infinity();
    return static_cast<float>(squared);
  }

  const PointCloud& cloud_;
  const WideBvh& bvh_;
  const Vector3d& point_;
  double least_;
  double boxRounding_;
};

}  // namespace

double clearance(const PointCloud& cloud, const Vector3d& point, double enough) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, enough] { return clearance(cloud, point, enough); });
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!point.allFinite() || std::isnan(enough)) return -kInfinity;
  const double rounding =
      16.0 * std::numeric_limits<double>::epsilon() * (point.lpNorm<1>() + cloud.bvh().reach());
  const double most = enough + rounding;
  const double found = NearestBall(cloud, point, most).run();
  return found < most ? std::min(enough, found - rounding) : enough;
}

}  // namespace swept
