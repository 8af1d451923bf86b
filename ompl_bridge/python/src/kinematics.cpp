// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <limits>

#include "arrays.hpp"
#include "binding.hpp"
#include "handles.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Kinematics = InverseKinematics;

Kinematics make(const RobotHandle& robot, const std::string& group, const std::string& link,
                const py::object& tool) {
  return {robot.robot, group, link, {}, readPose(tool, "link_from_tool")};
}

Table read(const Kinematics& self, const py::object& q, const char* argument) {
  return readVector(q, argument, static_cast<std::size_t>(self.dimension()));
}

py::object solve(const Kinematics& self, const py::object& pose, const py::object& seed,
                 double positionTolerance, double orientationTolerance, int maxIterations) {
  const Eigen::Isometry3d target = readPose(pose, "pose");
  const Table start = read(self, seed, "seed");
  double* memory = nullptr;
  py::object q = makeDoubles(start.columns(), memory);
  std::ranges::copy(start.numbers(), memory);
  bool found = false;
  {
    const py::gil_scoped_release others;
    Kinematics::Workspace workspace(self);
    found = self.solve(target, ConfigurationSpan(memory, start.columns()),
                       {.positionTolerance = positionTolerance,
                        .orientationTolerance = orientationTolerance,
                        .maxIterations = maxIterations},
                       workspace);
  }
  if (!found) return py::none();
  return q;
}

}  // namespace

void bindKinematics(py::module_& module) {
  const InverseKinematicsOptions usual;
  py::class_<Kinematics> type(module, "InverseKinematics",
                              "Finds configurations of a group that bring a tool, a frame fixed in "
                              "a link, to a pose: damped "
                              "least squares from one seed,\nwithin limits. It ignores collisions. "
                              "Any number of threads may "
                              "use one.");
  type.def(py::init(&make), py::arg("robot"), py::arg("group"), py::arg("link"),
           py::arg("link_from_tool") = py::none(),
           "`link_from_tool`: (4, 4) pose of the tool in the link's frame. Raises ArgumentError "
           "for an "
           "unknown group or link, and a\nlink that the group does not move.")
      .def_property_readonly("dimension", &Kinematics::dimension, "Of a configuration.")
      .def(
          "pose",
          [](const Kinematics& self, const py::object& q) {
            return makeArray(self.pose(read(self, q, "q").row(0)));
          },
          py::arg("q"), "(4, 4) model_from_tool at q (n,).")
      .def(
          "jacobian",
          [](const Kinematics& self, const py::object& q) {
            return makeArray(Eigen::MatrixXd(self.jacobian(read(self, q, "q").row(0))));
          },
          py::arg("q"),
          "(6, degrees of freedom): velocity of the tool's origin (m), then angular velocity "
          "(rad), in "
          "the model frame, per rad or m.")
      .def("solve", &solve, py::arg("pose"), py::arg("seed"), py::kw_only(),
           py::arg("position_tolerance") = usual.positionTolerance,
           py::arg("orientation_tolerance") = usual.orientationTolerance,
           py::arg("max_iterations") = usual.maxIterations,
           "(n,) configuration with the tool at `pose` (4, 4), within the tolerances (m, rad) and "
           "limits. None if this seed (n,) leads to\nnone, which proves nothing.")
      .def("__repr__", [](const Kinematics& self) {
        return "<swept.InverseKinematics of " + self.robot().name() + "/" + self.group().name + ">";
      });
  addImmutableCopies(type);
}

}  // namespace swept::python
