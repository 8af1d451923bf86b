// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerData.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/proven_graph.hpp"

namespace swept {

/// How a CertifiedRoadmap is built.
struct RoadmapOptions {
  std::size_t states = 2000;     ///< to sample, all proven free in the world that it is built in
  std::size_t neighbours = 10;   ///< each state is joined with so many of the nearest
  std::uint32_t seed = 1;        ///< where the sequence of samples begins
  unsigned threads = 1;          ///< that ask; 0: as many as processors. No result depends on it
  StateSpaceOptions space = {};  ///< limits and weights
  /// Once it is requested, by any thread, nothing more is sampled or asked: the roadmap has the
  /// states and motions that are proven by then, or none.
  std::stop_token stop = {};
};

/// A probabilistic roadmap (L. Kavraki et al., 1996) whose motions are all proven, for many queries
/// in a world that changes. Samples are a low-discrepancy sequence, as CertifiedConnect's; where
/// the checker has constraints, they are moved to where these hold. Motions that a body of the
/// world blocks are kept, and are usable once it is gone: see ProvenGraph.
///
/// Queries are const: any number of threads may ask one roadmap, each with its own Workspace, while
/// none updates it. Copies share the states.
class CertifiedRoadmap {
 public:
  /// Samples and joins states. Where few states are free, it gives up after 100 samples for each
  /// that is wanted. Throws std::invalid_argument as ProvenGraph and makeStateSpace do, for no
  /// states and no neighbours, and if no state is free.
  explicit CertifiedRoadmap(std::shared_ptr<const Checker> checker,
                            const RoadmapOptions& options = {});
  /// Of motions that are known, such as those of a file (ProvenGraph::load).
  explicit CertifiedRoadmap(ProvenGraph graph, const StateSpaceOptions& space = {});

  const ProvenGraph& graph() const { return graph_; }       ///< its states and motions
  std::size_t freeMotions() const { return freeMotions_; }  ///< how many
  /// Of states that free motions join.
  std::size_t components() const { return components_; }

  /// As ProvenGraph::update().
  ProvenGraph::Change update(std::shared_ptr<const Checker> changed, unsigned threads = 1,
                             const std::stop_token& stop = {});

  /// A path from start to goal (rad, m) in the current world: the motions between consecutive way
  /// points are proven, by graph().checker() or by arithmetic from what that has proven before.
  /// Empty: none was found.
  ///
  /// The motion from start to goal is tried first. Otherwise each is joined with the nearest state
  /// to which the motion is proven, and A* (P. Hart et al., 1968) finds the shortest way between
  /// the two; where there is none, with the next nearest, up to 20. Throws std::invalid_argument
  /// for a start or goal of another size than a configuration.
  std::optional<std::vector<std::vector<double>>> path(ConfigurationView start,
                                                       ConfigurationView goal,
                                                       Workspace& workspace) const;

  /// The states, and the free motions in both directions, with their lengths as weights. The states
  /// live as long as any copy of this roadmap.
  void getPlannerData(ompl::base::PlannerData& data) const;

 private:
  struct Places;
  struct Link {
    std::uint32_t state = 0;
    std::uint32_t motion = 0;
    double length = 0.0;
  };
  class Joiner;

  void makeLinks();
  void findComponents();
  std::vector<std::uint32_t> shortestWay(std::uint32_t from, std::uint32_t to) const;

  ProvenGraph graph_;
  std::shared_ptr<const Places> places_;
  std::vector<Link> links_;               ///< of all states, one after the other
  std::vector<std::uint32_t> firstLink_;  ///< per state, and one more
  std::vector<std::uint32_t> component_;  ///< per state
  std::size_t freeMotions_ = 0, components_ = 0;
};

/// Answers problems of OMPL from a roadmap: give it to a SimpleSetup. One roadmap serves any number
/// of problems and planners, of the space information of its own group. Motions are proven by the
/// roadmap's checker, and the space information's motion validator is not asked.
class RoadmapPlanner : public ompl::base::Planner {
 public:
  /// Throws std::invalid_argument for null, and for a space of other values than the roadmap's.
  RoadmapPlanner(const ompl::base::SpaceInformationPtr& si,
                 std::shared_ptr<const CertifiedRoadmap> roadmap);

  using Planner::solve;
  /// Waits for the first goal, and tries each start with all goals that are there by then. TIMEOUT,
  /// also before the time is up, if there is no path between any of them.
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;
  /// Of the roadmap.
  void getPlannerData(ompl::base::PlannerData& data) const override;

 private:
  bool addPath(const std::vector<double>& start, const std::vector<double>& goal);

  std::shared_ptr<const CertifiedRoadmap> roadmap_;
  StateConversion conversion_;
  Workspace workspace_;
};

}  // namespace swept
