// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "output/text_output.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// The kinematic tree, from which a page computes poses by itself: links, joints, all variables,
/// those of the group, and `reference`, a value for each variable. Without `reference` it holds the
/// default state. Lengths in m, angles in rad. A page's `tree`.
Json treeJson(const Robot& robot, const Group& group,
              const std::optional<Eigen::VectorXd>& reference);

}  // namespace swept
