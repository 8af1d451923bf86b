// SPDX-License-Identifier: BSD-3-Clause
// What is proven of constraints over an interval I = [m - h, m + h].
//
// A point or a direction that one body carries is seen from another as x(t), in the observer's
// frame. By L1 of ERROR_MODEL.md x(m + s) is within h^2 A / 2 of the segment x(m) +- h x'(m), where
// A bounds |x''|:
//
// Lemma. Relative to the last common ancestor of the two, let p be the vector, |p'| <= s and
// |p''| <= a (L3, with arms of the point, or of the direction as a point at a distance of 1 from
// all axes' origins), o the observer's origin, |o'| <= s_o and |o''| <= a_o, and let the observer
// turn by no more than W, with an angular acceleration of no more than B. For x = R^T (p - o) and
// |x| <= rho
//   |x''| <= a + a_o + rho (B + W^2) + 2 W (s + s_o + W rho).
// Proof: x' = R^T u, u = p' - o' - w x (p - o), so x'' = R^T (u' - w x u), and u' - w x u =
// p'' - o'' - w' x (p - o) - 2 w x u - w x (w x (p - o)). A direction has o = 0 and rho = 1.
//
// In a tube the same holds for the motion Q over u (see pair_tube.cpp), at whose begin each joint
// adds its error times what it does to x. So in all cases x is in a sum of x(m), of segments
// [-1, 1] g around the origin, and of a ball ("beyond", with what rounding takes of x(m)): Reach.
// Each constraint asks for less than that sum's extent along a direction, or from an axis.
//
// Rotation vectors: see rotation_vector.hpp.
#include "constraints/constraint_proof.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "kinematics/nested_motion_bounds.hpp"
#include "kinematics/rotation_vector.hpp"
#include "kinematics/tube_motion.hpp"
#include "model/pair_model.hpp"
#include "robot/joint_types.hpp"
#include "rounding/error_model.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

/// An interval in which nothing that is open moves by more than this share of the tolerance is not
/// divided further.
constexpr double kStopShare = 0.45;
constexpr double kAngleTolerance = 1e-3;  // rad
/// Of a constraint's own tolerances that are so small: the least that a proof is tried for.
constexpr double kLeastTolerance = 1e-6;  // rad or m
constexpr double kShareOfOwn = 0.1;
/// So many intervals are left open before a search ends.
constexpr int kMostOpen = 8;
constexpr double kEighths = 8.0;

/// Of the coordinates: changes of frames, and what conditions make of them, 24 kDouble.
constexpr double kSeenRoundings = 32.0 * kDouble;
/// rad. The same of directions; a rotation's quaternion and its vector, 40 kDouble.
constexpr double kTurnedRoundings = 64.0 * kDouble;

/// What is known of one constraint in an interval.
struct Finding {
  bool holds = false;
  bool violated = false;  ///< at the middle
  double excess = 0.0;    ///< rad or m, see ConstraintViolation
  bool stops = false;     ///< the interval is too short for a proof to come of its parts
};

/// Where a vector is during an interval, in the observer's frame: see above.
struct Reach {
  Vector3d middle;                     ///< x(m), computed
  Vector3d way;                        ///< h x'(m): one of the segments
  std::span<const Vector3d> segments;  ///< the others
  double beyond = 0.0;                 ///< m, or of a direction
  double error = 0.0;                  ///< likewise, of `middle` alone
  double moves = 0.0;                  ///< likewise, what shorter intervals make smaller

  double along(const Vector3d& n) const {
    double most = std::abs(n.dot(way)) + beyond;
    for (const Vector3d& segment : segments) most += std::abs(n.dot(segment));
    return most;
  }
  /// The largest length of `part` of a vector, a linear map that makes none longer.
  template <typename Part>
  double largest(const Part& part) const {
    double most = std::max(part(middle + way).norm(), part(middle - way).norm()) + beyond;
    for (const Vector3d& segment : segments) most += part(segment).norm();
    return most;
  }
  template <typename Part>
  double least(const Part& part) const {
    double most = part(way).norm() + beyond;
    for (const Vector3d& segment : segments) most += part(segment).norm();
    return part(middle).norm() - most;
  }
  Reach seenFrom(const Isometry3d& frame, std::vector<Vector3d>& room) const {
    const Matrix3d turned = frame.linear().transpose();
    Reach own = *this;
    own.middle = turned * (middle - frame.translation());
    own.way = turned * way;
    const double rounding =
        kSeenRoundings * (middle.norm() + way.norm() + frame.translation().norm());
    own.beyond += rounding;
    own.error += rounding;
    room.clear();
    for (const Vector3d& segment : segments) room.push_back(turned * segment);
    own.segments = room;
    return own;
  }
};

const auto kWhole = [](const Vector3d& v) { return v; };
const auto kAcross = [](const Vector3d& v) -> Vector2d { return v.head<2>(); };

double toleranceOf(double own, double general) {
  return std::max(kLeastTolerance, std::min(general, kShareOfOwn * own));
}

class ConstraintQuery {
 public:
  ConstraintQuery(const ConstraintQuestion& task, const JointPath& path)
      : asked_(task),
        task_(task.constraints),
        path_(path),
        scratch_(task.scratch),
        motion_(task.motion.first(std::max<std::size_t>(task_.bodies, 1))),
        tube_(task.tube) {
    scratch_.states.resize(task_.links.size());
    for (std::size_t i = 0; i < task_.links.size(); ++i) {
      scratch_.states[i].tool.resize(task_.links[i].toolPath.size());
      scratch_.states[i].reference.resize(task_.links[i].referencePath.size());
    }
    scratch_.bounds.resize(task_.vectors);
    scratch_.known.resize(task_.vectors);
    scratch_.walked.resize(task_.links.size());
    if (inTube()) scratch_.tubeMotion.resize(task.kinematics.bodies.size());
  }

  /// False: no bound holds for the path.
  bool start() {
    if (!path_.linearize(0.5, 0.5, motion_)) return false;
    if (inTube()) widenRanges(asked_.kinematics, tube_, motion_);
    curved_ = path_.asStraight() == nullptr;
    std::ranges::fill(scratch_.known, 0);
    double slid = 0.0;
    for (const JointMotion& joint : motion_.subspan(1)) slid += joint.slid() + joint.speed;
    return slid < kLargestNorm;
  }

  /// Later calls are about [t - half, t + half].
  void moveTo(double t, double half) {
    if (curved_) {
      linearizePart(path_, t, half, motion_);
      if (inTube()) widenRanges(asked_.kinematics, tube_, motion_);
    }
    if (inTube()) boundTubeMotion(asked_.kinematics, tube_, half, motion_, scratch_.tubeMotion);
    if (curved_ || inTube()) std::ranges::fill(scratch_.known, 0);
    std::ranges::fill(scratch_.walked, 0);
    t_ = t;
    half_ = half;
  }

  Finding examine(const CompiledConstraint& constraint) {
    return std::visit([this](const auto& own) { return look(own); }, constraint.what);
  }

 private:
  bool inTube() const { return !tube_.empty(); }

  ///@{
  /// Of joints.
  Finding look(const JointRange& own) const {
    double value = own.held;
    double error = 0.0;
    double moves = 0.0;
    double beside = 0.0;  // in the tube
    if (own.body >= 0) {
      const auto body = static_cast<std::size_t>(own.body);
      const JointMotion& joint = motion_[body];
      value = valueOf(own, joint);
      moves = waysOf(own, joint);
      error =
          kValueRounding * (std::abs(value) + joint.largestAngle + joint.slid()) + joint.slideError;
      if (inTube()) beside = isTurn(own, body) ? tube_[body].rotation : tube_[body].translation;
    }
    const double reach = moves + error + beside;
    double above = own.above + tolerance::kLimit;
    double below = own.below + tolerance::kLimit;
    double off = value - own.position;
    if (own.cyclic) {
      if (own.above >= kPi && own.below >= kPi) return {.holds = true};
      off = std::remainder(off, 2.0 * kPi);
      above = std::min(above, kPi);
      below = std::min(below, kPi);
    }
    Finding found;
    found.holds = off + reach <= above && off - reach >= -below;
    found.violated = off - error > above || off + error < -below;
    found.excess = std::max(off - own.above, -own.below - off);
    found.stops = moves <= kStopShare * toleranceOf(own.above + own.below, kAngleTolerance);
    return found;
  }

  bool isTurn(const JointRange& own, std::size_t body) const {
    const JointType type = asked_.kinematics.bodies[body].type;
    return turns(type) || (type == JointType::Planar && own.value == 2);
  }

  /// A planar or floating joint's translation by its own axes; a prismatic one's along its axis.
  double valueOf(const JointRange& own, const JointMotion& joint) const {
    const MovingBody& body = asked_.kinematics.bodies[static_cast<std::size_t>(own.body)];
    const double since = t_ - joint.anchor;
    if (isTurn(own, static_cast<std::size_t>(own.body)))
      return joint.angle + since * joint.angleRate;
    return directionOf(own, body).dot(joint.translation + since * joint.rate);
  }

  /// How far the value goes from the middle, at most.
  double waysOf(const JointRange& own, const JointMotion& joint) const {
    const MovingBody& body = asked_.kinematics.bodies[static_cast<std::size_t>(own.body)];
    const bool turn = isTurn(own, static_cast<std::size_t>(own.body));
    const double rate = turn ? joint.angleRate : directionOf(own, body).dot(joint.rate);
    const double change = turn ? joint.spinAcceleration : joint.acceleration;
    return std::min(half_ * (turn ? joint.spinSpeed : joint.speed),
                    half_ * std::abs(rate) + 0.5 * half_ * half_ * change) *
           kArithmeticOutward;
  }

  static Vector3d directionOf(const JointRange& own, const MovingBody& body) {
    switch (body.type) {
      case JointType::Planar:
        return body.planarBasis.col(own.value);
      case JointType::Floating:
        return Vector3d::Unit(own.value);
      case JointType::Fixed:
      case JointType::Revolute:
      case JointType::Continuous:
      case JointType::Prismatic:
        break;
    }
    return body.axis;
  }
  ///@}

  ///@{
  /// Of what links carry.
  Finding look(const Regions& own) {
    const Reach reach = reachOf(own.point);
    Finding found{.excess = std::numeric_limits<double>::infinity()};
    double least = std::numeric_limits<double>::infinity();
    bool violated = true;
    for (const ConstraintRegion& region : own.regions) {
      const Reach local = reach.seenFrom(region.reference_from_region, scratch_.turned);
      found.holds = found.holds || staysIn(region, local);
      const double outside = distanceFrom(region, local.middle);
      violated = violated && outside > local.error;
      found.excess = std::min(found.excess, outside);
      for (Eigen::Index i = 0; i < sizesOf(region); ++i) least = std::min(least, region.size[i]);
    }
    found.violated = violated;
    found.stops = reach.moves <= kStopShare * toleranceOf(least, asked_.tolerance);
    return found;
  }

  static Eigen::Index sizesOf(const ConstraintRegion& region) {
    switch (region.type) {
      case ConstraintRegion::Type::Box:
        return 3;
      case ConstraintRegion::Type::Cylinder:
        return 2;
      case ConstraintRegion::Type::Sphere:
        break;
    }
    return 1;
  }

  static bool staysIn(const ConstraintRegion& region, const Reach& reach) {
    const auto within = [&](int axis, double half) {
      return std::abs(reach.middle[axis]) + reach.along(Vector3d::Unit(axis)) <= half;
    };
    switch (region.type) {
      case ConstraintRegion::Type::Box:
        return within(0, 0.5 * region.size[0]) && within(1, 0.5 * region.size[1]) &&
               within(2, 0.5 * region.size[2]);
      case ConstraintRegion::Type::Cylinder:
        return reach.largest(kAcross) <= region.size[0] && within(2, 0.5 * region.size[1]);
      case ConstraintRegion::Type::Sphere:
        break;
    }
    return reach.largest(kWhole) <= region.size[0];
  }

  /// m, of a point in the region's frame.
  static double distanceFrom(const ConstraintRegion& region, const Vector3d& x) {
    switch (region.type) {
      case ConstraintRegion::Type::Box:
        return (x.cwiseAbs() - 0.5 * region.size).cwiseMax(0.0).norm();
      case ConstraintRegion::Type::Cylinder:
        return std::hypot(std::max(0.0, kAcross(x).norm() - region.size[0]),
                          std::max(0.0, std::abs(x.z()) - 0.5 * region.size[1]));
      case ConstraintRegion::Type::Sphere:
        break;
    }
    return std::max(0.0, x.norm() - region.size[0]);
  }

  Finding look(const Tilt& own) {
    if (own.angle >= kPi) return {.holds = true};
    const Reach reach = reachOf(own.axis);
    const Vector3d up = Vector3d::UnitZ();
    const double lowest = reach.middle.z() - reach.along(up);
    Finding found;
    // Sines tell small angles apart, cosines large ones.
    found.holds = own.angle <= 0.5 * kPi
                      ? (lowest > 0.0 && reach.largest(kAcross) <= own.sine) || lowest >= own.cosine
                      : lowest >= own.cosine || reach.least(kAcross) >= own.sine;
    const double tilt = std::atan2(kAcross(reach.middle).norm(), reach.middle.z());
    found.excess = tilt - own.angle;
    found.violated = found.excess > 2.0 * reach.error;
    found.stops = reach.moves <= kStopShare * toleranceOf(own.angle, kAngleTolerance);
    return found;
  }

  /// With d the tool's z axis in the desired frame, and e the desired x axis in the tool's frame:
  /// d = (sin b, -sin a cos b, cos a cos b), e = (cos b cos c, -cos b sin c, sin b). So |a| <= x is
  /// cos b sin(x - |a|) >= 0, of which the sign does not depend on b: products of d with the unit
  /// vectors (0, -+cos x, sin x) are cos b sin(x +- a), and for x <= pi / 2 both of them must be
  /// above 0, beyond pi / 2 one of them. The same for c.
  Finding look(const EulerTolerances& own) {
    const Vector3d& most = own.tolerance;
    Finding found{.holds = true, .stops = true};
    double least = most.minCoeff();
    found.excess = -std::numeric_limits<double>::infinity();
    if (most.x() < kPi || most.y() < 0.5 * kPi) {
      const Reach z = reachOf(own.z);
      if (most.x() < kPi)
        takeAngle(most.x(), {0.0, own.cosine.x(), own.sine.x()}, 1, z,
                  std::atan2(-z.middle.y(), z.middle.z()), found);
      if (most.y() < 0.5 * kPi) {
        const double sine = std::abs(z.middle.x());
        found.holds = found.holds && sine + z.along(Vector3d::UnitX()) <= own.sine.y();
        found.violated = found.violated || sine - z.error > own.sine.y();
        found.excess = std::max(found.excess, std::asin(std::min(1.0, sine)) - most.y());
      }
      found.stops = found.stops && stopsAt(z, least);
    }
    if (most.z() < kPi) {
      const Reach x = reachOf(own.x);
      takeAngle(most.z(), {own.sine.z(), own.cosine.z(), 0.0}, 1, x,
                std::atan2(-x.middle.y(), x.middle.x()), found);
      found.stops = found.stops && stopsAt(x, least);
    }
    return found;
  }

  static bool stopsAt(const Reach& reach, double least) {
    return reach.moves <= kStopShare * toleranceOf(least, kAngleTolerance);
  }

  /// `normal`: one of the two unit vectors; the other one has the opposite sign of `flipped`.
  static void takeAngle(double most, Vector3d normal, int flipped, const Reach& reach, double angle,
                        Finding& found) {
    int above = 0;
    int below = 0;
    for (int side = 0; side < 2; ++side) {
      normal[flipped] = -normal[flipped];
      const double product = normal.dot(reach.middle);
      above += product - reach.along(normal) > 0.0 ? 1 : 0;
      below += product + reach.error < 0.0 ? 1 : 0;
    }
    const bool both = most <= 0.5 * kPi;
    found.holds = found.holds && above >= (both ? 2 : 1);
    found.violated = found.violated || below >= (both ? 1 : 2);
    found.excess = std::max(found.excess, std::abs(angle) - most);
  }

  Finding look(const RotationVectorTolerances& own) {
    if (own.tolerance.minCoeff() >= kPi) return {.holds = true};
    const ConstrainedLink& link = task_.links[own.link];
    const ConstraintScratch::States& states = walk(own.link);
    const BodyState tool = stateOf(states.tool);
    const BodyState reference = stateOf(states.reference);
    const Matrix3d frame = reference.world_from_body.linear() * own.reference_from_frame;
    const Matrix3d turned = frame.transpose() * tool.world_from_body.linear() *
                            own.tool_from_frame * own.desired.transpose();
    const Vector3d v = rotationVectorOf(turned);
    const Vector3d spin = half_ * (frame.transpose() * (tool.angular - reference.angular));
    const std::span<const JointMotion> bounded = inTube() ? scratch_.tubeMotion : motion_;
    const double scale = inTube() ? 1.0 : half_;
    const auto [toolTurn, toolRate] = turnOf(link.toolPath, bounded);
    const auto [referenceTurn, referenceRate] = turnOf(link.referencePath, bounded);
    const double turn = scale * (toolTurn + referenceTurn);
    const double error =
        turnedRounding(link) * (1.0 + turn) + velocityRounding(link.transforms) * turn;
    // What is not along a known direction: the change of the spin, and rounding.
    double beyond = 0.5 * scale * scale * (toolRate + referenceRate + toolTurn * referenceTurn) *
                    (1.0 + kVelocityRounding);
    double all = spin.norm();
    Vector3d reach = rateOfRotationVector(v, spin).cwiseAbs();
    const double moving = all;
    if (inTube()) {
      const auto addErrors = [&](const std::vector<int>& path, const std::vector<BodyState>& at) {
        for (std::size_t i = 0; i < path.size(); ++i) {
          const auto body = static_cast<std::size_t>(path[i]);
          const double angle = tube_[body].rotation;
          if (angle == 0.0) continue;
          all += angle;
          if (asked_.kinematics.bodies[body].type == JointType::Floating) {
            beyond += angle;
            continue;
          }
          const Vector3d axis = at[i].world_from_body.linear() * axisOf(body);
          reach += rateOfRotationVector(v, angle * (frame.transpose() * axis)).cwiseAbs();
        }
      };
      addErrors(link.toolPath, states.tool);
      addErrors(link.referencePath, states.reference);
    }
    const double largest = v.norm() + all + beyond + error;
    const bool short_ = largest <= kPi;
    const double growth = short_ ? 0.5 * kPi : 2.2;
    reach.array() += (short_ ? 1.03 : 2.14) * all * all + growth * (beyond + error);
    Finding found;
    found.holds = largest <= 4.0;
    found.excess = -std::numeric_limits<double>::infinity();
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      const double most = own.tolerance[i];
      least = std::min(least, most);
      if (most >= kPi) continue;
      found.holds = found.holds && std::abs(v[i]) + reach[i] <= most;
      found.violated = found.violated || std::abs(v[i]) - 4.0 * error > most;
      found.excess = std::max(found.excess, std::abs(v[i]) - most);
    }
    found.stops = growth * (moving + 2.14 * moving * moving) <=
                  kStopShare * toleranceOf(least, kAngleTolerance);
    return found;
  }
  ///@}

  Vector3d axisOf(std::size_t body) const {
    const MovingBody& moving = asked_.kinematics.bodies[body];
    return moving.type == JointType::Planar ? Vector3d(moving.planarBasis.col(2)) : moving.axis;
  }

  static BodyState stateOf(const std::vector<BodyState>& states) {
    return states.empty() ? BodyState{} : states.back();
  }

  const ConstraintScratch::States& walk(std::size_t index) {
    ConstraintScratch::States& states = scratch_.states[index];
    if (scratch_.walked[index] != 0) return states;
    scratch_.walked[index] = 1;
    const auto go = [this](const std::vector<int>& path, std::vector<BodyState>& at) {
      const BodyState still;
      for (std::size_t i = 0; i < path.size(); ++i) {
        const auto body = static_cast<std::size_t>(path[i]);
        at[i] =
            bodyAt(asked_.kinematics.bodies[body], motion_[body], t_, i == 0 ? still : at[i - 1]);
      }
    };
    go(task_.links[index].toolPath, states.tool);
    go(task_.links[index].referencePath, states.reference);
    return states;
  }

  struct Turn {
    double speed = 0.0;         ///< rad per unit t
    double acceleration = 0.0;  ///< rad per unit t squared
  };
  /// Of the last body relative to where the path begins. The lemma is that of LinkMotion's rates.
  Turn turnOf(std::span<const int> path, std::span<const JointMotion> motion) const {
    TurningBound turning;
    Turn turn;
    for (const int index : path) {
      const auto body = static_cast<std::size_t>(index);
      const JointMotion& joint = motion[body];
      turn.acceleration += turning.now() * joint.spinSpeed + joint.spinAcceleration;
      turning.pass(asked_.kinematics, asked_.kinematics.bodies[body], joint.spinSpeed);
    }
    return {turning.now() * kArithmeticOutward, turn.acceleration * kArithmeticOutward};
  }

  /// L3 for a point at a distance of 1, without what slides.
  PointMotionBound directionBound(const SeenVector& seen, std::size_t first,
                                  std::span<const JointMotion> motion) const {
    TurningBound turning;
    PointMotionBound bound;
    for (std::size_t i = first; i < seen.carrier.path.size(); ++i) {
      const auto body = static_cast<std::size_t>(seen.carrier.path[i]);
      const JointMotion& joint = motion[body];
      const double arm = seen.directionArms[i];
      bound.speed += joint.spinSpeed * arm;
      bound.acceleration += joint.spinSpeed * arm * (2.0 * turning.now() + joint.spinSpeed) +
                            joint.spinAcceleration * arm;
      turning.pass(asked_.kinematics, asked_.kinematics.bodies[body], joint.spinSpeed);
    }
    bound.speed *= kArithmeticOutward;
    bound.acceleration *= kArithmeticOutward;
    return bound;
  }

  PointMotionBound pointBound(const LeverArms& levers, int body, const Vector3d& point,
                              std::size_t first, std::span<const JointMotion> motion) {
    if (levers.path.size() == first) return {};
    std::span<const double> arms = levers.arms;
    if (levers.vary) {
      scratch_.arms.resize(levers.path.size());
      motionArms(asked_.kinematics, body, point, 0.0, motion, scratch_.arms);
      arms = scratch_.arms;
    }
    return pointMotionBound(asked_.kinematics, levers.path, arms, first, motion);
  }

  const VectorBound& boundOf(const SeenVector& seen) {
    VectorBound& bound = scratch_.bounds[seen.slot];
    if (scratch_.known[seen.slot] != 0) return bound;
    scratch_.known[seen.slot] = 1;
    const ConstrainedLink& link = task_.links[seen.link];
    const std::span<const JointMotion> motion = inTube() ? scratch_.tubeMotion : motion_;
    const auto [toolTurn, toolRate] = turnOf(link.toolPath, motion);
    const auto [referenceTurn, referenceRate] = turnOf(link.referencePath, motion);
    bound.toolTurn = toolTurn;
    bound.referenceTurn = referenceTurn;
    bound.observerTurn = seen.fromTool ? referenceTurn : toolTurn;
    bound.observerTurnRate = seen.fromTool ? referenceRate : toolRate;
    if (seen.isDirection) {
      bound.carried = directionBound(seen, link.first, motion);
      bound.observed = {};
    } else {
      bound.carried = pointBound(seen.carrier, link.tool, seen.local, link.first, motion);
      bound.observed = pointBound(seen.observer, link.reference,
                                  seen.observer_from_frame.translation(), link.first, motion);
    }
    return bound;
  }

  CarriedRounding carriedBy(const ConstrainedLink& link) const {
    CarriedRounding carried;
    for (const auto* path : {&link.toolPath, &link.referencePath})
      for (const int body : *path)
        carried = carriedRounding(carried, motion_[static_cast<std::size_t>(body)]);
    return carried;
  }

  /// rad. What directions are off.
  double turnedRounding(const ConstrainedLink& link) const {
    return tolerance::kRoundingPerJoint * (link.transforms + 2.0) + carriedBy(link).angleError +
           kTurnedRoundings;
  }

  Reach reachOf(const SeenVector& seen) {
    const ConstrainedLink& link = task_.links[seen.link];
    const ConstraintScratch::States& states = walk(seen.link);
    const BodyState carrier = stateOf(seen.fromTool ? states.tool : states.reference);
    const BodyState observer = stateOf(seen.fromTool ? states.reference : states.tool);
    const Isometry3d frame = observer.world_from_body * seen.observer_from_frame;
    Vector3d p, velocity, relative;
    if (seen.isDirection) {
      p = relative = carrier.world_from_body.linear() * seen.local;
      velocity = (carrier.angular - observer.angular).cross(p);
    } else {
      p = carrier.world_from_body * seen.local;
      relative = p - frame.translation();
      velocity = carrier.linear - observer.linear + (carrier.angular - observer.angular).cross(p);
    }
    Reach reach;
    const Matrix3d axes = frame.linear().transpose();
    reach.middle = axes * relative;
    reach.way = half_ * (axes * velocity);

    const VectorBound& bound = boundOf(seen);
    const double scale = inTube() ? 1.0 : half_;
    const double turn = bound.observerTurn;
    const double speed = bound.carried.speed + bound.observed.speed;
    const double radius = seen.isDirection ? 1.0 : relative.norm() + scale * speed;
    const double acceleration = bound.carried.acceleration + bound.observed.acceleration +
                                radius * (bound.observerTurnRate + turn * turn) +
                                2.0 * turn * (speed + turn * radius);
    const double travel = scale * (speed + turn * radius);
    const double turned = turnedRounding(link);
    double error = turned;
    if (!seen.isDirection) {
      const CarriedRounding carried = carriedBy(link);
      error = turned * (seen.magnitude + 2.0 * carried.slid) + carried.slideError +
              kSeenRoundings * (p.norm() + frame.translation().norm());
    }
    const double curvature = 0.5 * scale * scale * acceleration * (1.0 + kVelocityRounding);
    reach.error = error;
    reach.beyond = curvature + error * (1.0 + scale * (bound.toolTurn + bound.referenceTurn)) +
                   velocityRounding(link.transforms) * travel;
    reach.moves = reach.way.norm() + (inTube() ? 0.0 : curvature);
    scratch_.errors.clear();
    if (inTube()) {
      reach.beyond += addErrors(link.toolPath, states.tool, seen, p, axes) +
                      addErrors(link.referencePath, states.reference, seen, p, axes);
    }
    reach.segments = scratch_.errors;
    return reach;
  }

  /// What joints of a path do to the vector at p, in the observer's frame. Returns what may be in
  /// any direction.
  double addErrors(const std::vector<int>& path, const std::vector<BodyState>& at,
                   const SeenVector& seen, const Vector3d& p, const Matrix3d& axes) {
    double anywhere = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const auto body = static_cast<std::size_t>(path[i]);
      const JointTolerance& off = tube_[body];
      if (off.rotation == 0.0 && off.translation == 0.0) continue;
      const JointType type = asked_.kinematics.bodies[body].type;
      const Isometry3d& frame = at[i].world_from_body;
      const Vector3d arm = seen.isDirection ? p : Vector3d(p - frame.translation());
      if (type == JointType::Floating) {
        anywhere += off.rotation * arm.norm() + (seen.isDirection ? 0.0 : off.translation);
      } else if (slidesWithinLimits(type)) {
        if (!seen.isDirection)
          scratch_.errors.push_back(axes * (frame.linear() * (off.translation * axisOf(body))));
      } else {
        if (!seen.isDirection) anywhere += off.translation;
        const Vector3d spin = frame.linear() * (off.rotation * axisOf(body));
        scratch_.errors.push_back(axes * spin.cross(arm));
      }
    }
    return anywhere;
  }

  const ConstraintQuestion& asked_;
  const ConstraintModel& task_;
  const JointPath& path_;
  ConstraintScratch& scratch_;
  const std::span<JointMotion> motion_;
  const std::span<const JointTolerance> tube_;
  bool curved_ = false;
  double t_ = 0.0;
  double half_ = 0.0;
};

std::uint64_t allOf(std::size_t count) {
  return count == kMostConstraints ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

/// From the begin on, halving what is open, until all is proven or what is open is too short.
class ConstraintSearch {
 public:
  ConstraintSearch(const ConstraintQuestion& task, ConstraintQuery& query, MotionQuery wanted)
      : asked_(task), query_(query), wanted_(wanted), stack_(task.scratch.stack) {}

  ConstraintProof run() {
    const std::uint64_t all = allOf(asked_.constraints.constraints.size());
    stack_.clear();
    stack_.push_back({0.0, 1.0, all});
    while (!stack_.empty()) {
      const ConstraintScratch::Interval interval = stack_.back();
      stack_.pop_back();
      if (proof_.violation && interval.begin >= proof_.violation->t) break;
      const double middle = 0.5 * (interval.begin + interval.end);
      if (proof_.intervals >= asked_.maxIntervals) {
        leaveOpen(interval.begin);
        break;
      }
      bool stops = !(interval.begin < middle && middle < interval.end);
      const std::uint64_t open =
          examine(middle, 0.5 * (interval.end - interval.begin), interval.open, stops);
      if (proof_.violation && wanted_ == MotionQuery::VerdictOnly) break;
      if (open == 0) continue;
      if (stops) {
        leaveOpen(interval.begin);
        // Eighths and more may be parts of one that would be left as a whole.
        const bool whole = interval.end - interval.begin >= 1.0 / kEighths;
        left_ += whole && !asked_.kept.empty() ? 0 : 1;
        if (left_ == kMostOpen) break;
        continue;
      }
      if (!proof_.violation || middle < proof_.violation->t)
        stack_.push_back({middle, interval.end, open});
      stack_.push_back({interval.begin, middle, open});
    }
    // An end may be outside by less than what intervals are divided for.
    for (const double end : {0.0, 1.0}) {
      bool stops = false;
      if (!proof_.violation && isOpen_) examine(end, 0.0, all, stops);
    }
    return settled();
  }

 private:
  /// Which of the constraints are not proven to hold.
  std::uint64_t examine(double t, double half, std::uint64_t asked, bool& stops) {
    const std::uint64_t kept = asked & keptIn(t - half, t + half);
    if (kept == asked) return 0;
    // Where lanes fail, so does a look at more than an eighth nearly always. It would show no
    // violation either, if the constraints are known to hold on one side of the middle.
    if (half > 0.5 / kEighths && ((asked & ~kept) & ~keptBeside(t)) == 0) return asked;
    query_.moveTo(t, half);
    ++proof_.intervals;
    bool allStop = true;
    std::uint64_t open = look(t, asked & ~kept, allStop);
    // What is known to hold divides an interval as if it were not: so the intervals are the same,
    // and no constraint is left open that would be decided in a shorter one.
    if (open != 0 && allStop) look(t, kept, allStop);
    if (open != 0) open |= kept;
    stops = stops || allStop;
    return open;
  }

  std::uint64_t look(double t, std::uint64_t asked, bool& allStop) {
    std::uint64_t open = 0;
    for (std::uint64_t rest = asked; rest != 0; rest &= rest - 1) {
      const int i = std::countr_zero(rest);
      const CompiledConstraint& constraint =
          asked_.constraints.constraints[static_cast<std::size_t>(i)];
      const Finding found = query_.examine(constraint);
      if (found.violated && (!proof_.violation || t < proof_.violation->t))
        proof_.violation = {
            .t = t, .kind = constraint.kind, .index = constraint.index, .excess = found.excess};
      if (found.holds) continue;
      open |= std::uint64_t{1} << i;
      allStop = allStop && found.stops;
    }
    return open;
  }

  /// The constraints that are known to hold in all of an interval, whose ends are those of halving.
  std::uint64_t keptIn(double begin, double end) const {
    if (asked_.kept.empty()) return 0;
    const int first = std::min(static_cast<int>(kEighths * begin), 7);
    const int last = std::max(first, static_cast<int>(std::ceil(kEighths * end)) - 1);
    const unsigned eighths = (2U << last) - (1U << first);
    std::uint64_t kept = 0;
    for (std::size_t i = 0; i < asked_.kept.size(); ++i)
      if ((asked_.kept[i] & eighths) == eighths) kept |= std::uint64_t{1} << i;
    return kept;
  }

  /// The constraints that are known to hold in the eighth that ends at t, or in that which begins
  /// there.
  std::uint64_t keptBeside(double t) const {
    return keptIn(t - 1.0 / kEighths, t) | keptIn(t, t + 1.0 / kEighths);
  }

  /// Intervals come in order, so the first call has the least.
  void leaveOpen(double begin) {
    if (!isOpen_) proof_.undecidedAt = begin;
    isOpen_ = true;
  }

  ConstraintProof settled() {
    if (proof_.violation) {
      proof_.verdict = Verdict::Violation;
      proof_.holdsUntil = proof_.violation->t;
    }
    if (isOpen_) proof_.holdsUntil = std::min(proof_.holdsUntil, proof_.undecidedAt);
    if (isOpen_ && !proof_.violation) proof_.verdict = Verdict::Undecided;
    return proof_;
  }

  const ConstraintQuestion& asked_;
  ConstraintQuery& query_;
  const MotionQuery wanted_;
  std::vector<ConstraintScratch::Interval>& stack_;
  ConstraintProof proof_;
  bool isOpen_ = false;
  int left_ = 0;
};

constexpr ConstraintProof kNothingKnown{.verdict = Verdict::Undecided, .holdsUntil = 0.0};

}  // namespace

ConstraintProof proveConstraints(const ConstraintQuestion& task, const JointPath& path,
                                 MotionQuery wanted) {
  ConstraintQuery query(task, path);
  if (!query.start()) return kNothingKnown;
  return ConstraintSearch(task, query, wanted).run();
}

ConstraintProof proveConstraints(const ConstraintQuestion& task, std::span<const double> q,
                                 std::vector<ConstraintViolation>* all) {
  const StraightPath still(task.kinematics, q, q);
  ConstraintQuery query(task, still);
  if (!query.start()) return kNothingKnown;
  query.moveTo(0.0, 0.0);
  ConstraintProof proof;
  proof.intervals = 1;
  for (const CompiledConstraint& constraint : task.constraints.constraints) {
    const Finding found = query.examine(constraint);
    if (found.violated) {
      const ConstraintViolation violation{
          .t = 0.0, .kind = constraint.kind, .index = constraint.index, .excess = found.excess};
      if (!proof.violation) proof.violation = violation;
      if (all != nullptr) all->push_back(violation);
    } else if (!found.holds) {
      proof.verdict = Verdict::Undecided;
    }
  }
  if (proof.violation) proof.verdict = Verdict::Violation;
  if (proof.verdict != Verdict::Free) proof.holdsUntil = 0.0;
  return proof;
}

}  // namespace swept::detail
