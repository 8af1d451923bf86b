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

/// What a Checker answers.
namespace swept {

/// Two points of two bodies at most the margin apart: the nearest ones where it comes from a report
/// or a first contact, any otherwise.
struct Witness {
  double t = 0.0;  ///< in [0, 1]; 0 for a state
  BodyName bodyA;  ///< a robot link or an attached body
  BodyName bodyB;  ///< a world body or another link
  /// Both are links or attached bodies. A world body may have a link's name: this tells which it is
  /// of those that bodyB names.
  bool selfPair = false;
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, model frame, on or in bodyA
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, model frame, on or in bodyB
  double distance = 0.0;                             ///< m, |pointB - pointA|; 0 in contact
  double margin = 0.0;  ///< m, what the two have to keep; above it they are free
};

/// The nearest of the checked pairs with the world, or of those of two links or attached bodies, in
/// a state.
struct NearestPair {
  /// m. As StateReport::clearance, of these pairs alone.
  double clearance = 0.0;
  ///@{
  /// As of a Witness; empty without such pairs.
  BodyName bodyA, bodyB;
  ///@}
};

/// What one state looks like, completely. `clearance` is the smaller of those of `world` and
/// `self`: links that are always near each other say nothing about the world.
struct StateReport {
  Verdict verdict = Verdict::Undecided;  ///< of checkState
  bool finite = false;  ///< every value of the state is a number; otherwise nothing else is known
  /// Variables (names) outside their limits, see withinLimits(). Says nothing about geometry; a
  /// planner refuses both.
  std::vector<std::string> outsideLimits;
  std::vector<Witness> contacts;  ///< one per violating pair, in the checker's pair order
  /// m. Proven lower bound of the least distance over all checked pairs, with all of their pieces;
  /// margins and paddings are not taken off. Infinity: no pairs.
  double clearance = 0.0;
  ///@{
  /// The pair that gave `clearance`; empty without pairs.
  BodyName nearestA, nearestB;
  bool nearestSelfPair = false;  ///< as Witness::selfPair
  ///@}
  NearestPair world;  ///< of the pairs with the world, moving obstacles among it
  NearestPair self;   ///< of the pairs of two links or attached bodies
};

/// What a query took.
struct Effort {
  int intervals = 0;           ///< sub-intervals (or states) at which exact geometry was asked
  std::int64_t distances = 0;  ///< exact pair queries
  std::int64_t culled = 0;     ///< pairs settled by bounding volumes alone
  std::int64_t lanes = 0;      ///< sub-intervals examined in single precision
};

/// What is known about a whole motion q(t), t in [0, 1].
struct MotionCertificate {
  /// of the whole motion
  Verdict verdict = Verdict::Undecided;
  /// Largest proven t: [0, freeUntil] is Free. 1 when the verdict is Free; 0 when not even the
  /// start is (or nothing about the prefix was asked).
  double freeUntil = 0.0;
  /// Engaged exactly when the verdict is Collision. Under MotionQuery::FirstContact, the first
  /// contact; see there. Otherwise any.
  std::optional<Witness> witness;
  /// First interval that could not be proven, when the verdict is Undecided.
  double undecidedAt = 0.0;
  Effort effort;  ///< spent, whatever the verdict
};

/// How much of a motion's certificate is wanted.
enum class MotionQuery : std::uint8_t {
  VerdictOnly,  ///< stop at the first contact found, wherever it is; freeUntil is 0 unless Free
  /// freeUntil is the supremum of the provable prefix, to within the tolerance. The witness is the
  /// first contact: its t is in an interval on which the pair approaches by less than a 16th of the
  /// tolerance, and before that interval no checked pair gets within its margin by more than this.
  /// freeUntil is the begin of that interval, unless another pair comes so close to its margin
  /// before. Where the cap on intervals ends the search, the witness is the earliest contact found.
  FirstContact,
};

/// Which clearances of a motion are wanted. The others of MotionClearance stay as they begin.
enum class ClearanceQuery : std::uint8_t {
  Least,   ///< of all checked pairs together
  ByKind,  ///< that, and of the pairs with the world and of the others too: takes longer
  World,   ///< of the pairs with the world alone, which then is the least
  Self,    ///< of the others alone, which then is the least
};

/// Least distance over a motion of some pairs, as an interval; infinite: there are none.
struct ClearanceInterval {
  double lower = 0.0;  ///< m, proven for every t
  /// m, attained at t, as poses are rounded; infinity: nothing is known.
  double upper = std::numeric_limits<double>::infinity();
  double t = 0.0;  ///< in [0, 1], where upper is attained
  ///@{
  /// The pair that attains it, as of a Witness; empty without.
  BodyName bodyA, bodyB;
  ///@}
};

/// Least distance of the checked pairs over a motion.
struct MotionClearance : ClearanceInterval {
  bool selfPair = false;    ///< of bodyA and bodyB, as Witness::selfPair
  int intervals = 0;        ///< examined
  ClearanceInterval world;  ///< of the pairs with the world, moving obstacles among it
  ClearanceInterval self;   ///< of the pairs of two links or attached bodies
};

/// Least distance over a path of some pairs, as an interval.
struct PathClearanceInterval : ClearanceInterval {
  /// Where `upper` is attained, at `t` of it: 0 is the motion from the first state to the second.
  /// None: there is no such pair, or nothing is known.
  std::optional<std::size_t> segment = {};
};

/// Least distance of the checked pairs over a path.
struct PathClearance : PathClearanceInterval {
  bool selfPair = false;        ///< of bodyA and bodyB, as Witness::selfPair
  std::int64_t intervals = 0;   ///< examined, of all motions
  PathClearanceInterval world;  ///< of the pairs with the world, moving obstacles among it
  PathClearanceInterval self;   ///< of the pairs of two links or attached bodies
};

/// Signed distance of the checked pair that is nearest or, where some overlap, deepest in each
/// other, as an interval: minus the length of the shortest translation that separates the two where
/// they overlap (see signedDistance() for meshes). Margins and paddings are not taken off.
struct SignedClearance {
  /// m. Proven for all checked pairs; infinity: there are none; minus infinity: nothing is known.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();  ///< m, of the pair that the rest is of
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();        ///< m, model frame
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();        ///< m, model frame
  /// Unit vector from a to b, model frame: moving b along it takes the two apart. Zero where no one
  /// direction is known to (meshes that overlap, contact in one point).
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

}  // namespace swept
