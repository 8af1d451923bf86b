// SPDX-License-Identifier: BSD-3-Clause
#include "roadmaps.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Token = std::shared_ptr<CancellationToken>;
using Limits = std::map<std::string, std::pair<double, double>>;
using Weights = std::map<std::string, double>;

/// An index of Python, which may count from the end.
std::size_t motionAt(const ProvenGraph& graph, py::ssize_t index) {
  const auto size = static_cast<py::ssize_t>(graph.motions());
  const py::ssize_t place = index < 0 ? index + size : index;
  if (place < 0 || place >= size)
    throw py::index_error("motion " + std::to_string(index) + " of " + std::to_string(size));
  return static_cast<std::size_t>(place);
}

template <typename Handle>
py::object states(const Handle& self) {
  const auto rows = self.ask([](const auto& graph) {
    std::vector<std::vector<double>> all;
    for (std::size_t i = 0; i < graphOf(graph).states(); ++i) {
      const ConfigurationView q = graphOf(graph).state(i);
      all.emplace_back(q.begin(), q.end());
    }
    return all;
  });
  return makeArray(rows, self.dimension());
}

template <typename Handle>
py::object motions(const Handle& self) {
  const auto ends = self.ask([](const auto& graph) {
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < graphOf(graph).motions(); ++i) {
      all.push_back(graphOf(graph).motion(i).from);
      all.push_back(graphOf(graph).motion(i).to);
    }
    return all;
  });
  return makeIndices(ends, 2);
}

template <typename Handle>
py::object verdicts(const Handle& self) {
  const auto found = self.ask([](const auto& graph) {
    std::vector<Verdict> all;
    for (std::size_t i = 0; i < graphOf(graph).motions(); ++i)
      all.push_back(graphOf(graph).verdict(i));
    return all;
  });
  std::uint8_t* memory = nullptr;
  py::object array = makeBytes(found.size(), memory);
  for (const Verdict verdict : found) *memory++ = static_cast<std::uint8_t>(verdict);
  return array;
}

template <typename Handle>
std::unique_ptr<CheckerHandle> checkerOf(const Handle& self) {
  auto checker = self.ask([](const auto& graph) { return graphOf(graph).checker(); });
  return std::make_unique<CheckerHandle>(self.robot(), std::move(checker));
}

template <typename Handle>
py::tuple blockedBy(const Handle& self, py::ssize_t motion) {
  return py::cast(self.ask([&](const auto& graph) {
    return graphOf(graph).blockedBy(motionAt(graphOf(graph), motion));
  }));
}

template <typename Handle>
ProvenGraph::Change update(Handle& self, const CheckerHandle& checker, unsigned threads,
                           std::optional<double> seconds, const Token& cancel) {
  ProvenGraph::Change change;
  runWatched(Watch(seconds, cancel), [&](const std::stop_token& stop) {
    change = self.write([&](auto& graph) { return graph.update(checker.shared(), threads, stop); });
  });
  return change;
}

template <typename Handle>
std::unique_ptr<Handle> copyOf(const Handle& self) {
  return std::make_unique<Handle>(self.robot(), self.ask([](const auto& graph) { return graph; }));
}

/// What both classes have.
template <typename Handle>
void addGraph(py::class_<Handle>& type) {
  type.def_property_readonly("checker", &checkerOf<Handle>, "Checker of the current world.")
      .def_property_readonly("states", &states<Handle>, "(s, n) rad or m, a copy.")
      .def_property_readonly("motions", &motions<Handle>,
                             "(m, 2) uint32, a copy: indices of the two states that each joins.")
      .def_property_readonly(
          "verdicts", &verdicts<Handle>,
          "(m,) uint8, values of Verdict, a copy: of each motion in the current world. COLLISION "
          "where it meets a body, UNDECIDED where it is\nproven neither to meet one nor to keep "
          "all margins.")
      .def("blocked_by", &blockedBy<Handle>, py::arg("motion"),
           "Names of the bodies that keep the motion of this index from being FREE, in no "
           "particular order.")
      .def("update", &update<Handle>, py::arg("checker"), py::kw_only(), py::arg("threads") = 0,
           py::arg("seconds") = py::none(), py::arg("cancel") = py::none(),
           "GraphChange: takes a checker of the same robot in another world, such as "
           "Checker.with_body makes. Which bodies have changed it finds by\nitself; only motions "
           "that these can reach are asked about again. If margins, rules, attached bodies or "
           "constraints differ, all are, and\nthose are left out that are no longer free in a "
           "world without bodies. Arguments as Checker.check_states. Raises ArgumentError for\n"
           "another robot or group and for moving obstacles, and Cancelled: then nothing has "
           "changed.")
      .def(
          "save",
          [](const Handle& self, const std::filesystem::path& file) {
            self.ask([&](const auto& graph) { graphOf(graph).save(file); });
          },
          py::arg("file"),
          "Writes states, motions, what blocks them, and hashes of robot, options and bodies to a "
          "JSON file. Raises UsageError.")
      .def("__copy__", &copyOf<Handle>)
      .def("__deepcopy__", [](const Handle& self, const py::dict&) { return copyOf(self); });
}

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

void bindRoadmap(py::module_& module) {
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

}  // namespace

void bindRoadmaps(py::module_& module) {
  bindChange(module);
  bindGraph(module);
  bindRoadmap(module);
}

}  // namespace swept::python
