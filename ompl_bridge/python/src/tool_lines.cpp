// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "arrays.hpp"
#include "binding.hpp"
#include "enums.hpp"
#include "handles.hpp"
#include "swept/robot_model/tool_line.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// swept.ToolLineStop.
struct StopHandle {
  ToolLineStop stop;
  std::string text;  ///< in words
};

/// swept.ToolLine.
struct LineHandle {
  ToolLine line;
  std::size_t dimension;
  std::optional<StopHandle> stop;
};

/// swept.ToolLinePlanner.
struct PlannerHandle {
  ToolLinePlanner planner;

  std::size_t dimension() const { return static_cast<std::size_t>(planner.checker().dimension()); }
};

PlannerHandle makePlanner(const CheckerHandle& checker, const std::string& link,
                          const py::object& tool) {
  return {ToolLinePlanner(checker.shared(), {link, readPose(tool, "link_from_tool")})};
}

LineHandle follow(const PlannerHandle& self, const Table& start, const Eigen::Isometry3d& goal,
                  ToolLineOptions options, const Watch& watch) {
  const Checker& checker = self.planner.checker();
  LineHandle found{{}, self.dimension(), {}};
  runWatched(watch, [&](const std::stop_token& stop) {
    options.stop = stop;
    Workspace workspace(checker);
    found.line = self.planner.plan(start.row(0), goal, workspace, options);
  });
  if (found.line.stop)
    found.stop =
        StopHandle{*found.line.stop, describe(*found.line.stop, checker.options().constraints)};
  return found;
}

LineHandle planTo(const PlannerHandle& self, const py::object& start, const py::object& goal,
                  double position, double angle, double leastStep, int maxWayPoints,
                  std::optional<double> seconds, const Token& cancel) {
  const Watch watch(seconds, cancel);
  const Table from = readVector(start, "start", self.dimension());
  return follow(self, from, readPose(goal, "goal"), {position, angle, leastStep, maxWayPoints},
                watch);
}

LineHandle planBy(const PlannerHandle& self, const py::object& start,
                  const py::object& displacement, bool inTool, double position, double angle,
                  double leastStep, int maxWayPoints, std::optional<double> seconds,
                  const Token& cancel) {
  const Watch watch(seconds, cancel);
  const Table from = readVector(start, "start", self.dimension());
  const Eigen::Vector3d by = readPoint(displacement, "displacement");
  Eigen::Isometry3d model_from_tool = self.planner.pose(from.row(0));
  model_from_tool.translation() += inTool ? Eigen::Vector3d(model_from_tool.linear() * by) : by;
  return follow(self, from, model_from_tool, {position, angle, leastStep, maxWayPoints}, watch);
}

void bindStop(py::module_& module) {
  py::class_<StopHandle> type(module, "ToolLineStop",
                              "Why a path does not follow its line to the end.");
  type.def_property_readonly(
          "reason", [](const StopHandle& self) { return toPython(self.stop.reason); }, "LineStop.")
      .def_property_readonly(
          "share", [](const StopHandle& self) { return self.stop.share; },
          "Of the line, in [0, 1]: where that is, at or beyond ToolLine.share.")
      .def_property_readonly(
          "variable",
          [](const StopHandle& self) -> py::object {
            if (self.stop.variable.empty()) return py::none();
            return py::str(self.stop.variable);
          },
          "Its name for LIMIT; else None.")
      .def_property_readonly(
          "least_singular_value",
          [](const StopHandle& self) { return self.stop.leastSingularValue; },
          "Of the tool's Jacobian at the last way point, m or rad per rad or m, for LIMIT, "
          "SINGULARITY, JUMP and UNREACHABLE; else 0.")
      .def_property_readonly(
          "joint_step", [](const StopHandle& self) { return self.stop.jointStep; },
          "For SINGULARITY and JUMP: what the variable that changes most would have to, rad or m "
          "per m of the tool's motion (of a line without\nlength: per rad); 0 otherwise, or if no "
          "solution was found.")
      .def_property_readonly(
          "witness",
          [](const StopHandle& self) -> py::object {
            if (!self.stop.contact) return py::none();
            return py::cast(*self.stop.contact);
          },
          "Witness for CONTACT, its t the share of the line; else None.")
      .def_property_readonly(
          "violation",
          [](const StopHandle& self) -> py::object {
            if (!self.stop.violation) return py::none();
            return py::cast(*self.stop.violation);
          },
          "ConstraintViolation for VIOLATION, its t the share of the line; else None.")
      .def("__str__", [](const StopHandle& self) { return self.text; })
      .def("__repr__",
           [](const StopHandle& self) { return "<swept.ToolLineStop " + self.text + ">"; });
  addImmutableCopies(type);
}

void bindLine(py::module_& module) {
  py::class_<LineHandle> type(
      module, "ToolLine",
      "The part of a tool's straight motion that is proven, as a path of the group. True if all of "
      "it is.");
  type.def_property_readonly(
          "path",
          [](const LineHandle& self) { return makeArray(self.line.wayPoints, self.dimension); },
          "(m, n) way points, rad or m: the first is the start, the last is at `share`.")
      .def_property_readonly(
          "shares", [](const LineHandle& self) { return makeArray(self.line.shares); },
          "(m,) of the line, in [0, 1], increasing: where the way points are.")
      .def_property_readonly(
          "share", [](const LineHandle& self) { return self.line.share; },
          "The largest proven part is [0, share]. 1: all of it.")
      .def_property_readonly(
          "complete", [](const LineHandle& self) { return self.line.complete(); },
          "Whether all of the line is proven.")
      .def_property_readonly(
          "stop",
          [](const LineHandle& self) -> py::object {
            if (!self.stop) return py::none();
            return py::cast(*self.stop);
          },
          "ToolLineStop, exactly if the line is not complete; else None.")
      .def_property_readonly(
          "start_pose",
          [](const LineHandle& self) { return makeArray(self.line.model_from_start); },
          "(4, 4) model_from_tool at the start.")
      .def_property_readonly(
          "goal_pose", [](const LineHandle& self) { return makeArray(self.line.model_from_goal); },
          "(4, 4) model_from_tool at the end of the line.")
      .def_property_readonly(
          "length", [](const LineHandle& self) { return self.line.length; }, "m, of the line.")
      .def_property_readonly(
          "turn", [](const LineHandle& self) { return self.line.turn; },
          "rad in [0, pi], between the orientations at its ends.")
      .def_property_readonly(
          "position", [](const LineHandle& self) { return self.line.position; },
          "m, proven: the tool's origin is never farther off.")
      .def_property_readonly(
          "angle", [](const LineHandle& self) { return self.line.angle; },
          "rad, proven: its orientation is never farther off; 0 if any is allowed.")
      .def_property_readonly(
          "solved", [](const LineHandle& self) { return self.line.solved; },
          "Effort: solutions of the inverse kinematics.")
      .def("__bool__", [](const LineHandle& self) { return self.line.complete(); })
      .def("__repr__", [](const LineHandle& self) {
        return "<swept.ToolLine of " + std::to_string(self.line.wayPoints.size()) +
               " way points, share " + std::string(py::str(py::float_(self.line.share))) +
               (self.stop ? ": " + self.stop->text : std::string()) + ">";
      });
  addImmutableCopies(type);
}

}  // namespace

void bindToolLines(py::module_& module) {
  bindStop(module);
  bindLine(module);
  const ToolLineOptions usual;
  py::class_<PlannerHandle> type(
      module, "ToolLinePlanner",
      "Follows straight lines with a tool, a frame that is fixed in a link or an attached body, in "
      "chords: straight motions of the joints,\neach proven free and never farther off the line "
      "than is allowed. A redundant arm moves by the least joint motion. Any number of\nthreads "
      "may use one.");
  type.def(py::init(&makePlanner), py::arg("checker"), py::arg("link"),
           py::arg("link_from_tool") = py::none(),
           "`link`: or an attached body. `link_from_tool`: (4, 4) pose of the tool in it. Raises "
           "ArgumentError for a world with moving obstacles,\nan unknown link, a pose that is not "
           "rigid, and a link that the group does not move.")
      .def_property_readonly(
          "dimension", [](const PlannerHandle& self) { return self.dimension(); },
          "Of a configuration.")
      .def(
          "pose",
          [](const PlannerHandle& self, const py::object& q) {
            return makeArray(self.planner.pose(readVector(q, "q", self.dimension()).row(0)));
          },
          py::arg("q"), "(4, 4) model_from_tool at q (n,).")
      .def("plan", &planTo, py::arg("start"), py::arg("goal"), py::kw_only(),
           py::arg("position") = usual.position, py::arg("angle") = usual.angle,
           py::arg("least_step") = usual.leastStep, py::arg("max_way_points") = usual.maxWayPoints,
           py::arg("seconds") = py::none(), py::arg("cancel") = py::none(),
           "ToolLine from the tool's pose at `start` (n,) to `goal` (4, 4), model_from_tool. "
           "`position` (m) and `angle` (rad; pi and more: any\norientation): how far the tool may "
           "be off the line. `least_step`: m along the line, or rad of its turn if that is more; a "
           "chord so short\nthat cannot be proven ends the path. `max_way_points`: a longer path "
           "ends as UNDECIDED. Raises Cancelled after `seconds`, or\nwhen the token `cancel` is "
           "cancelled; Ctrl-C ends it, too. Raises ArgumentError for a goal that is not rigid and "
           "values out of range. A start in contact is no error: the share is then 0.")
      .def("plan_by", &planBy, py::arg("start"), py::arg("displacement"), py::kw_only(),
           py::arg("in_tool") = false, py::arg("position") = usual.position,
           py::arg("angle") = usual.angle, py::arg("least_step") = usual.leastStep,
           py::arg("max_way_points") = usual.maxWayPoints, py::arg("seconds") = py::none(),
           py::arg("cancel") = py::none(),
           "The same by a displacement (3,) m without a turn, along the axes of the model frame; "
           "`in_tool`: of the tool at the start.")
      .def("__repr__", [](const PlannerHandle& self) {
        return "<swept.ToolLinePlanner of " + self.planner.checker().robot().name() + "/" +
               self.planner.checker().group().name + ">";
      });
  addImmutableCopies(type);
}

}  // namespace swept::python
