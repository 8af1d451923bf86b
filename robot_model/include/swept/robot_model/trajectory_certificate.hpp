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
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/rate_limits.hpp"
#include "swept/robot_model/task_constraint.hpp"

/// Results about curves in time: see Checker::certifyTrajectory().
namespace swept {

/// A time of a curve, and the piece that it is in.
struct TrajectoryPlace {
  double time = 0.0;      ///< s, of PiecewisePolynomial
  std::size_t piece = 0;  ///< between knot `piece` and the next one
};

/// A contact of a curve.
struct TrajectoryContact : TrajectoryPlace {
  /// The pair and the place. Its `t` is the share of the curve's duration.
  Witness witness;
  /// rad or m. The configuration that is in contact: that of the curve at `time`, or one that is
  /// off it by no more than CheckerOptions::tracking allows.
  Eigen::VectorXd configuration;
};

/// A constraint does not hold at a time of a curve.
struct TrajectoryViolation : TrajectoryPlace {
  ConstraintViolation violation;  ///< its `t` is the share of the curve's duration
};

/// What a limit is about.
enum class LimitKind : std::uint8_t { Position, Velocity, Acceleration, Jerk };

/// A curve leaves a limit. There is one for each variable and kind: the largest.
struct LimitViolation : TrajectoryPlace {
  std::string variable;                  ///< name
  LimitKind kind = LimitKind::Position;  ///< of which limit
  double value = 0.0;                    ///< rad or m, and per s, s^2 or s^3; at `time`
  double limit = 0.0;                    ///< likewise; of a rate, what its absolute value may be
};

/// Least distance over a curve of some pairs, as an interval; infinite if there are none.
struct TrajectoryClearance : TrajectoryPlace {
  double lower = std::numeric_limits<double>::infinity();  ///< m, proven for every time
  /// m, attained at `time`, up to the rounding of poses; infinity: unknown.
  double upper = std::numeric_limits<double>::infinity();
  ///@{
  /// The pair that attains it, as in Witness; empty without one.
  BodyName bodyA, bodyB;
  ///@}
};

/// What to find out about a curve.
struct TrajectoryQuery {
  MotionQuery contact = MotionQuery::FirstContact;  ///< how much about contacts
  /// s. What the clock of moving obstacles shows at the curve's time 0.
  double clock = 0.0;
  /// Limits of rates; without a value, only those of positions are looked at.
  std::optional<RateLimits> limits = {};
  /// Whether to compute TrajectoryCertificate::world and self, of the curve itself, to a tenth of
  /// CheckerOptions::tolerance, but at least 1e-5 m. Takes many times as long.
  bool clearances = false;
};

/// What is known about a whole curve q(t).
struct TrajectoryCertificate {
  /// Of the whole curve, and of all that CheckerOptions::tracking allows beside it. Limits do not
  /// enter it.
  Verdict verdict = Verdict::Undecided;
  /// s. From the begin to this time all is Free; the end if the verdict is Free. The begin if not
  /// even that is (or the query did not ask).
  double freeUntil = 0.0;
  /// Present exactly if the verdict is Collision: the first contact under
  /// MotionQuery::FirstContact (see there), otherwise any.
  std::optional<TrajectoryContact> contact;
  /// Present exactly if the verdict is Violation: see MotionCertificate::violation.
  std::optional<TrajectoryViolation> violation;
  /// Present exactly if the verdict is Undecided: where the first interval begins that could not be
  /// proven.
  std::optional<TrajectoryPlace> undecided;
  /// Where the curve leaves limits, by variable and kind. Over all of the curve: a limit that is
  /// not listed holds at every instant, positions to within tolerance::kLimit, rates to within
  /// tolerance::kRateLimit of the limit.
  std::vector<LimitViolation> violations;
  ///@{
  /// If they were asked for: pairs with the world, and pairs of two links or attached bodies.
  std::optional<TrajectoryClearance> world, self;
  ///@}
  Effort effort;  ///< spent, whatever the verdict
};

/// `velocity`, `position`, ...
const char* toString(LimitKind kind);

}  // namespace swept
