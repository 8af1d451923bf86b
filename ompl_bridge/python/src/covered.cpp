// SPDX-License-Identifier: BSD-3-Clause
#include "covered.hpp"

#include <stop_token>

#include "errors.hpp"
#include "loading.hpp"
#include "spheres.hpp"
#include "swept/robot_model/scene_model.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace py = pybind11;

namespace swept::python {

Covered coveredOf(const py::object& value) {
  if (py::isinstance<RobotHandle>(value)) {
    const auto& robot = value.cast<const RobotHandle&>();
    return {.handle = robot,
            .world = nullptr,
            .source = robot.source,
            .bodies = bodiesOf(*robot.robot),
            .name = robot.robot->name()};
  }
  if (!py::isinstance<WorldHandle>(value))
    throw ArgumentTypeError(std::string("robot: expected a swept.Robot or a swept.World, got ") +
                            Py_TYPE(value.ptr())->tp_name);
  const auto& world = value.cast<const WorldHandle&>();
  const std::string stem = world.source.file.stem().string();
  return {.world = std::make_shared<const World>(world.world),
          .source = world.source,
          .bodies = bodiesOf(world.world),
          .name = stem.empty() ? "scene" : stem};
}

std::string sceneTextOf(const ShapeModel& model, const std::filesystem::path& file,
                        const Covered& covered, const std::stop_token& stop) {
  const std::string ending = endingOf(file);
  if (ending == ".json")
    return sceneModelJson(model, covered.name,
                          judgeShapeModel(covered.bodies, model, {.stop = questionOf(stop)}));
  if (ending == ".yaml" || ending == ".yml")
    return sceneModelYaml(model, *covered.world, covered.name);
  if (ending == ".scene") return sceneModelText(model, *covered.world, covered.name);
  throw UsageError("'" + file.string() + "' ends in '" + ending +
                   "'; allowed for a scene: .json, .yaml, .yml, .scene");
}

ShapeModel shapesOfFile(const std::filesystem::path& file, const Covered& covered) {
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor(covered.source);
  ShapeModel model;
  {
    const py::gil_scoped_release others;
    model = covered.world ? readSceneModel(file, *covered.world, options)
                          : readShapeModel(file, *covered.handle.robot, options);
  }
  remarks.warn();
  return model;
}

}  // namespace swept::python
