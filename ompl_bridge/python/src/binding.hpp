// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

/// The classes and functions of the module, a file for each topic.
namespace swept::python {

void bindRobot(pybind11::module_& module);
void bindShapes(pybind11::module_& module);
void bindWorld(pybind11::module_& module);
void bindRules(pybind11::module_& module);
void bindConstraints(pybind11::module_& module);
void bindResults(pybind11::module_& module);
void bindCertificates(pybind11::module_& module);
void bindChecker(pybind11::module_& module);
void bindProjections(pybind11::module_& module);
void bindKinematics(pybind11::module_& module);
void bindToolLines(pybind11::module_& module);
void bindCovers(pybind11::module_& module);
void bindShapeCovers(pybind11::module_& module);
void bindSphereModels(pybind11::module_& module);
void bindShapeModels(pybind11::module_& module);
void bindCells(pybind11::module_& module);
void bindProblems(pybind11::module_& module);
void bindTrajectories(pybind11::module_& module);
void bindSchedules(pybind11::module_& module);
void bindSchedulePlans(pybind11::module_& module);
void bindPaths(pybind11::module_& module);
void bindProvenGraphs(pybind11::module_& module);
void bindRoadmaps(pybind11::module_& module);
void bindTasks(pybind11::module_& module);
void bindPlanning(pybind11::module_& module);
void bindPages(pybind11::module_& module);

/// Gives a class a `__repr__` with these properties: `Name(a=1, b=2)`.
template <typename Class>
void addRepr(Class& type, const std::vector<std::string>& properties) {
  type.def("__repr__", [properties](const pybind11::object& self) {
    std::string text = std::string(pybind11::str(pybind11::type::of(self).attr("__name__"))) + "(";
    for (std::size_t i = 0; i < properties.size(); ++i)
      text += (i > 0 ? ", " : "") + properties[i] + "=" +
              std::string(pybind11::repr(self.attr(properties[i].c_str())));
    return text + ")";
  });
}

/// Gives a class of immutable objects copies that are the objects themselves.
template <typename Class>
void addImmutableCopies(Class& type) {
  type.def("__copy__", [](const pybind11::object& self) { return self; });
  type.def("__deepcopy__",
           [](const pybind11::object& self, const pybind11::dict&) { return self; });
}

}  // namespace swept::python
