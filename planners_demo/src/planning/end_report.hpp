// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "input/task.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// Two bodies in contact in a state, and how deep.
struct EndContact {
  std::string bodyA, bodyB;
  double depth;  ///< m, proven upper bound of the shortest translation that separates the two; 0 or
                 ///< less: they are nearer than their margin but do not overlap
  double margin;  ///< m, what the two have to keep
  bool inTube;    ///< of a state within the tolerances of joints, beside the one that is asked for
  Eigen::Vector3d point;  ///< m, model frame: on or in both, or between them
};

/// Why a state can, or cannot, be an end of a path.
struct EndReport {
  std::string label;
  std::vector<double> q;
  Verdict verdict = Verdict::Undecided;
  std::vector<EndContact> contacts = {};
  std::vector<std::string> violations = {};  ///< of constraints, in words
};

EndReport reportEnd(const Checker& checker, const LabelledState& state, Workspace& workspace);

/// `off a constraint`, `in collision`, `closer than the margin` where no two bodies touch,
/// `undecided` or `free`.
std::string_view whatIs(const EndReport& report);

/// `start is in collision: hand - shelf (0.01 m deep, at [0.1 0 0.5]), ...`, or `start is closer
/// than the margin: hand - shelf (0.004 m apart, margin 0.01 m, at [0.1 0 0.5])` where no two
/// bodies touch; empty for a free one.
std::string endText(const EndReport& report);
Json endJson(const EndReport& report);

}  // namespace swept
