// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/full_state.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "kinematics/motion_model.hpp"
#include "robot/joint_types.hpp"

namespace swept::detail {

void requireFullState(const Robot& robot, const Eigen::Ref<const Eigen::VectorXd>& state,
                      const std::string& who, const std::string& what) {
  const auto refuse = [&](const std::string& text) {
    throw std::invalid_argument(who + ": " + text);
  };
  if (state.size() != static_cast<Eigen::Index>(robot.variables().size())) {
    refuse(what + " has " + std::to_string(state.size()) + " values instead of " +
           std::to_string(robot.variables().size()));
  }
  for (Eigen::Index v = 0; v < state.size(); ++v) {
    if (!std::isfinite(state[v]))
      refuse("'" + robot.variables()[static_cast<std::size_t>(v)].name + "' of " + what +
             " is not finite");
  }
  for (const Joint& joint : robot.joints()) {
    const std::optional<int> place = quaternionPlace(joint.type);
    if (place && !hasDirection(state.data() + joint.firstVariable + *place))
      refuse("the quaternion of joint '" + joint.name + "' has no direction");
  }
}

}  // namespace swept::detail
