// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "graph/box_table.hpp"
#include "graph/motion_boxes.hpp"
#include "swept/robot_model/proven_graph.hpp"

namespace swept::detail {

/// A body that a motion is not proven to keep its margin from.
struct MotionBlock {
  std::uint32_t body = 0;  ///< index into ProvenGraphData::names
  Verdict verdict = Verdict::Undecided;
};

struct ProvenGraphData {
  ProvenGraphData(std::shared_ptr<const Checker> own, std::shared_ptr<const MotionBoxes> boxes)
      : checker(std::move(own)), boxesOf(std::move(boxes)), table(boxesOf->pieces()) {}

  std::shared_ptr<const Checker> checker;
  std::shared_ptr<const MotionBoxes> boxesOf;
  std::size_t stateCount = 0;
  std::vector<double> values;  ///< of all states, one after the other
  std::vector<ProvenGraph::Motion> motions;
  std::vector<std::vector<MotionBlock>> blocks;  ///< per motion
  BoxTable table;                                ///< of all motions
  std::vector<std::string> names;                ///< of bodies that ever blocked a motion

  std::span<const double> state(std::size_t index) const {
    const auto dimension = static_cast<std::size_t>(checker->dimension());
    return {values.data() + index * dimension, dimension};
  }
  /// The number of a body; adds the name if it is new.
  std::uint32_t numberOf(const std::string& name);
  /// Boxes of the motions from `first` on.
  void findBoxes(std::size_t first, unsigned threads);
  /// To the world of another checker, in which bodies of these names are gone, and these are new.
  /// If it was stopped, nothing changes.
  ProvenGraph::Change change(std::shared_ptr<const Checker> changed,
                             std::span<const std::string> gone,
                             std::span<const WorldBody* const> added, unsigned threads,
                             const std::stop_token& stop = {});
};

}  // namespace swept::detail
