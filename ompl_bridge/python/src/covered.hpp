// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "handles.hpp"
#include "swept/robot_model/shape_model.hpp"
#include "watch.hpp"

namespace swept::python {

/// What a model is around: a swept.Robot, or a swept.World, whose bodies take the place of links.
struct Covered {
  RobotHandle handle = {};             ///< of a robot
  std::shared_ptr<const World> world;  ///< a copy; null: a robot
  Source source;
  std::vector<NamedBody> bodies;
  std::string name = {};  ///< of the robot or the scene
};

/// Throws ArgumentTypeError for anything else. Needs the GIL.
Covered coveredOf(const pybind11::object& value);

/// The text of a file with a world's model: .json, .yaml, .yml or .scene. Throws UsageError for
/// another ending.
std::string sceneTextOf(const ShapeModel& model, const std::filesystem::path& file,
                        const Covered& covered, const std::stop_token& stop);

/// Reads shapes for the links or bodies, and warns of remarks. Needs the GIL.
ShapeModel shapesOfFile(const std::filesystem::path& file, const Covered& covered);

}  // namespace swept::python
