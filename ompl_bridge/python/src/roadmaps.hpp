// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <cstddef>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "handles.hpp"
#include "swept/ompl_bridge/certified_roadmap.hpp"
#include "swept/robot_model/proven_graph.hpp"

namespace swept::python {

inline const ProvenGraph& graphOf(const ProvenGraph& graph) {
  return graph;
}
inline const ProvenGraph& graphOf(const CertifiedRoadmap& roadmap) {
  return roadmap.graph();
}

/// A graph that threads of Python share: any number of them ask at the same time, and one that
/// changes it waits for them. No thread may wait for it with the GIL held.
template <typename Graph>
class GraphHandle {
 public:
  GraphHandle(RobotHandle robot, Graph graph)
      : robot_(std::move(robot)),
        graph_(std::move(graph)),
        dimension_(static_cast<std::size_t>(graphOf(graph_).checker()->dimension())) {}

  const RobotHandle& robot() const { return robot_; }
  std::size_t dimension() const { return dimension_; }  ///< of a configuration

  /// question(graph). Call it without the GIL.
  template <typename Question>
  auto read(Question&& question) const {
    const std::shared_lock lock(mutex_);
    return question(graph_);
  }
  /// change(graph), while no other thread asks. Call it without the GIL.
  template <typename Change>
  auto write(Change&& change) {
    const std::unique_lock lock(mutex_);
    return change(graph_);
  }
  /// As read(). Call it with the GIL, which is released meanwhile.
  template <typename Question>
  auto ask(Question&& question) const {
    const pybind11::gil_scoped_release others;
    return read(std::forward<Question>(question));
  }

 private:
  RobotHandle robot_;
  Graph graph_;
  std::size_t dimension_;
  mutable std::shared_mutex mutex_;
};

/// swept.ProvenGraph.
using ProvenGraphHandle = GraphHandle<ProvenGraph>;
/// swept.CertifiedRoadmap.
using RoadmapHandle = GraphHandle<CertifiedRoadmap>;

}  // namespace swept::python
