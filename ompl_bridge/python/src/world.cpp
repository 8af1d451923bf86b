// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/world.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.hpp"
#include "binding.hpp"
#include "bodies.hpp"
#include "handles.hpp"
#include "loading.hpp"
#include "shapes.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

WorldHandle load(const Source& source) {
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor(source);
  WorldHandle handle{.world = {}, .source = source, .changed = false};
  {
    const py::gil_scoped_release others;
    handle.world = World::load(source.file, options);
  }
  remarks.warn();
  return handle;
}

WorldHandle loadFile(const std::filesystem::path& file, const py::object& packages,
                     const std::string& modelFrame, bool childProcess) {
  return load(sourceOf(file, py::none(), packages, py::none(), modelFrame, childProcess));
}

py::tuple stateOf(const WorldHandle& self) {
  if (self.changed && !(self.world.bodies().empty() && self.world.obstacles().empty()))
    throw UsageError(
        "a World is pickled by its file, and this one has bodies that are in no file: pickle what "
        "it is made of, and make it anew");
  const Source& source = self.changed ? Source{} : self.source;
  return py::make_tuple(toPython(source.file), source.packages, source.modelFrame,
                        source.childProcess);
}

WorldHandle fromState(const py::tuple& state) {
  const std::filesystem::path file = pathOf(state[0]);
  if (file.empty()) return {};
  return load({.file = file,
               .srdf = {},
               .packages = state[1].cast<decltype(Source::packages)>(),
               .cache = {},
               .modelFrame = state[2].cast<std::string>(),
               .childProcess = state[3].cast<bool>()});
}

py::tuple namesOf(const World& world) {
  py::list names;
  for (const WorldBody& body : world.bodies()) names.append(body.name);
  for (const MovingObstacle& obstacle : world.obstacles()) names.append(obstacle.name);
  return py::tuple(names);
}

std::size_t sizeOf(const World& world) {
  return world.bodies().size() + world.obstacles().size();
}

}  // namespace

void bindWorld(py::module_& module) {
  py::class_<WorldHandle>(
      module, "World",
      "The obstacles around a robot, in its model frame. A Checker copies it: to change what a "
      "checker has, use its `with_...`\nfunctions.")
      .def(py::init<>(), "Without a body.")
      .def_static(
          "load", &loadFile, py::arg("file"), py::kw_only(), py::arg("packages") = py::none(),
          py::arg("model_frame") = "", py::arg("child_process") = true,
          "Reads a planning scene (.yaml, .scene) or a URDF. `packages`, `child_process`: see "
          "Robot.load. `model_frame`: a name of the\nrobot's model frame in the file. Raises "
          "InputError.")
      .def(
          "add",
          [](WorldHandle& self, const std::string& name, const py::object& shape,
             const py::object& pose) {
            self.world.add(bodyOf(name, shape, pose));
            self.changed = true;
          },
          py::arg("name"), py::arg("shape"), py::arg("pose") = py::none(),
          "Adds a body: a Shape, or a list of pairs of a Shape and its pose. `pose`: (4, 4), in "
          "the model frame.\nRaises ArgumentError for a name that is taken and a pose that is not "
          "rigid.")
      .def(
          "add_obstacle",
          [](WorldHandle& self, const std::string& name, const py::object& shape,
             const py::object& times, const py::object& poses) {
            self.world.add(obstacleOf(name, shape, times, poses));
            self.changed = true;
          },
          py::arg("name"), py::arg("shape"), py::arg("times"), py::arg("poses"),
          "Adds a moving obstacle, with its poses, a (4, 4) each, at times (n,) in s. A "
          "configuration then has one more\nvalue, the time.")
      .def(
          "replace",
          [](WorldHandle& self, const std::string& name, const py::object& shape,
             const py::object& pose) {
            self.world.replace(bodyOf(name, shape, pose));
            self.changed = true;
          },
          py::arg("name"), py::arg("shape"), py::arg("pose") = py::none(),
          "Replaces a body. Raises ArgumentError for a name that no body has.")
      .def(
          "remove",
          [](WorldHandle& self, const std::string& name) {
            if (!self.world.remove(name))
              throw std::invalid_argument("the world has no body '" + name + "'");
            self.changed = true;
          },
          py::arg("name"),
          "Removes a body or moving obstacle. Raises ArgumentError for an unknown name.")
      .def_property_readonly(
          "names", [](const WorldHandle& self) { return namesOf(self.world); },
          "Of bodies and moving obstacles.")
      .def("__len__", [](const WorldHandle& self) { return sizeOf(self.world); })
      .def("__contains__",
           [](const WorldHandle& self, const std::string& name) {
             return self.world.find(name) != nullptr || self.world.findObstacle(name) != nullptr;
           })
      .def("__iter__", [](const WorldHandle& self) { return py::iter(namesOf(self.world)); })
      .def("__copy__", [](const WorldHandle& self) { return self; })
      .def("__deepcopy__", [](const WorldHandle& self, const py::dict&) { return self; })
      .def("__repr__",
           [](const WorldHandle& self) {
             const std::size_t size = sizeOf(self.world);
             return "<swept.World of " + std::to_string(size) + (size == 1 ? " body>" : " bodies>");
           })
      .def(py::pickle(&stateOf, &fromState));
}

}  // namespace swept::python
