// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

/// What MoveIt's time-optimal trajectory generation makes of a path: straight motions with circular
/// blends (T. Kunz and M. Stilman, Time-Optimal Trajectory Generation for Path Following with
/// Bounded Acceleration and Velocity, RSS 2012, section III), and the least duration on it.
namespace swept::benchmark {

/// A straight motion or an arc, by its length.
struct ArcPiece {
  double length = 0.0;        ///< rad
  double radius = 0.0;        ///< rad; 0: straight
  Eigen::VectorXd direction;  ///< unit, at its begin
  Eigen::VectorXd inward;     ///< unit, from the begin to the centre; of an arc

  Eigen::VectorXd tangent(double s) const {
    if (radius == 0.0) return direction;
    return std::cos(s / radius) * direction + std::sin(s / radius) * inward;
  }
  Eigen::VectorXd curvature(double s) const {
    if (radius == 0.0) return Eigen::VectorXd::Zero(direction.size());
    return (std::cos(s / radius) * inward - std::sin(s / radius) * direction) / radius;
  }
};

/// The pieces of a path whose arcs leave it by no more than `deviation` (rad). An arc takes at most
/// half of each straight motion.
inline std::vector<ArcPiece> arcPath(const std::vector<std::vector<double>>& wayPoints,
                                     double deviation) {
  constexpr double kShortest = 1e-9;  // rad
  std::vector<Eigen::VectorXd> points;
  for (const std::vector<double>& q : wayPoints) {
    const Eigen::VectorXd point =
        Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
    if (points.empty() || (point - points.back()).norm() > kShortest) points.push_back(point);
  }
  std::vector<ArcPiece> pieces;
  double taken = 0.0;  // of the next straight motion, by the arc before
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::VectorXd motion = points[i + 1] - points[i];
    const Eigen::VectorXd direction = motion.normalized();
    double before = 0.0;
    ArcPiece arc;
    if (i + 2 < points.size()) {
      const Eigen::VectorXd next = points[i + 2] - points[i + 1];
      const double turn = std::acos(std::clamp(direction.dot(next.normalized()), -1.0, 1.0));
      if (turn > 1e-6 && turn < 3.14) {
        before = std::min({0.5 * motion.norm(), 0.5 * next.norm(),
                           deviation * std::sin(0.5 * turn) / (1.0 - std::cos(0.5 * turn))});
        arc.radius = before / std::tan(0.5 * turn);
        arc.length = arc.radius * turn;
        arc.direction = direction;
        arc.inward = (next.normalized() - std::cos(turn) * direction).normalized();
      }
    }
    pieces.push_back({motion.norm() - taken - before, 0.0, direction, {}});
    if (before > 0.0) pieces.push_back(arc);
    taken = before;
  }
  return pieces;
}

/// The least time (s) from rest to rest along pieces whose tangents join, by reachability analysis
/// (H. Pham and Q.-C. Pham, A New Approach to Time-Optimal Path Parameterization Based on
/// Reachability Analysis, 2018) on a grid: x is the speed squared, u the acceleration, constant
/// between two points of the grid, and the limits hold at both.
class LeastDuration {
 public:
  LeastDuration(const std::vector<ArcPiece>& pieces, const std::vector<double>& velocity,
                const std::vector<double>& acceleration)
      : velocity_(arrayOf(velocity)), acceleration_(arrayOf(acceleration)) {
    double length = 0.0;
    for (const ArcPiece& piece : pieces) length += piece.length;
    for (const ArcPiece& piece : pieces) {
      if (piece.length <= 0.0) continue;
      const int count = std::max(kLeastSteps, static_cast<int>(kSteps * piece.length / length));
      const double step = piece.length / count;
      for (int k = 0; k < count; ++k)
        steps_.push_back({step, piece.tangent(k * step), piece.curvature(k * step),
                          piece.tangent((k + 1) * step), piece.curvature((k + 1) * step)});
    }
  }

  double seconds() const {
    std::vector<double> largest(steps_.size() + 1, 0.0);
    for (std::size_t k = steps_.size(); k-- > 0;) largest[k] = reachable(steps_[k], largest[k + 1]);
    double time = 0.0;
    double x = 0.0;
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const double next =
          std::clamp(x + 2.0 * steps_[k].length * accelerations(steps_[k], x, largest[k + 1]).high,
                     0.0, largest[k + 1]);
      time += 2.0 * steps_[k].length / (std::sqrt(x) + std::sqrt(next));
      x = next;
    }
    return time;
  }

 private:
  static constexpr int kSteps = 3000;
  static constexpr int kLeastSteps = 30;

  struct Step {
    double length;
    Eigen::ArrayXd tangent, curvature;        ///< at its begin
    Eigen::ArrayXd endTangent, endCurvature;  ///< and at its end
  };
  struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    /// |factor u + term| <= limit.
    void add(double factor, double term, double limit) {
      if (std::abs(factor) < 1e-12) {
        if (std::abs(term) > limit * (1.0 + 1e-9)) high = -std::numeric_limits<double>::infinity();
        return;
      }
      const double a = (-limit - term) / factor;
      const double b = (limit - term) / factor;
      low = std::max(low, std::min(a, b));
      high = std::min(high, std::max(a, b));
    }
  };

  static Eigen::ArrayXd arrayOf(const std::vector<double>& values) {
    return Eigen::Map<const Eigen::ArrayXd>(values.data(),
                                            static_cast<Eigen::Index>(values.size()));
  }

  /// The accelerations over a step that begins with x and ends with at most `most`.
  Range accelerations(const Step& step, double x, double most) const {
    Range u;
    u.add(2.0 * step.length, x - 0.5 * most, 0.5 * most);
    for (Eigen::Index i = 0; i < velocity_.size(); ++i) {
      u.add(step.tangent[i], step.curvature[i] * x, acceleration_[i]);
      u.add(step.endTangent[i] + 2.0 * step.length * step.endCurvature[i], step.endCurvature[i] * x,
            acceleration_[i]);
    }
    return u;
  }

  /// The largest x at a step's begin from which its end is reached with at most `most`.
  double reachable(const Step& step, double most) const {
    double high = std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < velocity_.size(); ++i)
      if (step.tangent[i] != 0.0)
        high = std::min(high, std::pow(velocity_[i] / step.tangent[i], 2));
    double low = 0.0;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (low + high);
      const Range u = accelerations(step, middle, most);
      (u.low <= u.high ? low : high) = middle;
    }
    return low;
  }

  const Eigen::ArrayXd velocity_, acceleration_;
  std::vector<Step> steps_;
};

}  // namespace swept::benchmark
