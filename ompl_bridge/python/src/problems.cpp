// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/problems.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "goals.hpp"
#include "handles.hpp"
#include "loading.hpp"
#include "swept/robot_model/planning_request.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

py::dict dictOf(const PlanningRequest::JointValues& values) {
  py::dict result;
  for (const auto& [name, value] : values) result[py::str(name)] = value;
  return result;
}

/// swept.PlanningRequest.
struct RequestHandle {
  PlanningRequest request;
  PlanningRequest::JointValues start;
};

RequestHandle loadRequest(const std::filesystem::path& file, const RobotHandle& robot) {
  Remarks remarks;
  LoadOptions options = remarks.optionsFor(robot.source);
  options.modelFrame = robot.robot->modelFrame();
  RequestHandle handle;
  {
    const py::gil_scoped_release others;
    handle.request = PlanningRequest::load(file, *robot.robot, options);
    handle.start = handle.request.startOf(*robot.robot);
  }
  remarks.warn();
  return handle;
}

void bindRequest(py::module_& module) {
  py::class_<RequestHandle> type(
      module, "PlanningRequest",
      "A start, goals and constraints of a path, in the layout of moveit_msgs/MotionPlanRequest.");
  type.def_static("load", &loadRequest, py::arg("file"), py::arg("robot"),
                  "Reads a YAML file for a Robot. Raises InputError for what is wrong, and for "
                  "what cannot be kept.")
      .def_property_readonly(
          "group",
          [](const RequestHandle& self) -> py::object {
            if (self.request.group.empty()) return py::none();
            return py::str(self.request.group);
          },
          "Its name; None: the request has none.")
      .def_property_readonly(
          "start", [](const RequestHandle& self) { return dictOf(self.start); },
          "Values (rad, m) of the start state by name, bases too; also of joints outside the "
          "group, if it has some.")
      .def_property_readonly(
          "goals",
          [](const RequestHandle& self) {
            py::tuple goals(self.request.goals.size());
            for (std::size_t i = 0; i < goals.size(); ++i) goals[i] = dictOf(self.request.goals[i]);
            return goals;
          },
          "Values (rad, m) by name; the planner may reach any of them, or of `pose_goals`.")
      .def_property_readonly(
          "pose_goals",
          [](const RequestHandle& self) {
            py::tuple goals(self.request.poseGoals.size());
            for (std::size_t i = 0; i < goals.size(); ++i) {
              const PlanningRequest::PoseGoal& goal = self.request.poseGoals[i];
              goals[i] = PoseTarget{goal.link, goal.model_from_link, Eigen::Isometry3d::Identity(),
                                    goal.positionTolerance, goal.orientationTolerance};
            }
            return goals;
          },
          "A PoseGoal each.")
      .def_property_readonly(
          "path_constraints",
          [](const RequestHandle& self) { return self.request.pathConstraints; },
          "TaskConstraint that the whole path has to keep.")
      .def_property_readonly(
          "attached",
          [](const RequestHandle& self) { return py::tuple(py::cast(self.request.attached)); },
          "The AttachedBody of the start state.")
      .def_property_readonly(
          "rules", [](const RequestHandle& self) { return self.request.rules; },
          "CollisionRules that allow attached bodies which may touch each other.");
  addRepr(type, {"group", "start", "goals", "pose_goals", "path_constraints"});
  addImmutableCopies(type);
}

void bindProblem(py::module_& module) {
  py::class_<PlanningProblem> type(module, "PlanningProblem",
                                   "A start, goals and a world for some joints of a robot.");
  type.def_readonly("set", &PlanningProblem::set, "The name of its set.")
      .def_readonly("index", &PlanningProblem::index, "Its number in the set.")
      .def_property_readonly(
          "world", [](const PlanningProblem& self) { return WorldHandle{.world = self.world}; },
          "The World around the robot, model frame.")
      .def_property_readonly(
          "joint_names",
          [](const PlanningProblem& self) { return py::tuple(py::cast(self.jointNames)); },
          "(n,) of start and goals.")
      .def_property_readonly(
          "start", [](const PlanningProblem& self) { return makeArray(self.start); },
          "(n,) rad or m, in the order of joint_names.")
      .def_property_readonly(
          "goals",
          [](const PlanningProblem& self) { return makeArray(self.goals, self.jointNames.size()); },
          "(k, n) likewise.");
  addRepr(type, {"set", "index"});
  addImmutableCopies(type);
}

}  // namespace

void bindProblems(py::module_& module) {
  bindRequest(module);
  bindProblem(module);
  py::class_<ProblemFile> type(module, "ProblemFile",
                               "Problems of MotionBenchMaker in one JSON file, by set and number.");
  type.def_static(
          "load",
          [](const std::filesystem::path& file) {
            const py::gil_scoped_release others;
            return ProblemFile::load(file);
          },
          py::arg("file"), "Reads a file. Raises InputError.")
      .def_property_readonly(
          "sets", [](const ProblemFile& self) { return py::tuple(py::cast(self.sets())); },
          "Names of the sets that have problems.")
      .def(
          "indices",
          [](const ProblemFile& self, const std::string& set) {
            return py::tuple(py::cast(self.indices(set)));
          },
          py::arg("set"), "Numbers of a set's problems, in the order of the file.")
      .def("problem", &ProblemFile::problem, py::arg("set"), py::arg("index"),
           "A PlanningProblem. Raises InputError, which lists the nearest, for one that there is "
           "not.");
  addRepr(type, {"sets"});
  addImmutableCopies(type);
}

}  // namespace swept::python
