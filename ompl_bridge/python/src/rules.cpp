// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <map>
#include <utility>

#include "binding.hpp"
#include "bodies.hpp"
#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/collision_rules.hpp"
#include "swept/robot_model/tracking_tolerance.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Joints = std::map<std::string, std::pair<double, double>>;

TrackingTolerance tracking(double rotation, double translation, const Joints& joints) {
  TrackingTolerance tolerance{{.rotation = rotation, .translation = translation}, {}};
  for (const auto& [name, value] : joints)
    tolerance.joints[name] = {.rotation = value.first, .translation = value.second};
  return tolerance;
}

Joints jointsOf(const TrackingTolerance& tolerance) {
  Joints joints;
  for (const auto& [name, value] : tolerance.joints)
    joints[name] = {value.rotation, value.translation};
  return joints;
}

void bindTracking(py::module_& module) {
  py::class_<TrackingTolerance> type(
      module, "TrackingTolerance",
      "How far each joint may be, at every instant, from where it should be: rad of one that "
      "turns, "
      "m of one that slides.\n`joints`: pairs (rad, m) by name, in place of these.");
  type.def(py::init(&tracking), py::arg("rotation") = 0.0, py::arg("translation") = 0.0,
           py::arg("joints") = Joints{})
      .def_readonly("rotation", &TrackingTolerance::rotation, "rad")
      .def_readonly("translation", &TrackingTolerance::translation, "m")
      .def_property_readonly("joints", &jointsOf, "(rad, m) by joint.");
  addRepr(type, {"rotation", "translation", "joints"});
  addImmutableCopies(type);
}

void bindAttachedBody(py::module_& module) {
  py::class_<AttachedBody> type(
      module, "AttachedBody",
      "A rigid body that a link carries: a tool, or an object in a gripper. "
      "Arguments: see Checker.with_attached.");
  type.def(py::init(&attachedOf), py::arg("name"), py::arg("link"), py::arg("shape"),
           py::arg("pose") = py::none(), py::arg("touch_links") = std::vector<std::string>())
      .def_readonly("name", &AttachedBody::name, "Used in rules and reports.")
      .def_readonly("link", &AttachedBody::link, "The link that carries it.")
      .def_property_readonly(
          "touch_links",
          [](const AttachedBody& body) { return py::tuple(py::cast(body.touchLinks)); },
          "Links that may touch it.");
  addRepr(type, {"name", "link", "touch_links"});
  addImmutableCopies(type);
}

}  // namespace

void bindRules(py::module_& module) {
  bindTracking(module);
  bindAttachedBody(module);
  using Rules = CollisionRules;
  constexpr auto kSelf = py::return_value_policy::reference;
  py::class_<Rules>(
      module, "CollisionRules",
      "Rules about pairs of bodies. In names, `*` stands for any characters. A rule with more "
      "plain "
      "names wins, among equals\nthe last; rules win over the SRDF. Each function returns the "
      "rules "
      "themselves: `CollisionRules().allow('a', 'b').pad('c', 0.01)`.\n`reason` is for people: "
      "Checker.explain repeats it.")
      .def(py::init<>(), "No rules.")
      .def("allow", &Rules::allow, py::arg("body_a"), py::arg("body_b"), py::arg("reason") = "",
           kSelf, "The two may collide.")
      .def("check", &Rules::check, py::arg("body_a"), py::arg("body_b"), py::arg("reason") = "",
           kSelf, "The two are checked, whatever the SRDF, joints and touch links say.")
      .def("margin", &Rules::margin, py::arg("body_a"), py::arg("body_b"), py::arg("metres"),
           py::arg("reason") = "", kSelf, "The two must keep more than this.")
      .def("pad", &Rules::pad, py::arg("body"), py::arg("metres"), py::arg("reason") = "", kSelf,
           "The body reaches this much farther.")
      .def("scale", py::overload_cast<std::string, double, std::string>(&Rules::scale),
           py::arg("body"), py::arg("factor"), py::arg("reason") = "", kSelf,
           "Each piece of the body is scaled about the centre of its box.")
      .def("over", &Rules::over, py::arg("weaker"),
           "These rules above weaker ones, which answer only where these have no answer.")
      .def("__len__", [](const Rules& rules) { return rules.rules().size(); })
      .def("__copy__", [](const Rules& rules) { return rules; })
      .def("__deepcopy__", [](const Rules& rules, const py::dict&) { return rules; })
      .def("__repr__", [](const Rules& rules) {
        return "<swept.CollisionRules, " + std::to_string(rules.rules().size()) + " rules>";
      });
}

}  // namespace swept::python
