// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swept/core/tolerances.hpp"
#include "swept/core/verdict.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

namespace detail {
struct CheckerModel;
struct WorkspaceData;
}  // namespace detail

struct CheckerOptions {
  /// m. Free means: every checked pair keeps more than this.
  double margin = 0.0;
  /// m. A motion that keeps more than margin + tolerance everywhere is Free, never Undecided.
  double tolerance = tolerance::kMotion;
  /// All of the robot's variables; those outside the group keep these values. Default:
  /// Robot::defaultState().
  std::optional<Eigen::VectorXd> reference;
  /// Cap on the intervals examined per motion; a motion that needs more is Undecided.
  int maxIntervals = tolerance::kMaxIntervals;
};

/// Two points of two bodies at most the margin apart.
struct Witness {
  double t = 0.0;                                    ///< in [0, 1]; 0 for a state
  std::string bodyA;                                 ///< a robot link
  std::string bodyB;                                 ///< a world body or another link
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, model frame, on or in bodyA
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, model frame, on or in bodyB
  double distance = 0.0;                             ///< m, |pointB - pointA|; 0 in contact
};

/// What one state looks like, completely.
struct StateReport {
  Verdict verdict = Verdict::Undecided;
  bool finite = false;  ///< every value of the state is a number; otherwise nothing else is known
  /// Variables (names) outside their limits. Says nothing about geometry; a planner refuses both.
  std::vector<std::string> outsideLimits;
  std::vector<Witness> contacts;  ///< one per violating pair, in the checker's pair order
  double clearance =
      0.0;  ///< m, proven lower bound of the least distance over all pairs; infinity: no pairs
  std::string nearestA, nearestB;  ///< the pair that gave `clearance`; empty without pairs
};

struct Effort {
  int intervals = 0;           ///< sub-intervals (or states) at which exact geometry was asked
  std::int64_t distances = 0;  ///< exact pair queries
  std::int64_t culled = 0;     ///< pairs settled by bounding volumes alone
  std::int64_t lanes = 0;      ///< sub-intervals examined in single precision
};

/// What is known about a whole motion q(t), t in [0, 1].
struct MotionCertificate {
  Verdict verdict = Verdict::Undecided;
  /// Largest proven t: [0, freeUntil] is Free. 1 when the verdict is Free; 0 when not even the
  /// start is (or nothing about the prefix was asked).
  double freeUntil = 0.0;
  std::optional<Witness> witness;  ///< engaged exactly when the verdict is Collision
  /// First interval that could not be proven, when the verdict is Undecided.
  double undecidedAt = 0.0;
  Effort effort;
};

/// How much of a motion's certificate is wanted.
enum class MotionQuery : std::uint8_t {
  VerdictOnly,   ///< stop at the first contact found, wherever it is; freeUntil is 0 unless Free
  FirstContact,  ///< freeUntil is the supremum of the provable prefix, to within the tolerance
};

/// Least distance over a motion, as an interval.
struct MotionClearance {
  double lower = 0.0;  ///< m, proven for every t
  double upper = 0.0;  ///< m, attained at t
  double t = 0.0;
};

class Checker;

/// Scratch memory for one thread. No result depends on what it held before.
class Workspace {
 public:
  explicit Workspace(const Checker& checker);
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;
  ~Workspace();

 private:
  friend class Checker;
  std::unique_ptr<detail::WorkspaceData> data_;
};

/// Validity of states and motions of one group of a robot in one world. Immutable: any number of
/// threads may use one Checker, each with a Workspace of its own.
///
/// The motion from q0 to q1 is q(t) = q0 + t (q1 - q0), cyclic variables the shorter way, floating
/// orientations by slerp along the shorter arc, mimicking joints following. Checked are: each link
/// that the group moves against each world body, and each pair of links whose relative pose the
/// group changes, unless the SRDF disables the pair or a joint connects the two. Queries never
/// throw on spans of the right size (std::invalid_argument otherwise).
class Checker {
 public:
  /// Throws std::invalid_argument for an unknown group, a negative or non-finite margin or
  /// tolerance, or a reference of the wrong size.
  Checker(std::shared_ptr<const Robot> robot, std::string_view group,
          std::shared_ptr<const World> world, const CheckerOptions& options = {});

  /// The same robot, group and options in another world. Shares what does not depend on the world,
  /// and is built in a fraction of the time. Throws std::invalid_argument for null.
  Checker withWorld(std::shared_ptr<const World> world) const;

  const Robot& robot() const;
  const World& world() const;
  const Group& group() const;
  const CheckerOptions& options() const;
  int dimension() const;  ///< size of a configuration of the group

  /// Free: proven. Collision: witnessed. Undecided: within rounding of the margin, not finite, or a
  /// prismatic value outside its limits (the bounds on what moves hold inside them).
  Verdict checkState(std::span<const double> q, Workspace& workspace) const;
  /// The same verdicts for many states, which follow each other in `states`; faster than one by
  /// one. Throws std::invalid_argument unless there is one verdict for each.
  void checkStates(std::span<const double> states, std::span<Verdict> verdicts,
                   Workspace& workspace) const;
  /// Every violating pair and the clearance.
  StateReport reportState(std::span<const double> q, Workspace& workspace) const;
  /// m. Proven lower bound of the least distance over all checked pairs; 0 in contact or when not
  /// finite.
  double clearance(std::span<const double> q, Workspace& workspace) const;

  MotionCertificate certifyMotion(std::span<const double> from, std::span<const double> to,
                                  Workspace& workspace,
                                  MotionQuery query = MotionQuery::FirstContact) const;
  /// upper - lower <= accuracy (m), and lower >= upper / 2 while upper >= accuracy / 50, unless the
  /// cap on intervals ends the search.
  MotionClearance motionClearance(std::span<const double> from, std::span<const double> to,
                                  double accuracy, Workspace& workspace) const;

  bool withinLimits(std::span<const double> q) const;
  /// The configuration at t on the motion that certifyMotion checks.
  Eigen::VectorXd interpolate(std::span<const double> from, std::span<const double> to,
                              double t) const;

  /// One checked pair of bodies, and one that is left out with the reason.
  struct Pair {
    std::string bodyA;  ///< a robot link
    std::string bodyB;  ///< a link or a world body
    bool selfPair = false;
    std::string
        reason;  ///< empty when checked: `adjacent`, `SRDF: Never`, `out of reach`, `rigid`, ...
  };
  const std::vector<Pair>& checkedPairs() const;
  const std::vector<Pair>& skippedPairs() const;
  /// Pairs the group cannot change that are in contact: a base standing on a table, say. Checked
  /// once, here; they do not enter the verdicts.
  const std::vector<Pair>& standingContacts() const;

 private:
  friend class Workspace;
  explicit Checker(std::shared_ptr<const detail::CheckerModel> model);
  void requireSize(std::span<const double> q) const;
  std::shared_ptr<const detail::CheckerModel> model_;
};

}  // namespace swept
