// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Joints from the root down to the link.
std::vector<int> pathFromRoot(const std::vector<Link>& links, const std::vector<Joint>& joints,
                              int link);

/// Of these joints those that have variables and a motor, in the robot's order: parents first.
Group makeGroup(const std::string& name, const std::set<int>& joints, int tipLink,
                const std::vector<Joint>& all, const std::vector<Variable>& variables);

}  // namespace swept::detail
