// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/certified_connect.hpp"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "constraint_steer.hpp"
#include "default_range.hpp"
#include "reach_metric.hpp"
#include "spread_sampler.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "used_checker.hpp"

namespace swept {

namespace {

namespace ob = ompl::base;

constexpr std::size_t kStart = 0, kGoal = 1;

/// The radius of a node whose extension was refused, in ranges; what each later answer changes it
/// by; and the least one.
constexpr double kFirstRadius = 3.0, kRadiusChange = 1e-4, kLeastRadius = 1.0;

/// Samples are from a box around a start and a goal, which is wider by so many ranges on each side,
/// and by so many more with each sample. In the end it is all of the space.
constexpr double kFirstMargin = 0.5, kMarginGrowth = 0.015;

/// The other tree takes its turn unless it has so many times the nodes.
constexpr std::size_t kBalance = 2;

/// Goals that are taken at once, if there are so many; later ones as their tree grows.
constexpr std::size_t kFirstGoals = 4;

}  // namespace

CertifiedConnect::CertifiedConnect(const ob::SpaceInformationPtr& si)
    : Planner(si, "CertifiedConnect") {
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  specs_.approximateSolutions = true;
  specs_.directed = true;
  Planner::declareParam<double>("range", this, &CertifiedConnect::setRange,
                                &CertifiedConnect::getRange, "0.:1.:10000.");
  Planner::declareParam<std::uint32_t>("seed", this, &CertifiedConnect::setSeed,
                                       &CertifiedConnect::getSeed);
  trees_[kStart].start = true;
  for (Tree& tree : trees_)
    tree.nodes.setDistanceFunction(
        [this](const Node* a, const Node* b) { return metric_->distance(a->state, b->state); });
  sample_.state = si_->allocState();
  reached_.state = si_->allocState();
}

CertifiedConnect::~CertifiedConnect() {
  restart();
  si_->freeState(sample_.state);
  si_->freeState(reached_.state);
}

void CertifiedConnect::setSeed(std::uint32_t seed) {
  seed_ = seed;
  sampler_.reset();
}

void CertifiedConnect::setup() {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([this] { setup(); });
  }
  Planner::setup();
  if (range_ <= 0.0) range_ = detail::defaultRange(*si_);
  // The trees keep the metric that they have grown with.
  if (nodes_.empty()) {
    metric_ = std::make_unique<detail::ReachMetric>(*si_);
    for (Tree& tree : trees_) tree.nodes.setJointFactors(metric_->jointFactors());
  }
  provesEnds_ = dynamic_cast<CertifiedMotionValidator*>(si_->getMotionValidator().get()) != nullptr;
}

void CertifiedConnect::clear() {
  Planner::clear();
  restart();
}

void CertifiedConnect::restart() {
  for (Tree& tree : trees_) {
    tree.nodes.clear();
    tree.roots.clear();
  }
  for (const Node& node : nodes_) si_->freeState(node.state);
  nodes_.clear();
  sampler_.reset();
  samples_ = 0;
  turn_ = 0;
  meeting_ = {};
}

CertifiedConnect::Node* CertifiedConnect::add(Tree& tree, const ob::State* state,
                                              const Node* parent) {
  Node& node = nodes_.emplace_back();
  node.state = si_->cloneState(state);
  node.parent = parent;
  tree.nodes.add(&node);
  if (parent == nullptr) tree.roots.push_back(node.state);
  return &node;
}

/// Motions of the goals' tree are proven as the path runs along them.
bool CertifiedConnect::isFree(const Tree& tree, const ob::State* from, const ob::State* to) const {
  if (tree.start) return si_->checkMotion(from, to);
  // Validators may take for granted that a motion's first state is valid.
  return (provesEnds_ || si_->isValid(to)) && si_->checkMotion(to, from);
}

bool CertifiedConnect::isAllowed(const Meeting& meeting) const {
  const auto rootOf = [](const Node* node) {
    while (node->parent != nullptr) node = node->parent;
    return node->state;
  };
  return pdef_->getGoal()->isStartGoalPairValid(rootOf(meeting.start), rootOf(meeting.goal));
}

/// Takes goals up to a number, if there are more. Tries the motion from the nearest state of the
/// starts' tree to each; returns whether one is free.
bool CertifiedConnect::takeGoals(const ob::PlannerTerminationCondition& ptc, std::size_t wanted,
                                 Meeting& meeting) {
  Tree& goals = trees_[kGoal];
  while (goals.nodes.size() == 0 || pis_.getSampledGoalsCount() < wanted) {
    const ob::State* state = goals.nodes.size() == 0 ? pis_.nextGoal(ptc) : pis_.nextGoal();
    if (state == nullptr) return false;
    Node* const goal = add(goals, state, nullptr);
    const Node* const start = trees_[kStart].nodes.nearest(goal);
    meeting = {start, goal};
    if (!isAllowed(meeting)) continue;
    if (si_->checkMotion(start->state, goal->state)) return true;
    if (steer_ == nullptr) continue;
    meeting.start = connectAlong(trees_[kStart], goal);
    if (meeting.start != nullptr && isAllowed(meeting)) return true;
  }
  return false;
}

/// From a node towards the sample. Null: the constraints allow no step that comes nearer.
const ob::State* CertifiedConnect::stepTowards(const Node& near) {
  if (steer_ != nullptr) {
    return steer_->step(near.state, sample_.state, range_, reached_.state) ? reached_.state
                                                                           : nullptr;
  }
  const double distance = si_->distance(near.state, sample_.state);
  if (!(distance > range_)) return sample_.state;
  si_->getStateSpace()->interpolate(near.state, sample_.state, range_ / distance, reached_.state);
  return reached_.state;
}

/// Around each pair of a start and a goal in turns.
void CertifiedConnect::sample() {
  const std::vector<const ob::State*>& starts = trees_[kStart].roots;
  const std::vector<const ob::State*>& goals = trees_[kGoal].roots;
  const std::size_t pair = samples_ % (starts.size() * goals.size());
  const double margin = kFirstMargin + kMarginGrowth * static_cast<double>(samples_);
  sampler_->sampleAround(starts[pair % starts.size()], goals[pair / starts.size()], margin * range_,
                         sample_.state);
  ++samples_;
}

/// A step towards the next sample. Null: the sample is not taken, or the way is not free.
CertifiedConnect::Node* CertifiedConnect::extend(Tree& tree) {
  sample();
  if (steer_ != nullptr && !steer_->project(sample_.state)) return nullptr;
  Node* const near = tree.nodes.nearest(&sample_);
  const double distance = metric_->distance(near->state, sample_.state);
  if (distance > near->radius || distance == 0.0) return nullptr;
  const ob::State* const to = stepTowards(*near);
  const bool wasRefused = std::isfinite(near->radius);
  if (to != nullptr && isFree(tree, near->state, to)) {
    if (wasRefused) near->radius *= 1.0 + kRadiusChange;
    return add(tree, to, near);
  }
  near->radius = wasRefused ? std::max((1.0 - kRadiusChange) * near->radius, kLeastRadius * range_)
                            : kFirstRadius * range_;
  return nullptr;
}

/// Steps from the nearest node towards a node of the other tree. The last node, if its motion to
/// that one is free.
const CertifiedConnect::Node* CertifiedConnect::connect(Tree& tree, Node* to) {
  if (steer_ != nullptr) return connectAlong(tree, to);
  const ob::StateSpace& space = *si_->getStateSpace();
  const Node* const first = tree.nodes.nearest(to);
  const double steps = std::max(1.0, std::ceil(si_->distance(first->state, to->state) / range_));
  const Node* last = first;
  for (double step = 1.0; step < steps; step += 1.0) {
    space.interpolate(first->state, to->state, step / steps, reached_.state);
    if (!isFree(tree, last->state, reached_.state)) return nullptr;
    last = add(tree, reached_.state, last);
  }
  return isFree(tree, last->state, to->state) ? last : nullptr;
}

/// The same by steps that keep the constraints.
const CertifiedConnect::Node* CertifiedConnect::connectAlong(Tree& tree, const Node* to) {
  Node wanted = *to;
  const Node* last = tree.nodes.nearest(&wanted);
  for (;;) {
    if (!steer_->step(last->state, to->state, range_, reached_.state)) return nullptr;
    if (!isFree(tree, last->state, reached_.state)) return nullptr;
    if (si_->equalStates(reached_.state, to->state)) return last;
    last = add(tree, reached_.state, last);
  }
}

/// Returns whether the trees meet.
bool CertifiedConnect::grow(Meeting& meeting) {
  const auto other = static_cast<std::size_t>(1 - turn_);
  const std::size_t own = trees_[static_cast<std::size_t>(turn_)].nodes.size();
  if (trees_[other].nodes.size() < kBalance * own) turn_ = 1 - turn_;
  Tree& tree = trees_[static_cast<std::size_t>(turn_)];
  Node* const node = extend(tree);
  if (node == nullptr) return false;
  const Node* const met = connect(trees_[static_cast<std::size_t>(1 - turn_)], node);
  if (met == nullptr) return false;
  meeting = tree.start ? Meeting{node, met} : Meeting{met, node};
  return isAllowed(meeting);
}

std::shared_ptr<ompl::geometric::PathGeometric> CertifiedConnect::pathTo(const Node* last) const {
  std::vector<const ob::State*> states;
  for (const Node* node = last; node != nullptr; node = node->parent) states.push_back(node->state);
  auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
  for (std::size_t i = states.size(); i > 0; --i) path->append(states[i - 1]);
  return path;
}

void CertifiedConnect::addSolution(const Meeting& meeting) {
  meeting_ = meeting;
  const auto path = pathTo(meeting.start);
  for (const Node* node = meeting.goal; node != nullptr; node = node->parent)
    path->append(node->state);
  pdef_->addSolutionPath(path, false, 0.0, getName());
}

/// False: no state of the starts' tree has a distance from the goal.
bool CertifiedConnect::addApproximation() {
  std::vector<Node*> nodes;
  trees_[kStart].nodes.list(nodes);
  const Node* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Node* node : nodes) {
    double distance = least;
    pdef_->getGoal()->isSatisfied(node->state, &distance);
    if (!(distance < least)) continue;
    least = distance;
    nearest = node;
  }
  if (nearest == nullptr) return false;
  pdef_->addSolutionPath(pathTo(nearest), true, least, getName());
  return true;
}

ob::PlannerStatus CertifiedConnect::solve(const ob::PlannerTerminationCondition& ptc) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return solve(ptc); });
  }
  checkValidity();
  const auto* goal = dynamic_cast<ob::GoalSampleableRegion*>(pdef_->getGoal().get());
  if (goal == nullptr) {
    OMPL_ERROR("%s: Unknown type of goal", getName().c_str());
    return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  }
  if (auto checker = detail::checkerOf(*si_); checker != checker_ || steer_ == nullptr) {
    steer_ = detail::steerOf(*si_);
    checker_ = std::move(checker);
  }
  if (!sampler_) sampler_ = std::make_unique<detail::SpreadSampler>(si_->getStateSpace(), seed_);
  while (const ob::State* state = pis_.nextStart()) add(trees_[kStart], state, nullptr);
  if (trees_[kStart].nodes.size() == 0) {
    OMPL_ERROR("%s: There are no valid initial states", getName().c_str());
    return ob::PlannerStatus::INVALID_START;
  }
  if (!goal->couldSample()) {
    OMPL_ERROR("%s: Insufficient states in sampleable goal region", getName().c_str());
    return ob::PlannerStatus::INVALID_GOAL;
  }
  OMPL_INFORM("%s: Starting planning with %u states already in datastructure", getName().c_str(),
              static_cast<unsigned>(nodes_.size()));
  const ob::PlannerStatus status = search(ptc);
  OMPL_INFORM("%s: Created %u states (%u start + %u goal)", getName().c_str(),
              static_cast<unsigned>(nodes_.size()),
              static_cast<unsigned>(trees_[kStart].nodes.size()),
              static_cast<unsigned>(trees_[kGoal].nodes.size()));
  return status;
}

ob::PlannerStatus CertifiedConnect::search(const ob::PlannerTerminationCondition& ptc) {
  const Tree& goals = trees_[kGoal];
  std::size_t wanted = kFirstGoals;
  while (!ptc) {
    Meeting meeting;
    bool met = takeGoals(ptc, wanted, meeting);
    if (goals.nodes.size() == 0) {
      OMPL_ERROR("%s: Unable to sample any valid states for goal tree", getName().c_str());
      return ptc ? ob::PlannerStatus::TIMEOUT : ob::PlannerStatus::INVALID_GOAL;
    }
    met = met || grow(meeting);
    if (met) {
      addSolution(meeting);
      return ob::PlannerStatus::EXACT_SOLUTION;
    }
    wanted = goals.nodes.size() / 2;
  }
  return addApproximation() ? ob::PlannerStatus::APPROXIMATE_SOLUTION : ob::PlannerStatus::TIMEOUT;
}

void CertifiedConnect::getPlannerData(ob::PlannerData& data) const {
  Planner::getPlannerData(data);
  constexpr int kStartTag = 1, kGoalTag = 2;
  std::vector<Node*> nodes;
  trees_[kStart].nodes.list(nodes);
  for (const Node* node : nodes) {
    if (node->parent == nullptr)
      data.addStartVertex(ob::PlannerDataVertex(node->state, kStartTag));
    else
      data.addEdge(ob::PlannerDataVertex(node->parent->state, kStartTag),
                   ob::PlannerDataVertex(node->state, kStartTag));
  }
  trees_[kGoal].nodes.list(nodes);
  for (const Node* node : nodes) {
    if (node->parent == nullptr)
      data.addGoalVertex(ob::PlannerDataVertex(node->state, kGoalTag));
    else  // The path runs towards the goal.
      data.addEdge(ob::PlannerDataVertex(node->state, kGoalTag),
                   ob::PlannerDataVertex(node->parent->state, kGoalTag));
  }
  if (meeting_.start != nullptr)
    data.addEdge(data.vertexIndex(ob::PlannerDataVertex(meeting_.start->state)),
                 data.vertexIndex(ob::PlannerDataVertex(meeting_.goal->state)));
}

}  // namespace swept
