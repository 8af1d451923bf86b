// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "enums.hpp"
#include "handles.hpp"
#include "swept/robot_model/schedule.hpp"
#include "trajectories.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Names = std::vector<std::string>;
using Curves = std::vector<ScheduledCurve>;

ScheduledCurve makeScheduled(const py::object& trajectory, const std::optional<Names>& names,
                             double start, double slowdown) {
  ScheduledCurve made{.variables = names.value_or(Names()),
                      .curve = curveOf(trajectory, "trajectory"),
                      .start = start,
                      .slowdown = slowdown};
  if (names) return made;
  if (!py::isinstance<JointTrajectory>(trajectory))
    throw std::invalid_argument(
        "variable_names: a swept.Curve needs a name for each of its values");
  made.variables = trajectory.cast<const JointTrajectory&>().variables;
  return made;
}

void bindScheduled(py::module_& module) {
  py::class_<ScheduledCurve> type(
      module, "ScheduledCurve",
      "A curve of some of a group's variables, on a clock that it shares with others. Before it "
      "begins, its joints rest where it begins, and\nafterwards where it ends.");
  type.def(py::init(&makeScheduled), py::arg("trajectory"), py::arg("variable_names") = py::none(),
           py::kw_only(), py::arg("start") = 0.0, py::arg("slowdown") = 1.0,
           "`trajectory`: a Trajectory, or a Curve with `variable_names`, one for each of its "
           "values. `start`: s, 0 or later, what the clock\nshows at the curve's time 0. "
           "`slowdown`: on the clock the curve takes so many times as long as it would alone. "
           "Values out of range are\nrefused where the curve is used.")
      .def_property_readonly(
          "variable_names",
          [](const ScheduledCurve& self) { return py::tuple(py::cast(self.variables)); },
          "In the order of the curve's values.")
      .def_readonly("curve", &ScheduledCurve::curve, "Curve, in a time of its own.")
      .def_readonly("start", &ScheduledCurve::start, "s, of the clock.")
      .def_readonly("slowdown", &ScheduledCurve::slowdown, "Factor.");
  addRepr(type, {"variable_names", "curve", "start", "slowdown"});
  addImmutableCopies(type);
}

/// A configuration of the checker's group, or none.
std::vector<double> stillOf(const CheckerHandle& checker, const py::object& still) {
  if (still.is_none()) return {};
  const Table table = readVector(still, "still", checker.dimension());
  return {table.numbers().begin(), table.numbers().end()};
}

CombinedCurve combine(const CheckerHandle& checker, const Curves& curves, const py::object& still) {
  const std::vector<double> rest = stillOf(checker, still);
  const py::gil_scoped_release others;
  return combinedCurve(checker.checker().robot(), checker.checker().group(), curves, rest);
}

void bindCombined(py::module_& module) {
  py::class_<CombinedCurve> type(
      module, "CombinedCurve",
      "The curve of a whole group, from the clock's time 0 to the end of the last curve.");
  type.def_readonly("curve", &CombinedCurve::curve, "Curve; its time is the clock's.")
      .def_property_readonly(
          "rounding", [](const CombinedCurve& self) { return makeArray(self.rounding); },
          "(n,) rad or m: how far each value may be from what the scheduled curves say, by "
          "rounding.");
  addRepr(type, {"curve", "rounding"});
  addImmutableCopies(type);

  module.def(
      "combined_curve", &combine, py::arg("checker"), py::arg("curves"),
      py::arg("still") = py::none(),
      "CombinedCurve: puts curves, a list of ScheduledCurve, on one clock. Together they move the "
      "checker's group. `still`: (n,)\nconfiguration, for variables that no curve moves. Raises "
      "ArgumentError without a curve, for a name that the group does not have\nor that has a curve "
      "already, for a variable without a value, and for a start or a slowdown that is not "
      "allowed.");
  module.def(
      "controller_trajectory",
      [](const PiecewisePolynomial& curve, Names names) {
        return controllerTrajectory(curve, std::move(names));
      },
      py::arg("curve"), py::arg("variable_names"),
      "The Trajectory of which a controller makes this Curve, but for rounding; None if there is "
      "none: where velocities (of a degree above\n1) or accelerations (above 3) jump, or a degree "
      "is above 5. Raises ArgumentError for another number of names than values.");
}

TrajectoryCertificate certifyAll(const CheckerHandle& checker, const Curves& curves,
                                 const py::object& still, const RateLimits* limits, double clock,
                                 bool clearances, const py::object& query) {
  const std::vector<double> rest = stillOf(checker, still);
  const TrajectoryQuery how = queryOf(limits, clock, clearances, query);
  const py::gil_scoped_release others;
  return certifySchedule(checker.checker(), curves, how, rest);
}

DelayCertificate certifyLate(const CheckerHandle& checker, const Curves& curves, std::size_t curve,
                             double latest, double slowest, double resolution,
                             const py::object& still, std::optional<double> seconds,
                             const std::shared_ptr<CancellationToken>& cancel) {
  const Watch watch(seconds, cancel);
  const std::vector<double> rest = stillOf(checker, still);
  DelayCertificate found;
  runWatched(watch, [&](const std::stop_token& stop) {
    found = certifyDelays(
        checker.checker(), curves,
        {.curve = curve, .latest = latest, .slowest = slowest, .resolution = resolution}, rest,
        stop);
  });
  return found;
}

void bindDelays(py::module_& module) {
  py::class_<DelayContact> contact(module, "DelayContact",
                                   "A contact of a schedule in which a curve is late.");
  contact.def_readonly("delay", &DelayContact::delay, "s.")
      .def_readonly("slowdown", &DelayContact::slowdown, "Factor on the curve's own one.")
      .def_property_readonly(
          "time", [](const DelayContact& self) { return self.contact.time; }, "s, of the clock.")
      .def_property_readonly(
          "witness", [](const DelayContact& self) { return self.contact.witness; },
          "Witness; its t is the share of the schedule's duration.")
      .def_property_readonly(
          "configuration",
          [](const DelayContact& self) {
            return makeArray(ConfigurationView(self.contact.configuration));
          },
          "(n,) that of the contact.");
  addRepr(contact, {"delay", "slowdown", "time", "witness"});
  addImmutableCopies(contact);

  using Certificate = DelayCertificate;
  py::class_<Certificate> type(
      module, "DelayCertificate",
      "By how much a curve may be late. True if all delays and slowdowns that were asked about are "
      "proven.");
  type.def_property_readonly(
          "verdict", [](const Certificate& self) { return toPython(self.verdict); },
          "FREE: every delay up to the latest, with every slowdown up to the slowest. COLLISION: "
          "`contact` has one that is not. Otherwise\nUNDECIDED.")
      .def_readonly("proven", &Certificate::proven,
                    "s: the schedule is FREE for every delay from 0 to this, each with every "
                    "slowdown. None: not even without a delay.")
      .def_readonly("contact", &Certificate::contact,
                    "DelayContact beyond `proven`, exactly if the verdict is COLLISION; else None.")
      .def_readonly("curves", &Certificate::curves, "Effort: combined curves that were certified.")
      .def("__bool__", [](const Certificate& self) { return self.verdict == Verdict::Free; });
  addRepr(type, {"verdict", "proven", "contact", "curves"});
  addImmutableCopies(type);
}

}  // namespace

void bindSchedules(py::module_& module) {
  bindScheduled(module);
  bindCombined(module);
  bindDelays(module);
  module.def(
      "certify_schedule", &certifyAll, py::arg("checker"), py::arg("curves"), py::kw_only(),
      py::arg("still") = py::none(), py::arg("limits") = nullptr, py::arg("clock") = 0.0,
      py::arg("clearances") = false, py::arg("query") = py::none(),
      "TrajectoryCertificate: what is proven about curves on one clock, in the checker's tube; its "
      "times are the clock's. `curves`, `still`: as\ncombined_curve, whose rounding is proven, "
      "too. "
      "The other arguments are those of Checker.certify_trajectory. Raises ArgumentError as\nboth "
      "do, and for a floating joint whose orientation a curve changes.");
  const DelayQuery usual;
  module.def(
      "certify_delays", &certifyLate, py::arg("checker"), py::arg("curves"), py::arg("curve"),
      py::kw_only(), py::arg("latest") = usual.latest, py::arg("slowest") = usual.slowest,
      py::arg("resolution") = usual.resolution, py::arg("still") = py::none(),
      py::arg("seconds") = py::none(), py::arg("cancel") = py::none(),
      "DelayCertificate: proves curves on one clock free while one of them, `curves[curve]`, is "
      "late: by up to `latest` s, and its slowdown up to\n`slowest` times as large. `resolution`: "
      "s, ranges of delays that are shorter are not divided any further. Raises Cancelled after\n"
      "`seconds`, or when the token `cancel` is cancelled; Ctrl-C ends it, too. Raises "
      "ArgumentError as certify_schedule does, and for values\nthat are not allowed.");
}

}  // namespace swept::python
