// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "graph_members.hpp"
#include "roadmaps.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Limits = std::map<std::string, std::pair<double, double>>;
using Weights = std::map<std::string, double>;
std::unique_ptr<RoadmapHandle> build(const CheckerHandle& checker, std::size_t states,
                                     std::size_t neighbours, std::uint32_t seed,
                                     const Limits& limits, const Weights& weights, unsigned threads,
                                     std::optional<double> seconds, const Token& cancel) {
  std::unique_ptr<RoadmapHandle> built;
  runWatched(Watch(seconds, cancel), [&](const std::stop_token& stop) {
    built = std::make_unique<RoadmapHandle>(
        checker.robot(), CertifiedRoadmap(checker.shared(), {.states = states,
                                                             .neighbours = neighbours,
                                                             .seed = seed,
                                                             .threads = threads,
                                                             .space = {limits, weights},
                                                             .stop = stop}));
  });
  return built;
}

std::unique_ptr<RoadmapHandle> roadmapOf(const ProvenGraphHandle& graph, const Limits& limits,
                                         const Weights& weights) {
  const py::gil_scoped_release others;
  return std::make_unique<RoadmapHandle>(
      graph.robot(),
      CertifiedRoadmap(graph.read([](const ProvenGraph& own) { return own; }), {limits, weights}));
}

py::object pathOf(const RoadmapHandle& self, const py::object& start, const py::object& goal) {
  const Table from = readVector(start, "start", self.dimension());
  const Table to = readVector(goal, "goal", self.dimension());
  const auto found = self.ask([&](const CertifiedRoadmap& roadmap) {
    Workspace workspace(*roadmap.graph().checker());
    return roadmap.path(from.row(0), to.row(0), workspace);
  });
  if (!found) return py::none();
  return makeArray(*found, self.dimension());
}

}  // namespace

void bindRoadmaps(py::module_& module) {
  const RoadmapOptions usual;
  py::class_<RoadmapHandle> type(
      module, "CertifiedRoadmap",
      "A probabilistic roadmap whose motions are all proven, for many queries in a world that "
      "changes. Motions that a body blocks are kept, and are\nusable once it is gone. Copies share "
      "nothing that changes. Any number of threads may ask one; who changes it waits for them.");
  type.def(py::init(&build), py::arg("checker"), py::kw_only(), py::arg("states") = usual.states,
           py::arg("neighbours") = usual.neighbours, py::arg("seed") = usual.seed,
           py::arg("limits") = Limits(), py::arg("weights") = Weights(), py::arg("threads") = 0,
           py::arg("seconds") = py::none(), py::arg("cancel") = py::none(),
           "Samples `states`, all proven free, and joins each with so many of the nearest "
           "`neighbours`. The same `seed` gives the same roadmap.\n`limits`: (lower, upper) of "
           "variables by name, rad or m, within the robot's; `weights`: factors of joints in the "
           "distance. Other arguments as\nChecker.check_states. Raises ArgumentError for values "
           "that cannot be used, moving obstacles, and if no state is free.")
      .def_static("of", &roadmapOf, py::arg("graph"), py::kw_only(), py::arg("limits") = Limits(),
                  py::arg("weights") = Weights(),
                  "Of the states and motions of a ProvenGraph, which it copies, such as "
                  "ProvenGraph.load reads.")
      .def_property_readonly(
          "free_motions",
          [](const RoadmapHandle& self) {
            return self.ask([](const CertifiedRoadmap& roadmap) { return roadmap.freeMotions(); });
          },
          "How many.")
      .def_property_readonly(
          "components",
          [](const RoadmapHandle& self) {
            return self.ask([](const CertifiedRoadmap& roadmap) { return roadmap.components(); });
          },
          "How many, of states that free motions join.")
      .def_property_readonly(
          "graph",
          [](const RoadmapHandle& self) {
            return std::make_unique<ProvenGraphHandle>(
                self.robot(), self.ask([](const CertifiedRoadmap& own) { return own.graph(); }));
          },
          "ProvenGraph of its states and motions, a copy.")
      .def("path", &pathOf, py::arg("start"), py::arg("goal"),
           "(k, n) a path from start (n,) to goal (n,) in the current world, of proven motions; "
           "None: none was found. The straight motion is tried\nfirst, then the shortest way "
           "between the nearest states that both can be joined with. `plan` also shortens it.")
      .def("__repr__", [](const RoadmapHandle& self) {
        return self.ask([](const CertifiedRoadmap& roadmap) {
          return "<swept.CertifiedRoadmap of " + std::to_string(roadmap.graph().states()) +
                 " states, " + std::to_string(roadmap.freeMotions()) + " of " +
                 std::to_string(roadmap.graph().motions()) + " motions free>";
        });
      });
  addGraph(type);
}

}  // namespace swept::python
