// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "swept/core/verdict.hpp"
#include "swept/robot_model/body_name.hpp"
#include "swept/robot_model/task_constraint.hpp"

/// Results of a Checker.
namespace swept {

/// Two points of two bodies at most the margin apart. In a report or a first contact they are the
/// nearest points of the two bodies; otherwise any.
struct Witness {
  double t = 0.0;  ///< in [0, 1]; 0 for a state
  BodyName bodyA;  ///< a robot link or an attached body
  BodyName bodyB;  ///< a world body or another link
  /// Both are links or attached bodies. A world body may have a link's name: this tells which one
  /// bodyB names.
  bool selfPair = false;
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, model frame, on or in bodyA
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, model frame, on or in bodyB
  double distance = 0.0;                             ///< m, |pointB - pointA|; 0 in contact
  double margin = 0.0;  ///< m, what the two must keep; above it they are free
  /// rad or m. The configuration that is in contact, if it is off the motion's own at t by what
  /// CheckerOptions::tracking allows; empty: it is the motion's own.
  std::vector<double> configuration = {};
};

/// The nearest checked pair of one kind in a state: of the pairs with the world, or of those of two
/// links or attached bodies.
struct NearestPair {
  /// m. Like StateReport::clearance, of these pairs alone.
  double clearance = 0.0;
  ///@{
  /// The two bodies, as in Witness; empty without such pairs.
  BodyName bodyA, bodyB;
  ///@}
};

/// A complete report on one state. `clearance` is the smaller of those of `world` and `self`: links
/// that are always near each other say nothing about the world.
struct StateReport {
  Verdict verdict = Verdict::Undecided;  ///< as checkState
  bool finite = false;  ///< every value of the state is finite; otherwise nothing else is known
  /// Names of variables outside their limits, see withinLimits(). They do not affect the verdict; a
  /// planner refuses both.
  std::vector<std::string> outsideLimits;
  std::vector<Witness> contacts;  ///< one per violating pair, in the checker's pair order
  /// Of CheckerOptions::constraints, each that does not hold.
  std::vector<ConstraintViolation> violations;
  /// Whether all of them are proven to hold.
  bool constraintsHold = true;
  /// m. Proven lower bound of the least distance over all checked pairs, with all of their pieces,
  /// without subtracting margins and paddings. Infinity: no pairs.
  double clearance = 0.0;
  ///@{
  /// The pair that gave `clearance`; empty without pairs.
  BodyName nearestA, nearestB;
  bool nearestSelfPair = false;  ///< see Witness::selfPair
  ///@}
  NearestPair world;  ///< pairs with the world, including moving obstacles
  NearestPair self;   ///< pairs of two links or attached bodies
};

/// The effort of a query.
struct Effort {
  int intervals = 0;           ///< sub-intervals (or states) with exact queries
  std::int64_t distances = 0;  ///< exact pair queries
  std::int64_t culled = 0;     ///< pairs settled by bounding volumes alone
  std::int64_t lanes = 0;      ///< sub-intervals examined in single precision, by the SIMD tier
  int constrained = 0;         ///< sub-intervals (or states) examined for constraints
};

/// What is known about a whole motion q(t), t in [0, 1].
struct MotionCertificate {
  /// Of the whole motion.
  Verdict verdict = Verdict::Undecided;
  /// Largest proven t: [0, freeUntil] is Free. 1 if the verdict is Free; 0 if not even the start is
  /// (or the query did not ask about the prefix).
  double freeUntil = 0.0;
  /// Present exactly if the verdict is Collision. Under MotionQuery::FirstContact it is the first
  /// contact (see there), otherwise any contact.
  std::optional<Witness> witness;
  /// Present exactly if the verdict is Violation, which a motion may be that is in contact, too.
  /// Under MotionQuery::FirstContact the earliest that was found from freeUntil on, unless a contact
  /// ends that before; otherwise any.
  std::optional<ConstraintViolation> violation;
  /// Start of the first interval that could not be proven, if the verdict is Undecided.
  double undecidedAt = 0.0;
  Effort effort;  ///< spent, whatever the verdict
};

/// How much of a motion's certificate to compute.
enum class MotionQuery : std::uint8_t {
  VerdictOnly,  ///< stop at the first contact found, anywhere; freeUntil is 0 unless Free
  /// freeUntil is the supremum of the provable prefix, to within the tolerance. The witness is the
  /// first contact: its t is in an interval on which the pair approaches by less than a 16th of the
  /// tolerance, and before that interval no checked pair gets into its margin by more than this.
  /// freeUntil is the start of that interval, unless another pair comes equally close to its margin
  /// before. If the cap on intervals ends the search, the witness is the earliest contact found.
  FirstContact,
};

/// Which clearances of a motion to compute. The other members of MotionClearance keep their initial
/// values.
enum class ClearanceQuery : std::uint8_t {
  Least,   ///< of all checked pairs together
  ByKind,  ///< that, and separately of pairs with the world and of the others: takes longer
  World,   ///< only of pairs with the world, which is then the least
  Self,    ///< only of the others, which is then the least
};

/// Least distance over a motion of some pairs, as an interval; infinite if there are none.
struct ClearanceInterval {
  double lower = 0.0;  ///< m, proven for every t
  /// m, attained at t, up to the rounding of poses; infinity: unknown.
  double upper = std::numeric_limits<double>::infinity();
  double t = 0.0;  ///< in [0, 1], where upper is attained
  ///@{
  /// The pair that attains it, as in Witness; empty without one.
  BodyName bodyA, bodyB;
  ///@}
};

/// Least distance of the checked pairs over a motion.
struct MotionClearance : ClearanceInterval {
  bool selfPair = false;    ///< of bodyA and bodyB, see Witness::selfPair
  int intervals = 0;        ///< examined
  ClearanceInterval world;  ///< pairs with the world, including moving obstacles
  ClearanceInterval self;   ///< pairs of two links or attached bodies
};

/// Least distance over a path of some pairs, as an interval.
struct PathClearanceInterval : ClearanceInterval {
  /// The motion in which `upper` is attained, at its `t`: 0 is the motion from the first state to
  /// the second. No value: there is no such pair, or nothing is known.
  std::optional<std::size_t> segment = {};
};

/// Least distance of the checked pairs over a path.
struct PathClearance : PathClearanceInterval {
  bool selfPair = false;        ///< of bodyA and bodyB, see Witness::selfPair
  std::int64_t intervals = 0;   ///< examined in all motions
  PathClearanceInterval world;  ///< pairs with the world, including moving obstacles
  PathClearanceInterval self;   ///< pairs of two links or attached bodies
};

/// Signed distance of the nearest checked pair, as an interval. If some pairs overlap, it is that
/// of the deepest one: minus the length of the shortest translation that separates the two (see
/// signedDistance() for meshes). Margins and paddings are not subtracted.
struct SignedClearance {
  /// m. Proven for all checked pairs; infinity: there are none; minus infinity: nothing is known.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();  ///< m, of the pair described below
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();        ///< m, model frame
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();        ///< m, model frame
  /// Unit vector from a to b, model frame: moving b along it separates the two. Zero if no single
  /// direction is known to (overlapping meshes, contact in one point).
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

}  // namespace swept
