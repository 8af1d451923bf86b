// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch/validator.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {

/// A way to answer a question, at one setting.
struct ReportMethod {
  Validator::Kind kind = Validator::Kind::Certified;
  /// Certified: tolerance, m. Else the longest step, as a share of the space's extent.
  double setting = 0.0;

  /// `certified`, `discrete` or `fcl`.
  std::string family() const;
  /// `certified:0.001`, `discrete:0.01`.
  std::string name() const;
};

/// What a method says of motions, of which the truth is known. Rates are of those that really
/// collide, and of those that are really free; none where there are no such motions.
struct RateErrors {
  std::size_t free = 0, collisions = 0;  ///< truly
  std::size_t missed = 0;                ///< called free, and really collide
  std::size_t falseAlarms = 0;           ///< not called free, and really free
  /// m. How deep two bodies are in each other, at least, in the worst missed motion; none are
  /// missed: none.
  std::optional<double> deepestMissed;

  std::optional<double> missedRate() const;
  std::optional<double> falseAlarmRate() const;
};

/// How far answers are from the truth, m.
struct LengthErrors {
  double mean = 0.0, largest = 0.0;
  /// What the method itself says that the error is at most; none: it says nothing.
  std::optional<double> meanBound, largestBound;
  std::size_t missed = 0;  ///< no answer although there is one; not part of the errors
};

enum class ReportPart : std::uint8_t { Motions, FirstContact, Clearance, Distance, Penetration };

/// `motions`, `first contact`, ...
std::string toString(ReportPart part);

/// One method at one setting, over all queries of a part.
struct ReportRow {
  ReportPart part = ReportPart::Motions;
  ReportMethod method;
  std::size_t queries = 0;            ///< of which the truth is known
  double mean = 0.0, median = 0.0;    ///< ns per query, on the processor
  std::optional<RateErrors> rates;    ///< of motions
  std::optional<LengthErrors> error;  ///< of the other parts
};

/// What is executed of planned paths in one way, over all paths of a report.
struct ExecutedRow {
  std::string curve;              ///< `polyline`, `blends`, `spline`, `tube` or `proven blends`
  std::optional<double> setting;  ///< rad or m; deviation of blends, tolerance of a tube
  std::size_t free = 0, collisions = 0, undecided = 0;
  /// Collisions that states along the curve, kStateStep apart, do not show; none: not asked.
  std::optional<std::size_t> missed;
  double mean = 0.0, median = 0.0;  ///< ns per path, on the processor
  double relativeTime = 1.0;        ///< mean, relative to that of the polyline

  std::size_t paths() const { return free + collisions + undecided; }
  double collisionRate() const;
  std::optional<double> missedRate() const;
  std::string name() const;  ///< `blends:0.1`, `spline`
};

/// What tables call this part.
inline constexpr const char* kExecutedPart = "executed curves";
/// rad or m, along the curve.
inline constexpr double kStateStep = 0.05;

/// Paths whose straight motions are all proven free, and what is executed of them.
struct ExecutedPaths {
  std::size_t paths = 0, corners = 0;
  std::string leftOut;            ///< why there are none, a sentence; empty: there are some
  std::vector<ExecutedRow> rows;  ///< the polyline first
};

/// The random motions, by what is proven of them at the finest tolerance.
struct MotionCounts {
  std::size_t motions = 0, free = 0, collision = 0, undecided = 0;
  double shortest = 0.0, median = 0.0, longest = 0.0;  ///< in the metric of the state space
};

/// A straight motion between two states that are proven free, and what is proven of it.
struct ReportMotion {
  std::vector<double> from, to;
  double length = 0.0;  ///< in the metric of the state space
  MotionCertificate truth;
};

/// A random motion, and who is wrong about it.
struct JudgedMotion {
  std::string world;
  ReportMotion motion;
  std::vector<ReportMethod> missedBy;   ///< they call it free, and it collides
  std::vector<ReportMethod> refusedBy;  ///< they do not call it free, and it is
};

/// All that a run found.
struct ErrorReport {
  std::string robot, group;
  std::vector<std::string> worlds;     ///< names
  std::shared_ptr<const World> world;  ///< of --scene and --cloud; empty without
  double margin = 0.0;                 ///< m
  ///@{
  /// m. Of pairs of the robot's own bodies, and of pairs with the world.
  double selfMargin = 0.0, worldMargin = 0.0;
  ///@}
  std::uint32_t seed = 1;
  int passes = 1;
  MotionCounts counts;
  std::vector<JudgedMotion> motions;
  std::vector<ReportRow> rows;  ///< by part, then method, from coarse to fine
  ExecutedPaths executed;

  std::vector<ReportRow> rowsOf(ReportPart part) const;
};

}  // namespace swept
