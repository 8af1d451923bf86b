// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "models_dir.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::test {

/// One of models/robots, with its SRDF: rook7, ...
inline std::shared_ptr<const Robot> modelRobot(const std::string& name) {
  const std::string urdf = modelsDir() + "/robots/" + name + "/" + name + ".urdf";
  return Robot::load(urdf, Robot::srdfBeside(urdf));
}

}  // namespace swept::test
