// SPDX-License-Identifier: BSD-3-Clause
// What is proven of a tool beside a straight piece over an interval [m - h, m + h].
//
// Let x be the tool's origin and R its orientation, |x''| <= A, W and B bounds on the tool's
// angular velocity and acceleration (L3 of ERROR_MODEL.md, for the tool's origin as a point of its
// body).
//
// Position. By L1 x(m + s) is within h^2 A / 2 of x(m) + s x'(m). The distance from a segment is
// convex and changes by no more than the point moves, so at every instant of the interval it is at
// most the larger of those of x(m) - h x'(m) and x(m) + h x'(m), and h^2 A / 2.
//
// Orientation. The piece's S(u) = exp(u [a]) S(0) turns with a constant angular velocity a. N =
// S^T R has N' = [w] N with w = S^T (w_R - a), and w' = S^T (w_R' - a x w_R), so |w'| <= B + |a| W.
// The angle between R and S is |v|, v the rotation vector of N, or less where |v| > pi. By the
// lemma of rotation_vector.hpp v(m + s) is within q (h |w|)^2 + k h^2 (B + |a| W) / 2 of v(m) + s J
// w(m), and the norm is convex: again the ends decide.
//
// A way point between two chords is on the line up to the tolerance of inverse kinematics, so w and
// the part of x' across the line are small, of first order in the length of the chord, and all
// deviations of second order.
#include "line/line_deviation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinematics/nested_motion_bounds.hpp"
#include "kinematics/rotation_vector.hpp"
#include "rounding/error_model.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// So many intervals, and a chord has to be shorter: a proof of one that bends little takes less
/// than ten.
constexpr int kMostIntervals = 128;

/// Of the coordinates: the piece's ends (4 kDouble), the nearest point of the segment and the
/// distance from it, 20 kDouble.
constexpr double kSegmentRoundings = 32.0 * kDouble;
/// rad. The piece's turn, its product with u and Rodrigues' formula 26 kDouble, two products with
/// rotations 12, the vector of a rotation 40, the norm 4, besides what the pose's own rounding is.
constexpr double kSlerpRoundings = 128.0 * kDouble;

double distanceToSegment(const Vector3d& x, const LinePiece& piece) {
  const Vector3d way = piece.end - piece.begin;
  const double squared = way.squaredNorm();
  const Vector3d from = x - piece.begin;
  if (!(squared > 0.0)) return from.norm();
  return (from - std::clamp(from.dot(way) / squared, 0.0, 1.0) * way).norm();
}

/// Bounds over the whole chord, by u.
struct ChordBounds {
  PointMotionBound origin;
  double turn = 0.0;      ///< rad: W
  double turnRate = 0.0;  ///< rad: B
  double position = 0.0;  ///< m, error of the tool's origin
  double angle = 0.0;     ///< rad, error of its orientation
};

class ChordProof {
 public:
  ChordProof(const KinematicModel& model, const CarriedTool& tool, const LinePiece& piece,
             const Deviation& allowed, DeviationScratch& scratch)
      : model_(model), tool_(tool), piece_(piece), allowed_(allowed), scratch_(scratch) {}

  DeviationProof run(std::span<const double> from, std::span<const double> to) {
    scratch_.motion.resize(static_cast<std::size_t>(tool_.body) + 1);
    if (!compileMotion(model_, from, to, scratch_.motion)) return {};
    bound();
    scratch_.stack.assign(1, {0.0, 1.0});
    while (!scratch_.stack.empty()) {
      const DeviationScratch::Interval interval = scratch_.stack.back();
      scratch_.stack.pop_back();
      const double middle = 0.5 * (interval.begin + interval.end);
      const bool proven = examine(middle, 0.5 * (interval.end - interval.begin));
      if (proof_.intervals == 1) proof_.middle = seen_;
      if (proven) {
        proof_.most.position = std::max(proof_.most.position, most_.position);
        proof_.most.angle = std::max(proof_.most.angle, most_.angle);
        continue;
      }
      if (!isWithin(seen_) || proof_.intervals == kMostIntervals) return proof_;
      scratch_.stack.push_back({middle, interval.end});
      scratch_.stack.push_back({interval.begin, middle});
    }
    proof_.holds = true;
    return proof_;
  }

 private:
  bool asksForAngle() const { return allowed_.angle < std::numbers::pi; }

  /// False for what is no number.
  bool isWithin(const Deviation& off) const {
    return off.position <= allowed_.position && (!asksForAngle() || off.angle <= allowed_.angle);
  }

  void bound() {
    const std::span<const JointMotion> motion = scratch_.motion;
    std::span<const double> arms = tool_.levers.arms;
    if (tool_.levers.vary) {
      scratch_.arms.resize(tool_.levers.path.size());
      motionArms(model_, tool_.body, tool_.body_from_tool.translation(), 0.0, motion,
                 scratch_.arms);
      arms = scratch_.arms;
    }
    bounds_.origin = pointMotionBound(model_, tool_.levers.path, arms, 0, motion);
    TurningBound turning;
    CarriedRounding carried;
    for (const int index : tool_.levers.path) {
      const JointMotion& joint = motion[static_cast<std::size_t>(index)];
      carried = carriedRounding(carried, joint);
      bounds_.turnRate += turning.now() * joint.spinSpeed + joint.spinAcceleration;
      turning.pass(model_, model_.bodies[static_cast<std::size_t>(index)], joint.spinSpeed);
    }
    bounds_.turn = turning.now() * kArithmeticOutward;
    bounds_.turnRate *= kArithmeticOutward;
    const double turned =
        tolerance::kRoundingPerJoint * (tool_.transforms + 2.0) + carried.angleError;
    bounds_.angle = turned + kSlerpRoundings;
    bounds_.position = turned * (tool_.magnitude + 2.0 * carried.slid) + carried.slideError +
                       kSegmentRoundings * (tool_.magnitude + carried.slid + piece_.begin.norm() +
                                            piece_.end.norm());
  }

  /// Whether the deviation is within what is allowed on [m - h, m + h].
  bool examine(double m, double h) {
    ++proof_.intervals;
    BodyState state;
    for (const int index : tool_.levers.path) {
      const auto body = static_cast<std::size_t>(index);
      state = bodyAt(model_.bodies[body], scratch_.motion[body], m, state);
    }
    examinePosition(state, h);
    if (asksForAngle()) examineAngle(state, m, h);
    return isWithin(most_);
  }

  void examinePosition(const BodyState& state, double h) {
    const Vector3d x = state.world_from_body * tool_.body_from_tool.translation();
    const Vector3d way = h * (state.linear + state.angular.cross(x));
    const double rounding = velocityRounding(tool_.transforms);
    const double beyond = 0.5 * h * h * bounds_.origin.acceleration * (1.0 + kVelocityRounding) +
                          bounds_.position * (1.0 + h * bounds_.turn) +
                          rounding * h * bounds_.origin.speed;
    seen_.position = distanceToSegment(x, piece_);
    most_.position =
        std::max(distanceToSegment(x - way, piece_), distanceToSegment(x + way, piece_)) + beyond;
  }

  void examineAngle(const BodyState& state, double m, double h) {
    const Matrix3d line_from_model = piece_.orientationAt(m).transpose();
    const Vector3d v = rotationVectorOf(line_from_model * state.world_from_body.linear() *
                                        tool_.body_from_tool.linear());
    const Vector3d spin = h * (line_from_model * (state.angular - piece_.turn));
    const double lineTurn = piece_.turn.norm();
    const double turn = h * (bounds_.turn + lineTurn);
    const double error = bounds_.angle * (1.0 + turn) + velocityRounding(tool_.transforms) * turn;
    const double change =
        0.5 * h * h * (bounds_.turnRate + lineTurn * bounds_.turn) * (1.0 + kVelocityRounding);
    seen_.angle = v.norm();
    const double all = spin.norm();
    const double largest = seen_.angle + all + change + error;
    // k and q of the lemma.
    const double growth = largest <= 0.5 ? 1.02 : largest <= std::numbers::pi ? 1.571 : 2.2;
    const double bend = largest <= 0.5 ? 0.31 : largest <= std::numbers::pi ? 1.03 : 2.14;
    const Vector3d way = rateOfRotationVector(v, spin);
    most_.angle = largest <= 4.0 ? std::max((v - way).norm(), (v + way).norm()) + bend * all * all +
                                       growth * (change + error)
                                 : largest;
  }

  const KinematicModel& model_;
  const CarriedTool& tool_;
  const LinePiece& piece_;
  const Deviation allowed_;
  DeviationScratch& scratch_;
  ChordBounds bounds_;
  Deviation seen_, most_;  ///< at the middle of the interval; over all of it
  DeviationProof proof_;
};

}  // namespace

Matrix3d LinePiece::orientationAt(double u) const {
  const double angle = turn.norm();
  if (!(angle > 0.0)) return orientation;
  return Eigen::AngleAxisd(u * angle, turn / angle).toRotationMatrix() * orientation;
}

double Deviation::shareOf(const Deviation& allowed) const {
  const double own = position / allowed.position;
  return allowed.angle < std::numbers::pi ? std::max(own, angle / allowed.angle) : own;
}

CarriedTool carriedTool(const KinematicModel& model, std::size_t link,
                        const Isometry3d& link_from_tool) {
  CarriedTool tool;
  tool.body = model.bodyOfLink[link];
  tool.body_from_tool = model.body_from_link[link] * link_from_tool;
  tool.levers = leverArms(model, tool.body, tool.body_from_tool.translation(), 0.0);
  const FixedJointChain& fixed = model.fixedChainOfLink[link];
  tool.transforms = 1.0 + fixed.transforms + tool.levers.transforms;
  tool.magnitude = tool.levers.spanAtRest + link_from_tool.translation().norm() +
                   std::max(fixed.farthest, model.body_from_link[link].translation().norm());
  return tool;
}

DeviationProof proveDeviation(const KinematicModel& model, const CarriedTool& tool,
                              const LinePiece& piece, std::span<const double> from,
                              std::span<const double> to, const Deviation& allowed,
                              DeviationScratch& scratch) {
  return ChordProof(model, tool, piece, allowed, scratch).run(from, to);
}

}  // namespace swept::detail
