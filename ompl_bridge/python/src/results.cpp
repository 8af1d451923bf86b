// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "binding.hpp"
#include "enums.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/checker_results.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// A body's name; None where there is no body.
py::object nameOf(const BodyName& name) {
  if (name.empty()) return py::none();
  return py::str(name.str());
}

/// A read-only property with the name of a body.
template <typename Class, typename Owner>
void addBody(Class& type, const char* name, BodyName Owner::*member, const char* doc) {
  type.def_property_readonly(
      name, [member](const typename Class::type& self) { return nameOf(self.*member); }, doc);
}

/// A read-only property with a point or direction.
template <typename Class, typename Owner>
void addPoint(Class& type, const char* name, Eigen::Vector3d Owner::*member, const char* doc) {
  type.def_property_readonly(
      name, [member](const typename Class::type& self) { return makeArray(self.*member); }, doc);
}

void bindWitness(py::module_& module) {
  py::class_<Witness> type(module, "Witness",
                           "Two points of two bodies that are at most the margin apart.");
  type.def_readonly("t", &Witness::t, "In [0, 1]; 0 for a state.")
      .def_readonly("self_pair", &Witness::selfPair, "Both are links or attached bodies.")
      .def_readonly("distance", &Witness::distance, "m; 0 in contact.")
      .def_readonly("margin", &Witness::margin, "m, what the two must keep.")
      .def_property_readonly(
          "configuration",
          [](const Witness& self) -> py::object {
            if (self.configuration.empty()) return py::none();
            return makeArray(self.configuration);
          },
          "(n,) the configuration in contact, if a tracking tolerance puts it off the motion's own "
          "at t; else None.");
  addBody(type, "body_a", &Witness::bodyA, "A robot link or an attached body.");
  addBody(type, "body_b", &Witness::bodyB, "A world body or another link.");
  addPoint(type, "point_a", &Witness::pointA, "(3,) m, model frame, on or in body_a.");
  addPoint(type, "point_b", &Witness::pointB, "(3,) m, model frame, on or in body_b.");
  addRepr(type, {"t", "body_a", "body_b", "distance", "point_a", "point_b"});
  addImmutableCopies(type);
}

void bindReport(py::module_& module) {
  py::class_<NearestPair> nearest(module, "NearestPair",
                                  "The nearest checked pair of one kind in a state.");
  nearest.def_readonly("clearance", &NearestPair::clearance,
                       "m, proven lower bound; inf: no pairs.");
  addBody(nearest, "body_a", &NearestPair::bodyA, "None without such pairs.");
  addBody(nearest, "body_b", &NearestPair::bodyB, "None without such pairs.");
  addRepr(nearest, {"clearance", "body_a", "body_b"});

  py::class_<StateReport> type(module, "StateReport", "A complete report on one state.");
  type.def_property_readonly(
          "verdict", [](const StateReport& self) { return toPython(self.verdict); },
          "As check_state.")
      .def_property_readonly(
          "outside_limits",
          [](const StateReport& self) { return py::tuple(py::cast(self.outsideLimits)); },
          "Names of variables outside their limits, which do not affect the verdict.")
      .def_property_readonly(
          "contacts", [](const StateReport& self) { return py::tuple(py::cast(self.contacts)); },
          "A Witness for each violating pair.")
      .def_property_readonly(
          "violations",
          [](const StateReport& self) { return py::tuple(py::cast(self.violations)); },
          "A ConstraintViolation for each constraint that does not hold.")
      .def_readonly("constraints_hold", &StateReport::constraintsHold,
                    "Whether all constraints are proven to hold.")
      .def_readonly(
          "clearance", &StateReport::clearance,
          "m, proven lower bound of the least distance over all checked pairs; inf: no pairs.")
      .def_readonly("world", &StateReport::world, "NearestPair of those with the world.")
      .def_readonly("self_pairs", &StateReport::self,
                    "NearestPair of two links or attached bodies.")
      .def("__bool__", [](const StateReport& self) { return self.verdict == Verdict::Free; });
  addBody(type, "nearest_a", &StateReport::nearestA, "The pair that gave `clearance`.");
  addBody(type, "nearest_b", &StateReport::nearestB, "The pair that gave `clearance`.");
  addRepr(type, {"verdict", "clearance", "nearest_a", "nearest_b", "contacts", "violations"});
  addImmutableCopies(type);
}

void bindEffort(py::module_& module) {
  py::class_<Effort> type(module, "Effort", "The effort of a query.");
  type.def_readonly("intervals", &Effort::intervals,
                    "Sub-intervals, or states, with exact queries.")
      .def_readonly("distances", &Effort::distances, "Exact pair queries.")
      .def_readonly("culled", &Effort::culled, "Pairs settled by bounding volumes alone.")
      .def_readonly("lanes", &Effort::lanes,
                    "Sub-intervals examined in single precision, by the SIMD tier.")
      .def_readonly("constrained", &Effort::constrained,
                    "Sub-intervals, or states, examined for constraints.");
  addRepr(type, {"intervals", "distances", "culled", "lanes", "constrained"});
}

void bindClearance(py::module_& module) {
  using Interval = ClearanceInterval;
  py::class_<Interval> interval(module, "ClearanceInterval",
                                "Least distance over a motion of some pairs; inf: there are none.");
  interval.def_readonly("lower", &Interval::lower, "m, proven for every t.")
      .def_readonly("upper", &Interval::upper, "m, attained at t; inf: unknown.")
      .def_readonly("t", &Interval::t, "In [0, 1], where upper is attained.");
  addBody(interval, "body_a", &Interval::bodyA, "Of the pair that attains it; None without one.");
  addBody(interval, "body_b", &Interval::bodyB, "Of the pair that attains it; None without one.");
  addRepr(interval, {"lower", "upper", "t", "body_a", "body_b"});

  py::class_<MotionClearance, Interval> motion(
      module, "MotionClearance", "Least distance of the checked pairs over a motion.");
  motion.def_readonly("self_pair", &MotionClearance::selfPair, "Of body_a and body_b, see Witness.")
      .def_readonly("intervals", &MotionClearance::intervals, "Examined.")
      .def_readonly("world", &MotionClearance::world, "Of pairs with the world.")
      .def_readonly("self_pairs", &MotionClearance::self,
                    "Of pairs of two links or attached bodies.");

  py::class_<PathClearanceInterval, Interval> part(module, "PathClearanceInterval",
                                                   "Least distance over a path of some pairs.");
  part.def_readonly("segment", &PathClearanceInterval::segment,
                    "The motion in which `upper` is attained, at its t; None without a pair.");
  addRepr(part, {"lower", "upper", "segment", "t", "body_a", "body_b"});
  py::class_<PathClearance, PathClearanceInterval>(
      module, "PathClearance", "Least distance of the checked pairs over a path.")
      .def_readonly("self_pair", &PathClearance::selfPair, "Of body_a and body_b, see Witness.")
      .def_readonly("intervals", &PathClearance::intervals, "Examined in all motions.")
      .def_readonly("world", &PathClearance::world, "Of pairs with the world.")
      .def_readonly("self_pairs", &PathClearance::self,
                    "Of pairs of two links or attached bodies.");

  py::class_<SignedClearance> type(
      module, "SignedClearance",
      "Signed distance of the nearest checked pair, negative in contact: minus the length of the "
      "shortest translation that\nseparates the two. Margins and paddings are not subtracted.");
  type.def_readonly("lower", &SignedClearance::lower,
                    "m, proven for all checked pairs; inf: there are none; -inf: nothing is known.")
      .def_readonly("upper", &SignedClearance::upper, "m, of the pair at the points.");
  addPoint(type, "point_a", &SignedClearance::pointA, "(3,) m, model frame.");
  addPoint(type, "point_b", &SignedClearance::pointB, "(3,) m, model frame.");
  addPoint(type, "normal", &SignedClearance::normal,
           "(3,) unit, from a to b, model frame; zero if no single direction is known.");
  addRepr(type, {"lower", "upper", "normal"});
}

void bindPair(py::module_& module) {
  py::class_<Checker::Pair> type(module, "Pair", "A checked pair of bodies, or a skipped one.");
  type.def_readonly("body_a", &Checker::Pair::bodyA, "A robot link or an attached body.")
      .def_readonly("body_b", &Checker::Pair::bodyB, "Likewise, or a world body.")
      .def_readonly("self_pair", &Checker::Pair::selfPair, "Both are links or attached bodies.")
      .def_readonly("margin", &Checker::Pair::margin, "m, what they must keep if they are checked.")
      .def_readonly(
          "reason", &Checker::Pair::reason,
          "Why it is skipped: `adjacent`, `SRDF: Never`, ... Of a checked pair `never` if it "
          "is proven once for all.");
  addRepr(type, {"body_a", "body_b", "margin", "reason"});
}

}  // namespace

void bindResults(py::module_& module) {
  bindEffort(module);
  bindWitness(module);
  bindReport(module);
  bindClearance(module);
  bindPair(module);
}

}  // namespace swept::python
