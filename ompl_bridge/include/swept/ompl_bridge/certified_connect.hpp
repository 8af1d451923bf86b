// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/Planner.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/PathGeometric.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include "swept/ompl_bridge/nearest_states.hpp"

namespace swept {

class Checker;

namespace detail {
class ConstraintSteer;
class ReachMetric;
class SpreadSampler;
}  // namespace detail

/// RRT-Connect (J. Kuffner and S. LaValle, 2000) for motions that are quickly proven or refused.
/// Give it to a SimpleSetup as any planner of OMPL.
///
/// It differs from ompl::geometric::RRTConnect in this: Samples are a low-discrepancy sequence,
/// from a box around start and goal that grows with each of them until it is all of the space. The
/// nearest node is the one from which the least space is swept: joints count by how far they move
/// the robot. A node whose extension was refused takes only samples nearby from then on (A.
/// Yershova et al., Dynamic-domain RRTs, 2005; L. Jaillet et al., Adaptive tuning of the sampling
/// domain, 2005). The tree that is less than half as large as the other is extended until it is not
/// (balanced trees, J. Kuffner and S. LaValle, 2005). The motion from start to goal is tried first.
/// No state is checked that a motion proves. Nearest neighbours are those of NearestStates. Most of
/// this is as in VAMP (W. Thomason, Z. Kingston and L. Kavraki, Motions in microseconds, 2024).
///
/// Where the checker of the validators has constraints (Checker::withConstraints), it plans along
/// them: samples are brought to where they hold, and so is the end of each step towards one, which
/// is halved until the straight motion keeps them (D. Berenson et al., Manipulation planning on
/// constraint manifolds, 2009). The validator then proves the motion.
///
/// It takes goals that can be sampled, several starts and goals, and goals that come while it runs.
/// The same problem, range and seed give the same path, unless goals come from another thread. With
/// a CertifiedMotionValidator, every motion of its trees is proven. Other validators and spaces
/// will do, too.
class CertifiedConnect : public ompl::base::Planner {
 public:
  /// For a space information of any space and validators.
  explicit CertifiedConnect(const ompl::base::SpaceInformationPtr& si);
  ~CertifiedConnect() override;

  /// Longest motion of a tree, in the metric of the space. 0, the default: setup() chooses 0.4 rad
  /// of each joint that turns and a fifth of the way of each that slides, combined by the metric;
  /// in spaces of others a fifth of the extent.
  void setRange(double range) { range_ = range; }
  double getRange() const { return range_; }  ///< after setup() the one in use
  /// Where the sequence of samples begins.
  void setSeed(std::uint32_t seed);
  std::uint32_t getSeed() const { return seed_; }  ///< 1 if never set

  /// Chooses the range, if none is set. The validators of the space information must be in place.
  void setup() override;
  /// Forgets the trees, and begins the sequence of samples anew.
  void clear() override;
  using Planner::solve;
  /// Without a solution, the path to the state nearest to the goal is an approximate one.
  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& ptc) override;
  /// Both trees, and the motion between them.
  void getPlannerData(ompl::base::PlannerData& data) const override;

 private:
  struct Node {
    ompl::base::State* state = nullptr;
    const Node* parent = nullptr;
    /// Samples farther away are not taken.
    double radius = std::numeric_limits<double>::infinity();
  };
  struct Tree {
    bool start = false;  ///< rooted at starts, else at goals
    NearestStates<Node*> nodes = {};
    std::vector<const ompl::base::State*> roots = {};  ///< of nodes without a parent
  };
  /// A node of each tree: the same state, or the ends of a proven motion.
  struct Meeting {
    const Node* start = nullptr;
    const Node* goal = nullptr;
  };

  void restart();
  Node* add(Tree& tree, const ompl::base::State* state, const Node* parent);
  bool isFree(const Tree& tree, const ompl::base::State* from, const ompl::base::State* to) const;
  bool takeGoals(const ompl::base::PlannerTerminationCondition& ptc, std::size_t wanted,
                 Meeting& meeting);
  Node* extend(Tree& tree);
  const Node* connect(Tree& tree, Node* to);
  const Node* connectAlong(Tree& tree, const Node* to);
  const ompl::base::State* stepTowards(const Node& near);
  void sample();
  bool isAllowed(const Meeting& meeting) const;
  bool grow(Meeting& meeting);
  ompl::base::PlannerStatus search(const ompl::base::PlannerTerminationCondition& ptc);
  std::shared_ptr<ompl::geometric::PathGeometric> pathTo(const Node* last) const;
  void addSolution(const Meeting& meeting);
  bool addApproximation();

  double range_ = 0.0;
  std::uint32_t seed_ = 1;
  bool provesEnds_ = false;  ///< a motion is free only if both ends are
  std::unique_ptr<detail::SpreadSampler> sampler_;
  std::size_t samples_ = 0;                         ///< drawn since the trees were empty
  std::unique_ptr<detail::ReachMetric> metric_;     ///< of the nearest node, and of radii
  std::shared_ptr<const Checker> checker_;          ///< whose constraints steer_ keeps
  std::unique_ptr<detail::ConstraintSteer> steer_;  ///< null: there are none
  std::deque<Node> nodes_;
  std::array<Tree, 2> trees_;  ///< of starts, of goals
  int turn_ = 0;               ///< the tree that was extended last
  Node sample_, reached_;      ///< states to work with; not in a tree
  Meeting meeting_;            ///< of the last solution
};

}  // namespace swept
