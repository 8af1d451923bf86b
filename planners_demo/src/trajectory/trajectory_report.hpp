// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "command_line/exit_code.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

/// How `trajectory` and `plan --timed` print what is known about a curve.
namespace swept {

/// What a timing has made of a path.
struct TimingReport {
  std::size_t blended = 0;  ///< corners
  std::size_t stops = 0;    ///< the other corners
  double seconds = 0.0;     ///< s, that it took with its proofs
};

/// A trajectory, as it was read or timed, and what was found.
struct TrajectoryReport {
  std::string label;  ///< empty: it is the only one
  std::size_t points = 0;
  double begin = 0.0, end = 0.0;  ///< s, of the curve
  TrajectoryCertificate certificate;
  std::optional<TimingReport> timing = {};
  const TaskConstraint* constraints = nullptr;  ///< which a violation is of
};

/// Free, and within its limits.
ExitCode codeOf(const TrajectoryCertificate& certificate);

/// Why no file gets a trajectory, or no proof of one; empty: nothing is against it.
std::string reasonNotToWrite(const TrajectoryCertificate& certificate);

/// Several lines.
std::string trajectoryText(const TrajectoryReport& report);
Json trajectoryJson(const TrajectoryReport& report);

}  // namespace swept
