// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/datastructures/NearestNeighborsGNATNoThreadSafety.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "planning_problems.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "timing.hpp"

/// What the nearest state of a planner's tree costs.
namespace swept::benchmark {

/// States of a group, held as planners hold them.
class NeighbourStates {
 public:
  struct Node {
    ompl::base::State* state;
  };

  NeighbourStates(ompl::base::StateSpacePtr space, std::size_t count, bool grown,
                  std::mt19937_64& random)
      : space_(std::move(space)), nodes_(count) {
    const auto sampler = space_->allocStateSampler();
    for (std::size_t i = 0; i < count; ++i) {
      nodes_[i].state = space_->allocState();
      if (grown && i > 0) {
        // Not far from one of the last, as trees grow.
        const std::size_t first = i > kLast ? i - kLast : 0;
        const auto parent = std::uniform_int_distribution<std::size_t>(first, i - 1)(random);
        sampler->sampleUniformNear(nodes_[i].state, nodes_[parent].state, kStep);
      } else {
        sampler->sampleUniform(nodes_[i].state);
      }
    }
  }
  ~NeighbourStates() {
    for (const Node& node : nodes_) space_->freeState(node.state);
  }
  NeighbourStates(const NeighbourStates&) = delete;
  NeighbourStates& operator=(const NeighbourStates&) = delete;

  std::vector<Node>& nodes() { return nodes_; }
  double distance(const Node* a, const Node* b) const {
    return space_->distance(a->state, b->state);
  }

 private:
  static constexpr std::size_t kLast = 50;
  static constexpr double kStep = 0.1;  // rad
  ompl::base::StateSpacePtr space_;
  std::vector<Node> nodes_;
};

struct NeighbourTimes {
  double add = 0.0, nearest = 0.0;  ///< s, each
  double sum = 0.0;                 ///< of the distances: the same for all that are exact
};

template <typename Neighbours>
NeighbourTimes timeNeighbours(NeighbourStates& tree, NeighbourStates& queries) {
  using Node = NeighbourStates::Node;
  Neighbours neighbours;
  neighbours.setDistanceFunction(
      [&](Node* const& a, Node* const& b) { return tree.distance(a, b); });
  NeighbourTimes times;
  const double begin = cpuSeconds();
  for (Node& node : tree.nodes()) neighbours.add(&node);
  times.add = (cpuSeconds() - begin) / static_cast<double>(tree.nodes().size());
  double least = std::numeric_limits<double>::infinity();
  constexpr int kPasses = 5;
  for (int pass = 0; pass < kPasses; ++pass) {
    times.sum = 0.0;
    const double start = cpuSeconds();
    for (Node& query : queries.nodes())
      times.sum += tree.distance(neighbours.nearest(&query), &query);
    least = std::min(least, cpuSeconds() - start);
  }
  times.nearest = least / static_cast<double>(queries.nodes().size());
  return times;
}

/// Of trees of the robot's group, of uniform states and of ones that have grown; queries are
/// uniform. False when the two do not find equally near states.
inline bool printNeighbours(const PlanningProblems& problems, std::uint32_t seed) {
  using Node = NeighbourStates::Node;
  constexpr std::size_t kQueries = 2000;
  std::mt19937_64 random(seed);
  const Robot& robot = *problems.robot();
  const auto space = makeStateSpace(robot, *robot.findGroup(problems.group()));
  NeighbourStates queries(space, kQueries, false, random);
  const MarkdownTable table({"states", "tree", "GNAT: add, nearest, us",
                             "NearestStates: add, nearest, us", "ratio of nearest"});
  bool same = true;
  for (const bool grown : {false, true}) {
    for (const std::size_t count : {100UL, 1000UL, 10'000UL, 100'000UL}) {
      NeighbourStates tree(space, count, grown, random);
      const NeighbourTimes gnat =
          timeNeighbours<ompl::NearestNeighborsGNATNoThreadSafety<Node*>>(tree, queries);
      const NeighbourTimes ours = timeNeighbours<NearestStates<Node*>>(tree, queries);
      same = same && gnat.sum == ours.sum;
      const auto both = [](const NeighbourTimes& times) {
        return number(1e6 * times.add) + ", " + number(1e6 * times.nearest);
      };
      table.row({std::to_string(count), grown ? "grown" : "uniform", both(gnat), both(ours),
                 number(ours.nearest / gnat.nearest, 2)});
    }
  }
  return same;
}

}  // namespace swept::benchmark
