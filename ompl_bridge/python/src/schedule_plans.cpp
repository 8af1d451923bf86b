// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "enums.hpp"
#include "handles.hpp"
#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/robot_model/schedule_checker.hpp"
#include "trajectories.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Names = std::vector<std::string>;
using Curves = std::vector<ScheduledCurve>;
using Tasks = std::vector<ScheduleTask>;

std::vector<double> listOf(const Table& table) {
  return {table.numbers().begin(), table.numbers().end()};
}

ScheduleTask makeTask(std::string group, const py::object& start, const py::list& goals,
                      const RateLimits& limits) {
  const std::size_t size = limits.velocity.size();
  ScheduleTask task{.group = std::move(group),
                    .start = listOf(readVector(start, "start", size)),
                    .goals = {},
                    .limits = limits};
  for (const py::handle goal : goals) task.goals.push_back(listOf(readVector(goal, "goals", size)));
  return task;
}

void bindScheduleTask(py::module_& module) {
  py::class_<ScheduleTask> type(module, "ScheduleTask",
                                "Where one robot of a schedule is, and where it is to go.");
  type.def(py::init(&makeTask), py::arg("group"), py::arg("start"), py::arg("goals"),
           py::arg("limits"),
           "`group`: a name. `start`: (n,) configuration of that group, where it rests at the "
           "clock's time 0. `goals`: a list of such\nconfigurations; it is to rest at one of them. "
           "`limits`: RateLimits of the group, of velocities and accelerations.")
      .def_readonly("group", &ScheduleTask::group, "Name.")
      .def_property_readonly(
          "start", [](const ScheduleTask& self) { return makeArray(self.start); }, "(n,) rad or m.")
      .def_property_readonly(
          "goals",
          [](const ScheduleTask& self) {
            py::list goals;
            for (const std::vector<double>& goal : self.goals) goals.append(makeArray(goal));
            return py::tuple(goals);
          },
          "Of each (n,) rad or m.")
      .def_readonly("limits", &ScheduleTask::limits, "RateLimits.");
  addRepr(type, {"group", "start", "goals"});
  addImmutableCopies(type);
}

void bindPlannedSchedule(py::module_& module) {
  using Plan = PlannedSchedule;
  py::class_<Plan> type(module, "PlannedSchedule",
                        "The result of plan_schedule. True if a schedule is found and proven.");
  type.def_property_readonly(
          "status", [](const Plan& self) { return toPython(self.status); }, "ScheduleStatus.")
      .def_property_readonly(
          "task",
          [](const Plan& self) -> std::optional<std::size_t> {
            if (self.curves.empty()) return self.task;
            return std::nullopt;
          },
          "Index of the task that has no way; None if all have one.")
      .def_readonly("contact", &Plan::contact,
                    "Witness of what is in contact where a start or a goal is not free, if that is "
                    "known; else None.")
      .def_property_readonly(
          "curves", [](const Plan& self) { return py::tuple(py::cast(self.curves)); },
          "ScheduledCurve of each task; its time is the clock's. Empty if there is no schedule.")
      .def_property_readonly(
          "trajectories", [](const Plan& self) { return py::tuple(py::cast(self.trajectories)); },
          "Trajectory of each task, with positions and velocities. Likewise.")
      .def_property_readonly(
          "order", [](const Plan& self) { return py::tuple(py::cast(self.order)); },
          "Indices of the tasks, in the order of their priority.")
      .def_readonly("certificate", &Plan::certificate,
                    "TrajectoryCertificate of all curves together, the known ones too; None "
                    "without a schedule.")
      .def_property_readonly(
          "delays", [](const Plan& self) { return py::tuple(py::cast(self.delays)); },
          "If room for delays was asked for: DelayCertificate of each known curve, then of each "
          "task.")
      .def("__bool__", &Plan::found);
  addRepr(type, {"status", "order", "trajectories"});
  addImmutableCopies(type);
}

PlannedSchedule plan(const CheckerHandle& checker, const Tasks& tasks, const Curves& known,
                     const py::object& still, double seconds, double latest, double delay,
                     double slowest, int improvements, std::uint32_t seed,
                     const std::shared_ptr<CancellationToken>& cancel) {
  std::vector<double> rest;
  if (!still.is_none()) rest = listOf(readVector(still, "still", checker.dimension()));
  PlannedSchedule found;
  runWatched(Watch(std::nullopt, cancel), [&](const std::stop_token& stop) {
    found = planSchedule(checker.checker(), tasks, known, rest,
                         {.seconds = seconds,
                          .latest = latest,
                          .delay = delay,
                          .slowest = slowest,
                          .improvements = improvements,
                          .seed = seed,
                          .stop = stop});
  });
  return found;
}

std::shared_ptr<ScheduleChecker> makeChecker(const CheckerHandle& checker, Names names,
                                             Curves others, const py::object& still,
                                             const Names& ignored, double delay, double slowest) {
  std::vector<double> rest;
  if (!still.is_none()) rest = listOf(readVector(still, "still", checker.dimension()));
  const py::gil_scoped_release released;
  return std::make_shared<ScheduleChecker>(checker.checker(), std::move(names), std::move(others),
                                           rest, ignored, delay, slowest);
}

void bindScheduleChecker(py::module_& module) {
  py::class_<ScheduleChecker, std::shared_ptr<ScheduleChecker>> type(
      module, "ScheduleChecker",
      "Proofs about curves of some variables while others move on known curves, for planners. It "
      "asks about the pairs that the own variables\nmove, and about no others. Any number of "
      "threads may use one.");
  type.def(py::init(&makeChecker), py::arg("checker"), py::arg("variable_names"),
           py::arg("others") = Curves(), py::kw_only(), py::arg("still") = py::none(),
           py::arg("ignored") = Names(), py::arg("delay") = 0.0, py::arg("slowest") = 1.0,
           "`checker`: of a group that has all variables. `variable_names`: the own ones. "
           "`others`: a list of ScheduledCurve, none of an own\nvariable. `still`: (n,) "
           "configuration of the group, for variables that no curve moves. `ignored`: names of "
           "variables about which nothing is\nknown yet: pairs that they move against the own ones "
           "are left out. `delay`: s; what is proven holds also if the own curve, or all of the\n"
           "others, start late by up to so much. `slowest`: factor; likewise if these take up to "
           "so many times as long. Raises ArgumentError for names\nthat are unknown or have no "
           "value, for a delay that is negative, and for a slowest factor below 1.")
      .def(
          "certify",
          [](const ScheduleChecker& self, const py::object& curve, const py::object& query) {
            const PiecewisePolynomial own = curveOf(curve, "curve", self.variables());
            const MotionQuery how =
                query.is_none() ? MotionQuery::FirstContact : motionQueryOf(query, "query");
            const py::gil_scoped_release released;
            Workspace workspace(self.checker());
            return self.certify(own, workspace, how);
          },
          py::arg("curve"), py::arg("query") = py::none(),
          "TrajectoryCertificate from the begin to the end of `curve`, a Curve or Trajectory of "
          "the own variables, in their order, whose time is the clock's.\nRaises ArgumentError for "
          "other variables, for another number of values, and for a curve that begins before the "
          "clock's time 0.")
      .def_property_readonly(
          "variable_names",
          [](const ScheduleChecker& self) { return py::tuple(py::cast(self.variables())); },
          "The own ones.")
      .def_property_readonly("end", &ScheduleChecker::end,
                             "s: from here on nothing but the own variables moves.");
  addRepr(type, {"variable_names", "end"});
  addImmutableCopies(type);
}

}  // namespace

void bindSchedulePlans(py::module_& module) {
  bindScheduleChecker(module);
  bindScheduleTask(module);
  bindPlannedSchedule(module);
  const SchedulePlanOptions usual;
  module.def(
      "plan_schedule", &plan, py::arg("checker"), py::arg("tasks"), py::arg("known") = Curves(),
      py::kw_only(), py::arg("still") = py::none(), py::arg("seconds") = usual.seconds,
      py::arg("latest") = usual.latest, py::arg("delay") = usual.delay,
      py::arg("slowest") = usual.slowest, py::arg("improvements") = usual.improvements,
      py::arg("seed") = usual.seed, py::arg("cancel") = py::none(),
      "PlannedSchedule: plans the ways of one or several robots on one clock, a list of "
      "ScheduleTask, beside `known`, a list of ScheduledCurve,\nand beside moving obstacles. The "
      "first has priority. `still`: (n,) configuration of the checker's group, for variables that "
      "are neither\nof a task nor of a known curve. `seconds`: s, for the search. `latest`: s, "
      "when "
      "the last one rests at its goal. `delay`: s, by which each may\nstart late, one at a time. "
      "`slowest`: factor; likewise each may take up to so many times as long. "
      "`improvements`: changes of each robot's\nway that are tried. The same arguments give the "
      "same schedule, if it is found well before the time is up. Raises Cancelled when the token "
      "`cancel` is cancelled; Ctrl-C ends it, too. Raises ArgumentError for a\ngroup that is "
      "unknown or shared by two tasks, values beyond limits, and limits that are missing.");
}

}  // namespace swept::python
