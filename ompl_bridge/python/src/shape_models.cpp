// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/shape_model.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <system_error>
#include <vector>

#include "binding.hpp"
#include "covered.hpp"
#include "enums.hpp"
#include "errors.hpp"
#include "loading.hpp"
#include "spheres.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

ShapeModel modelOfShapes(const py::dict& links) {
  ShapeModel model;
  for (const auto& [link, shapes] : links)
    model.links.push_back({valueOf<std::string>(link, "links", "names of links"),
                           posedOf(py::reinterpret_borrow<py::object>(shapes))});
  return model;
}

py::list shapesOf(const ShapeModel& model, const std::string& name) {
  if (const LinkShapes* link = model.find(name)) return listOf(link->shapes);
  throw std::invalid_argument("the model has no shapes for a link '" + name + "'");
}

ShapeModel searchShapes(const py::object& robot, const py::object& kind, std::optional<int> shapes,
                        std::optional<double> excess, int pieces, unsigned threads,
                        const Token& cancel) {
  if (shapes.has_value() == excess.has_value())
    throw std::invalid_argument("expected one of shapes and excess");
  const EnclosingKind of = enclosingKindOf(kind, "kind");
  const Covered covered = coveredOf(robot);
  return watched(cancel, [&](const std::stop_token& stop) {
    const ShapeModelOptions options{.kind = of,
                                    .shapes = shapes,
                                    .excess = excess,
                                    .search = {pieces},
                                    .threads = threads,
                                    .stop = stop};
    return covered.world ? enclosingShapeModel(covered.bodies, options)
                         : enclosingShapeModel(*covered.handle.robot, options);
  });
}

ShapeModel loadShapes(const std::filesystem::path& file, const py::object& robot) {
  return shapesOfFile(file, coveredOf(robot));
}

void saveUrdf(const ShapeModel& self, const std::filesystem::path& file, const RobotHandle& robot) {
  const std::string urdf = urdfOf(robot).string(), folder = file.stem().string() + "_meshes";
  const ShapedUrdf shaped = urdfWithShapes(self, readTextFile(urdf), urdf, folder + "/");
  std::error_code failed;
  if (!shaped.meshes.empty())
    std::filesystem::create_directories(file.parent_path() / folder, failed);
  if (failed)
    throw UsageError("'" + (file.parent_path() / folder).string() +
                     "' cannot be made: " + failed.message());
  for (const auto& [name, text] : shaped.meshes) writeText(file.parent_path() / name, text);
  writeText(file, shaped.text);
}

void saveShapes(const ShapeModel& self, const std::filesystem::path& file,
                const py::object& robot) {
  const Covered covered = coveredOf(robot);
  const std::string ending = endingOf(file);
  if (!covered.world && ending == ".urdf") {
    const py::gil_scoped_release others;
    return saveUrdf(self, file, covered.handle);
  }
  if (!covered.world && ending != ".json")
    throw UsageError("'" + file.string() + "' ends in '" + ending + "'; allowed: .urdf, .json");
  const std::string text = watched(nullptr, [&](const std::stop_token& stop) {
    return covered.world
               ? sceneTextOf(self, file, covered, stop)
               : shapeModelJson(self, covered.name,
                                judgeShapeModel(covered.bodies, self, {.stop = questionOf(stop)}));
  });
  const py::gil_scoped_release others;
  writeText(file, text);
}

}  // namespace

void bindShapeModels(py::module_& module) {
  const EnclosingShapesOptions usual;
  const OutsideSpheresOptions judged;
  py::class_<ShapeModel> type(
      module, "ShapeModel",
      "Few capsules, boxes or convex hulls for the links of a robot, beside SphereModel: made with "
      "proof, read and judged. `model[link]` is a list of\npairs of a Shape and its pose (4, 4) in "
      "the link's frame. In place of a Robot, all methods take a World, as those of "
      "SphereModel.");
  type.def(py::init(&modelOfShapes), py::arg("links"),
           "`links`: a Shape, or a list of pairs of a Shape and its pose, by the name of the link.")
      .def_static(
          "search", &searchShapes, py::arg("robot"), py::arg("kind"), py::kw_only(),
          py::arg("shapes") = py::none(), py::arg("excess") = py::none(),
          py::arg("pieces") = usual.pieces, py::arg("threads") = 0, py::arg("cancel") = py::none(),
          "Shapes of one EnclosingKind which together contain all collision geometry of the robot, "
          "proven; closed meshes with their inside. Either `shapes`:\ntheir number, divided so "
          "that "
          "the largest reach beyond a link is small; or `excess`: m, each link gets as many as "
          "this "
          "reach needs. `pieces`: as in\nEnclosingShapesSearch; the result does not depend on "
          "`threads`. Ctrl-C and `cancel` end it. Raises ArgumentError, and UsageError for fewer "
          "shapes than links with "
          "geometry.")
      .def_static(
          "load", &loadShapes, py::arg("file"), py::arg("robot"),
          "Reads shapes for a Robot: of `save`; .urdf with any collision geometry that "
          "outside_shapes takes; and files of SphereModel. For a World: .json of `save`, or a "
          "scene with the same bodies. Raises InputError.")
      .def("save", &saveShapes, py::arg("file"), py::arg("robot"),
           "Writes a .json; or .urdf, the robot's with these for `<collision>`: a capsule is a "
           "cylinder and two spheres, a hull a mesh in the folder NAME_meshes\nbeside it. Of a "
           "World: a .json, or a planning scene as .yaml, .yml or MoveIt's .scene. Raises "
           "UsageError for another ending and a file that cannot be written, and ArgumentError for "
           "other shapes than spheres, boxes,\ncylinders, capsules and hulls.")
      .def(
          "judge",
          [](const ShapeModel& self, const py::object& robot, double tolerance, int mostSplits,
             int samples, unsigned threads, const Token& cancel) {
            const Covered covered = coveredOf(robot);
            return py::tuple(py::cast(watched(cancel, [&](const std::stop_token& stop) {
              return judgeShapeModel(covered.bodies, self,
                                     {tolerance, mostSplits, samples, questionOf(stop)}, threads);
            })));
          },
          py::arg("robot"), py::kw_only(), py::arg("tolerance") = judged.tolerance,
          py::arg("most_splits") = judged.mostSplits, py::arg("samples") = judged.samples,
          py::arg("threads") = 0, py::arg("cancel") = py::none(),
          "A LinkSphereReport for each link of a Robot with collision geometry, or each body of a "
          "World: of shapes in place of spheres. Arguments as outside_shapes.")
      .def_property_readonly(
          "links",
          [](const ShapeModel& self) {
            py::tuple names(self.links.size());
            for (std::size_t i = 0; i < names.size(); ++i) names[i] = self.links[i].link;
            return names;
          },
          "Names of the links with shapes.")
      .def("__getitem__", &shapesOf, py::arg("link"))
      .def("__len__", &ShapeModel::count)
      .def("__repr__", [](const ShapeModel& self) {
        return "<swept.ShapeModel of " + std::to_string(self.links.size()) + " links, " +
               std::to_string(self.count()) + " shapes>";
      });
  addImmutableCopies(type);
}

}  // namespace swept::python
