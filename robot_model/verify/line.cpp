// SPDX-License-Identifier: BSD-3-Clause
// An interval of a chord goes from the middle m to any m + s, |s| <= h, u being s / h.
//
// Position. The tool's origin x is within |x''| / 2 of x(m) + u x'(m). The distance from a straight
// segment is convex and changes by no more than the point moves: the two ends u = -1 and 1 decide.
//
// Orientation. The line's S turns with the constant spin a, the tool's R with w_R. N = S^T R has
// N' = [w] N, w = S^T (w_R - a): for w and how it changes the line is one more joint between the
// tool and who observes it. The rotation vector v of N is where the lemma in constraint.cpp
// (Observed::rotationVector) has it, and its length is convex.
#include "line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "encoding.hpp"
#include "rounding.hpp"

namespace swept::verify {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kHalfTurn = std::numbers::pi;

double distanceFrom(const Vector3d& begin, const Vector3d& way, const Vector3d& point) {
  const double squared = way.squaredNorm();
  const Vector3d from = point - begin;
  if (!(squared > 0.0)) return from.norm();
  return (from - std::clamp(from.dot(way) / squared, 0.0, 1.0) * way).norm();
}

/// ROUNDING.md, "Constraints": the line is one joint more. `turn`: rad, the sizes of its angles;
/// `spin`: rad, of the interval; `size`: m, or 1 for orientations.
double lineRounding(const Bounds& of, double turn, double spin, double size) {
  const double turned = 1.0 + of.turn + turn;
  if (!(turned <= kLargest && size <= kLargest)) return std::numeric_limits<double>::infinity();
  return kSeenRounding * (of.joints + 9) * turned * (1.0 + of.spin + spin) * size + kUnderflow;
}

class ChordCheck {
 public:
  ChordCheck(const Motion& motion, const Line& line, std::size_t segment)
      : motion_(motion),
        line_(line),
        from_(line.shares[segment - line.first]),
        to_(line.shares[segment - line.first + 1]) {}

  bool holds(double middle, double half) const {
    return keepsPlace(middle, half) && (line_.angle >= kHalfTurn || keepsTurn(middle, half));
  }

 private:
  bool keepsPlace(double middle, double half) const {
    const Vector3d& local = line_.tool.link_from_frame.translation();
    const Placed at = motion_.at(line_.tool.link, -1, middle, half);
    const Bounds bounds = motion_.bounds(line_.tool.link, -1, local.norm(), middle, half);
    const Vector3d x = at.reference_from_link * local;
    const Vector3d step = half * (at.linear + at.angular.cross(x));
    const Vector3d begin = line_.begin.translation() + from_ * line_.way;
    const Vector3d way = (to_ - from_) * line_.way;
    const double size =
        bounds.extent + local.norm() + line_.begin.translation().norm() + line_.way.norm();
    const double beyond = 0.5 * bounds.acceleration + lineRounding(bounds, 0.0, 0.0, size);
    return std::max(distanceFrom(begin, way, x - step), distanceFrom(begin, way, x + step)) +
               beyond <=
           line_.position;
  }

  bool keepsTurn(double middle, double half) const {
    const Placed at = motion_.at(line_.tool.link, -1, middle, half);
    const Bounds bounds = motion_.bounds(line_.tool.link, -1, 0.0, middle, half);
    const double share = from_ + middle * (to_ - from_);
    const Matrix3d line_from_model = (turned(share) * line_.begin.linear()).transpose();
    const Eigen::Quaterniond q(Matrix3d(line_from_model * at.reference_from_link.linear() *
                                        line_.tool.link_from_frame.linear()));
    const Vector3d part = std::copysign(1.0, q.w()) * q.vec();
    const double sine = part.norm();
    const double angle = 2.0 * std::atan2(sine, std::abs(q.w()));
    const Vector3d v = sine > 0.0 ? Vector3d(angle / sine * part) : Vector3d::Zero();
    const Vector3d lineTurn = half * (to_ - from_) * line_.turn;
    const Vector3d spin = line_from_model * (half * at.angular - lineTurn);
    const Vector3d step = rateOf(v, angle, spin);
    const double all = spin.norm(), most = bounds.spin + lineTurn.norm();
    const double unknown = 0.5 * (0.5 * most * most + bounds.bend) +
                           lineRounding(bounds, 3.0 * line_.turn.norm(), lineTurn.norm(), 1.0);
    const double largest = angle + all + unknown;
    if (!(largest <= kHalfTurn)) return false;
    const double beyond = 0.5 * kHalfTurn * unknown + 1.03 * all * all;
    return std::max((v + step).norm(), (v - step).norm()) + beyond <= line_.angle;
  }

  /// J w of the lemma.
  static Vector3d rateOf(const Vector3d& v, double angle, const Vector3d& spin) {
    const double x = 0.5 * angle;
    const double c = angle < 0.01 ? 1.0 / 12.0 + angle * angle / 720.0
                                  : (1.0 - x / std::tan(x)) / (angle * angle);
    const Vector3d across = v.cross(spin);
    return spin - 0.5 * across + c * v.cross(across);
  }

  Matrix3d turned(double share) const {
    const double angle = line_.turn.norm();
    if (!(angle > 0.0)) return Matrix3d::Identity();
    return Eigen::AngleAxisd(share * angle, line_.turn / angle).toRotationMatrix();
  }

  const Motion& motion_;
  const Line& line_;
  double from_, to_;
};

}  // namespace

Model withoutTolerances(const Model& model) {
  Model still = model;
  for (Joint& joint : still.joints) joint.tolerance = {};
  return still;
}

std::size_t checkLine(const Motion& motion, const Line& line, std::size_t segment,
                      const std::string& place) {
  const ChordCheck chord(motion, line, segment);
  return showByHalving([&](double middle, double half) { return chord.holds(middle, half); },
                       place);
}

}  // namespace swept::verify
