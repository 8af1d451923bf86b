// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/pybind11.h>

#include "arrays.hpp"
#include "binding.hpp"
#include "errors.hpp"
#include "watch.hpp"

PYBIND11_MODULE(_swept, module) {
  using namespace swept::python;
  module.doc() = "The part of swept that is C++; import swept.";
  importNumpy();
  registerErrors();
  bindWatch(module);
  bindConstraints(module);
  bindResults(module);
  bindCertificates(module);
  bindShapes(module);
  bindRobot(module);
  bindCells(module);
  bindWorld(module);
  bindRules(module);
  bindChecker(module);
  bindProjections(module);
  bindKinematics(module);
  bindToolLines(module);
  bindCovers(module);
  bindShapeCovers(module);
  bindSphereModels(module);
  bindShapeModels(module);
  bindTrajectories(module);
  bindSchedules(module);
  bindSchedulePlans(module);
  bindPaths(module);
  bindTasks(module);
  bindProvenGraphs(module);
  bindRoadmaps(module);
  bindPlanning(module);
  bindProblems(module);
  bindPages(module);
}
