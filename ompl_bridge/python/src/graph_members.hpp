// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "roadmaps.hpp"
#include "watch.hpp"

/// What swept.ProvenGraph and swept.CertifiedRoadmap have in common.
namespace swept::python {

/// An index of Python, which may count from the end.
inline std::size_t motionAt(const ProvenGraph& graph, pybind11::ssize_t index) {
  const auto size = static_cast<pybind11::ssize_t>(graph.motions());
  const pybind11::ssize_t place = index < 0 ? index + size : index;
  if (place < 0 || place >= size)
    throw pybind11::index_error("motion " + std::to_string(index) + " of " + std::to_string(size));
  return static_cast<std::size_t>(place);
}

template <typename Handle>
pybind11::object statesOf(const Handle& self) {
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
pybind11::object motionsOf(const Handle& self) {
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
pybind11::object verdictsOf(const Handle& self) {
  const auto found = self.ask([](const auto& graph) {
    std::vector<Verdict> all;
    for (std::size_t i = 0; i < graphOf(graph).motions(); ++i)
      all.push_back(graphOf(graph).verdict(i));
    return all;
  });
  std::uint8_t* memory = nullptr;
  pybind11::object array = makeBytes(found.size(), memory);
  for (const Verdict verdict : found) *memory++ = static_cast<std::uint8_t>(verdict);
  return array;
}

template <typename Handle>
std::unique_ptr<CheckerHandle> checkerOf(const Handle& self) {
  auto checker = self.ask([](const auto& graph) { return graphOf(graph).checker(); });
  return std::make_unique<CheckerHandle>(self.robot(), std::move(checker));
}

template <typename Handle>
pybind11::tuple blockedBy(const Handle& self, pybind11::ssize_t motion) {
  return pybind11::cast(self.ask([&](const auto& graph) {
    return graphOf(graph).blockedBy(motionAt(graphOf(graph), motion));
  }));
}

template <typename Handle>
ProvenGraph::Change updateGraph(Handle& self, const CheckerHandle& checker, unsigned threads,
                                std::optional<double> seconds,
                                const std::shared_ptr<CancellationToken>& cancel) {
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
void addGraph(pybind11::class_<Handle>& type) {
  type.def_property_readonly("checker", &checkerOf<Handle>, "Checker of the current world.")
      .def_property_readonly("states", &statesOf<Handle>, "(s, n) rad or m, a copy.")
      .def_property_readonly("motions", &motionsOf<Handle>,
                             "(m, 2) uint32, a copy: indices of the two states that each joins.")
      .def_property_readonly(
          "verdicts", &verdictsOf<Handle>,
          "(m,) uint8, values of Verdict, a copy: of each motion in the current world. COLLISION "
          "where it meets a body, UNDECIDED where it is\nproven neither to meet one nor to keep "
          "all margins.")
      .def("blocked_by", &blockedBy<Handle>, pybind11::arg("motion"),
           "Names of the bodies that keep the motion of this index from being FREE, in no "
           "particular order.")
      .def("update", &updateGraph<Handle>, pybind11::arg("checker"), pybind11::kw_only(),
           pybind11::arg("threads") = 0, pybind11::arg("seconds") = pybind11::none(),
           pybind11::arg("cancel") = pybind11::none(),
           "GraphChange: takes a checker of the same robot in another world, such as "
           "Checker.with_body makes. Which bodies have changed it finds by\nitself; only motions "
           "that these can reach are asked about again. If margins, rules, attached bodies or "
           "constraints differ, all are, and\nthose are left out that are no longer free in a "
           "world without bodies. Arguments as Checker.check_states. Raises ArgumentError for\n"
           "another robot or group and for moving obstacles, and Cancelled: then nothing has "
           "changed, unless all was done by then, as `checker` tells.")
      .def(
          "save",
          [](const Handle& self, const std::filesystem::path& file) {
            self.ask([&](const auto& graph) { graphOf(graph).save(file); });
          },
          pybind11::arg("file"),
          "Writes states, motions, what blocks them, and hashes of robot, options and bodies to a "
          "JSON file. Raises UsageError.")
      .def("__copy__", &copyOf<Handle>)
      .def("__deepcopy__", [](const Handle& self, const pybind11::dict&) { return copyOf(self); });
}

}  // namespace swept::python
