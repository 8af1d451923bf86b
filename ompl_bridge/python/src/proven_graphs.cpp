// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
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

std::unique_ptr<ProvenGraphHandle> loadGraph(const std::filesystem::path& file,
                                             const CheckerHandle& checker, unsigned threads) {
  const py::gil_scoped_release others;
  return std::make_unique<ProvenGraphHandle>(checker.robot(),
                                             ProvenGraph::load(file, checker.shared(), threads));
}

py::tuple loadChangedGraph(const std::filesystem::path& file, const CheckerHandle& checker,
                           unsigned threads) {
  std::unique_ptr<ProvenGraphHandle> graph;
  ProvenGraph::Change change;
  {
    const py::gil_scoped_release others;
    ProvenGraph::Updated found = ProvenGraph::loadChanged(file, checker.shared(), threads);
    graph = std::make_unique<ProvenGraphHandle>(checker.robot(), std::move(found.graph));
    change = found.change;
  }
  return py::make_tuple(std::move(graph), change);
}

py::object addStates(ProvenGraphHandle& self, const py::object& states) {
  const Table table = readTable(states, "states", self.dimension());
  std::vector<std::uint32_t> indices;
  {
    const py::gil_scoped_release others;
    self.write([&](ProvenGraph& graph) {
      for (const ConfigurationView q : table.list()) indices.push_back(graph.addState(q));
    });
  }
  return makeIndices(indices, 1).attr("ravel")();
}

std::size_t addMotions(ProvenGraphHandle& self, const py::object& motions, unsigned threads,
                       std::optional<double> seconds, const Token& cancel) {
  const std::size_t end = self.ask([](const ProvenGraph& graph) { return graph.states(); });
  const std::vector<std::uint32_t> ends = readIndices(motions, "motions", 2, end);
  std::vector<ProvenGraph::Motion> all;
  for (std::size_t i = 0; i < ends.size(); i += 2) all.push_back({ends[i], ends[i + 1]});
  std::size_t added = 0;
  runWatched(Watch(seconds, cancel), [&](const std::stop_token& stop) {
    added = self.write([&](ProvenGraph& graph) { return graph.addMotions(all, threads, stop); });
  });
  return added;
}

void bindChange(py::module_& module) {
  using Change = ProvenGraph::Change;
  py::class_<Change> type(module, "GraphChange", "What an update of a graph did.");
  type.def_readonly("bodies_gone", &Change::bodiesGone, "Removed, or not what they were.")
      .def_readonly("bodies_new", &Change::bodiesNew, "Added, or not what they were.")
      .def_readonly("by_arithmetic", &Change::byArithmetic,
                    "Pairs of a motion and a new body that are apart by comparing numbers alone.")
      .def_readonly("asked", &Change::asked, "The other pairs, which a checker was asked about.")
      .def_readonly("motions_asked", &Change::motionsAsked,
                    "Motions that a checker was asked about.")
      .def_readonly("freed", &Change::freed, "Motions that are FREE and were not.")
      .def_readonly("blocked", &Change::blocked, "Motions that were FREE and are not.")
      .def_readonly("everything", &Change::everything,
                    "Whether more than the world has changed, so that all were asked about anew.");
  addRepr(type, {"bodies_gone", "bodies_new", "by_arithmetic", "asked", "motions_asked", "freed",
                 "blocked", "everything"});
  addImmutableCopies(type);
}

void bindGraph(py::module_& module) {
  py::class_<ProvenGraphHandle> type(
      module, "ProvenGraph",
      "States and straight motions between them, as a planner of your own chooses them, each with "
      "what is proven of it body by body: when the\nworld changes, only motions that the change "
      "can reach are asked about again. A motion in contact with the robot itself, or that does\n"
      "not keep the constraints, is never added. Copies share nothing. Any number of threads may "
      "ask one; who changes it waits for them.");
  type.def(py::init([](const CheckerHandle& checker) {
             const py::gil_scoped_release others;
             return std::make_unique<ProvenGraphHandle>(checker.robot(),
                                                        ProvenGraph(checker.shared()));
           }),
           py::arg("checker"), "Without states. Raises ArgumentError for moving obstacles.")
      .def("add_states", &addStates, py::arg("states"),
           "(k,) uint32: indices of states (k, n) that are added. They are not checked.")
      .def("add_motions", &addMotions, py::arg("motions"), py::kw_only(), py::arg("threads") = 0,
           py::arg("seconds") = py::none(), py::arg("cancel") = py::none(),
           "Asks about motions (k, 2), pairs of indices of states, and adds those that are free in "
           "a world without bodies, in this order; but none\nin which a cyclic value moves by half "
           "a turn. Returns how many. Arguments as Checker.check_states; what was asked about "
           "before it was\ncancelled is added.")
      .def_static(
          "load", &loadGraph, py::arg("file"), py::arg("checker"), py::kw_only(),
          py::arg("threads") = 0,
          "Reads a file of `save`; verdicts are those of the file. Raises InputError for a "
          "damaged file, and for another robot, group, option or\nworld than the checker's, "
          "naming what differs.")
      .def_static("load_changed", &loadChangedGraph, py::arg("file"), py::arg("checker"),
                  py::kw_only(), py::arg("threads") = 0,
                  "(ProvenGraph, GraphChange) for a checker of another world: what `load` in the "
                  "file's world and `update` give.")
      .def("__repr__", [](const ProvenGraphHandle& self) {
        const auto [states, motions] = self.ask(
            [](const ProvenGraph& graph) { return std::pair(graph.states(), graph.motions()); });
        return "<swept.ProvenGraph of " + std::to_string(states) + " states and " +
               std::to_string(motions) + " motions>";
      });
  addGraph(type);
}

}  // namespace

void bindProvenGraphs(py::module_& module) {
  bindChange(module);
  bindGraph(module);
}

}  // namespace swept::python
