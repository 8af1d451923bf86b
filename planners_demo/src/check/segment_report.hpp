// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "input/task.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

/// How `motion` and `certify` print what they know about a motion.
namespace swept {

struct SegmentReport {
  std::string from, to;  ///< labels of its ends
  MotionCertificate certificate;
  std::optional<MotionClearance> clearance;     ///< not asked for where there is a collision
  const TaskConstraint* constraints = nullptr;  ///< which a violation is of
  /// s, of its ends; none: nothing moves but the robot.
  std::optional<std::pair<double, double>> times = {};
};

/// Several lines, with what is known beyond the verdict.
/// `times` of the motion between two states.
std::optional<std::pair<double, double>> timesBetween(const LabelledState& from,
                                                      const LabelledState& to);
std::string segmentText(const SegmentReport& segment);
Json segmentJson(const SegmentReport& segment);

}  // namespace swept
