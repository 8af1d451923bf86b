// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "batch/run_key.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// The facts about a path; a run without a path has none.
struct PathFacts {
  double length = 0.0;              ///< in the metric of the state space
  int segments = 0;                 ///< motions between its states
  bool certified = false;           ///< every segment is proven free
  int missedCollisions = 0;         ///< segments with a witness of a collision
  int undecided = 0;                ///< segments that are neither
  std::optional<double> clearance;  ///< m, proven lower bound; none: not certified, or no pairs
  ///@{
  /// Likewise for pairs with the world and for self pairs, with the nearest pair.
  std::optional<NearestPair> world, self;
  ///@}
  std::string digest;                       ///< of the states' bits, in order
  std::vector<std::vector<double>> states;  ///< only where they are asked for
};

/// s.
struct RunTimes {
  double planning = 0.0;
  double simplification = 0.0;
  double certification = 0.0;

  double total() const { return planning + simplification + certification; }
};

/// OMPL's name of it.
inline constexpr std::string_view kStopped = "Crash";

struct RunResult {
  RunKey key;
  /// The planner's own word, as OMPL writes it; kStopped when the worker did not live to the run's
  /// end; empty when there was nothing for a planner to do.
  std::string status;
  std::string failure;  ///< why there is no path; empty when there is one
  /// States that planner and validator checked one by one. None: unknown, or left out because it
  /// depends on time where there is no path.
  std::optional<std::uint64_t> statesChecked;
  std::optional<std::uint64_t> motionsChecked;  ///< for planner and simplification; likewise
  std::optional<PathFacts> path;
  std::optional<RunTimes> times;  ///< none: not measured, or not wanted

  bool solved() const { return path.has_value(); }
};

/// The result for a worker that died during the run.
RunResult stoppedRun(const RunKey& key, const std::string& failure);

Json resultJson(const RunResult& result);
/// Throws InputError naming the field.
RunResult resultOf(const JsonValue& json);
/// Parses a line that a worker wrote.
RunResult resultOfLine(const std::string& line);

}  // namespace swept
