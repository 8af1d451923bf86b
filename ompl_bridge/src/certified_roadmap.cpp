// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/certified_roadmap.hpp"

#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "constraint_steer.hpp"
#include "preconditions.hpp"
#include "spread_sampler.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/nearest_states.hpp"

namespace swept {

namespace {

namespace ob = ompl::base;

/// Samples for each state that is wanted.
constexpr std::size_t kMostSamples = 100;
/// Samples that are checked together.
constexpr std::size_t kSamplesAtOnce = 256;
/// Of a start or goal: nearest states that it is joined with.
constexpr std::size_t kMostJoins = 20;

const std::shared_ptr<const Checker>& required(const std::shared_ptr<const Checker>& checker) {
  if (!checker) throw std::invalid_argument("CertifiedRoadmap: the checker must not be null");
  return checker;
}

}  // namespace

/// The states in the space of the planner, and which are near.
struct CertifiedRoadmap::Places {
  struct Node {
    ob::State* state = nullptr;
    std::uint32_t index = 0;
  };

  Places(const Checker& checker, const StateSpaceOptions& options)
      : space(makeStateSpace(checker.robot(), checker.group(), options)),
        conversion(checker.robot(), checker.group()) {
    space->setup();
    near.setDistanceFunction(
        [this](const Node* a, const Node* b) { return space->distance(a->state, b->state); });
  }
  ~Places() {
    for (const auto& node : nodes) space->freeState(node->state);
  }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  void add(ConfigurationView q) {
    nodes.push_back(std::make_unique<Node>());
    nodes.back()->state = space->allocState();
    nodes.back()->index = static_cast<std::uint32_t>(nodes.size() - 1);
    conversion.toState(q, nodes.back()->state);
    near.add(nodes.back().get());
  }
  double distance(std::uint32_t a, std::uint32_t b) const {
    return space->distance(nodes[a]->state, nodes[b]->state);
  }

  ob::StateSpacePtr space;
  StateConversion conversion;
  std::vector<std::unique_ptr<Node>> nodes;
  NearestStates<Node*> near;
};

/// Joins a start or goal with states, the nearest first.
class CertifiedRoadmap::Joiner {
 public:
  struct Join {
    std::uint32_t state = 0;
    std::uint32_t component = 0;
  };

  Joiner(const CertifiedRoadmap& roadmap, ConfigurationView q, bool isGoal, Workspace& workspace)
      : roadmap_(roadmap), q_(q), isGoal_(isGoal), workspace_(workspace) {
    const Places& places = *roadmap.places_;
    Places::Node node{places.space->allocState()};
    places.conversion.toState(q, node.state);
    places.near.nearestK(&node, kMostJoins, near_);
    places.space->freeState(node.state);
  }

  /// One more. False: there is none.
  bool advance() {
    while (next_ < near_.size()) {
      const std::uint32_t index = near_[next_++]->index;
      const ConfigurationView state = roadmap_.graph_.state(index);
      const Checker& checker = *roadmap_.graph_.checker();
      const MotionCertificate certificate =
          isGoal_ ? checker.certifyMotion(state, q_, workspace_, MotionQuery::VerdictOnly)
                  : checker.certifyMotion(q_, state, workspace_, MotionQuery::VerdictOnly);
      if (certificate.verdict != Verdict::Free) continue;
      joins_.push_back({index, roadmap_.component_[index]});
      return true;
    }
    return false;
  }

  const std::vector<Join>& joins() const { return joins_; }

 private:
  const CertifiedRoadmap& roadmap_;
  ConfigurationView q_;
  bool isGoal_;
  Workspace& workspace_;
  std::vector<Places::Node*> near_;
  std::size_t next_ = 0;
  std::vector<Join> joins_;
};

CertifiedRoadmap::CertifiedRoadmap(std::shared_ptr<const Checker> checker,
                                   const RoadmapOptions& options)
    : graph_(required(checker)) {
  if (detail::inForeignEnvironment()) {
    *this = inDefaultEnvironment([&] { return CertifiedRoadmap(std::move(checker), options); });
    return;
  }
  if (options.states == 0 || options.neighbours == 0)
    throw std::invalid_argument("CertifiedRoadmap: " + std::to_string(options.states) +
                                " states and " + std::to_string(options.neighbours) +
                                " neighbours are asked for; at least one of each is needed");
  const auto places = std::make_shared<Places>(*checker, options.space);
  detail::SpreadSampler sampler(places->space, options.seed);
  const auto dimension = static_cast<std::size_t>(checker->dimension());
  std::vector<double> samples(kSamplesAtOnce * dimension);
  std::vector<Verdict> verdicts(kSamplesAtOnce);
  Workspace workspace(*checker);
  std::optional<detail::ConstraintSteer> steer;
  if (!checker->options().constraints.empty()) steer.emplace(places->space, *checker);
  ob::State* const state = places->space->allocState();
  for (std::size_t drawn = 0;
       graph_.states() < options.states && drawn < kMostSamples * options.states &&
       !options.stop.stop_requested();
       drawn += kSamplesAtOnce) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < kSamplesAtOnce; ++i) {
      sampler.sample(state);
      // Hardly any sample keeps constraints that are tight.
      if (steer && !steer->project(state)) continue;
      places->conversion.toConfiguration(
          state, ConfigurationSpan(samples.data() + count * dimension, dimension));
      ++count;
    }
    checker->checkStates(std::span(samples).first(count * dimension),
                         std::span(verdicts).first(count), workspace);
    for (std::size_t i = 0; i < count && graph_.states() < options.states; ++i) {
      if (verdicts[i] != Verdict::Free) continue;
      const ConfigurationView q(samples.data() + i * dimension, dimension);
      graph_.addState(q);
      places->add(q);
    }
  }
  places->space->freeState(state);
  if (graph_.states() == 0 && !options.stop.stop_requested())
    throw std::invalid_argument("CertifiedRoadmap: none of " +
                                std::to_string(kMostSamples * options.states) +
                                " states is proven free");
  std::vector<ProvenGraph::Motion> motions;
  std::vector<Places::Node*> near;
  for (const auto& node : places->nodes) {
    if (options.stop.stop_requested()) break;
    places->near.nearestK(node.get(), options.neighbours + 1, near);
    for (const Places::Node* other : near)
      if (other != node.get())
        motions.push_back(
            {std::min(node->index, other->index), std::max(node->index, other->index)});
  }
  const auto ends = [](const ProvenGraph::Motion& motion) {
    return std::pair(motion.from, motion.to);
  };
  std::ranges::sort(motions, {}, ends);
  const auto doubles = std::ranges::unique(motions, {}, ends);
  motions.erase(doubles.begin(), doubles.end());
  graph_.addMotions(motions, options.threads, options.stop);
  places_ = places;
  makeLinks();
}

CertifiedRoadmap::CertifiedRoadmap(ProvenGraph graph, const StateSpaceOptions& space)
    : graph_(std::move(graph)) {
  if (detail::inForeignEnvironment()) {
    *this = inDefaultEnvironment([&] { return CertifiedRoadmap(std::move(graph_), space); });
    return;
  }
  const auto places = std::make_shared<Places>(*graph_.checker(), space);
  for (std::size_t i = 0; i < graph_.states(); ++i) places->add(graph_.state(i));
  places_ = places;
  makeLinks();
}

void CertifiedRoadmap::makeLinks() {
  firstLink_.assign(graph_.states() + 1, 0);
  for (std::size_t i = 0; i < graph_.motions(); ++i) {
    ++firstLink_[graph_.motion(i).from + 1];
    ++firstLink_[graph_.motion(i).to + 1];
  }
  std::partial_sum(firstLink_.begin(), firstLink_.end(), firstLink_.begin());
  links_.resize(2 * graph_.motions());
  std::vector<std::uint32_t> next(firstLink_.begin(), firstLink_.end() - 1);
  for (std::size_t i = 0; i < graph_.motions(); ++i) {
    const auto [from, to] = graph_.motion(i);
    const double length = places_->distance(from, to);
    links_[next[from]++] = {to, static_cast<std::uint32_t>(i), length};
    links_[next[to]++] = {from, static_cast<std::uint32_t>(i), length};
  }
  findComponents();
}

/// Disjoint sets, whose representative is the least state (R. Tarjan, 1975; path halving).
void CertifiedRoadmap::findComponents() {
  std::vector<std::uint32_t>& parent = component_;
  parent.resize(graph_.states());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto rootOf = [&parent](std::uint32_t i) {
    while (parent[i] != i) {
      parent[i] = parent[parent[i]];
      i = parent[i];
    }
    return i;
  };
  freeMotions_ = 0;
  for (std::size_t i = 0; i < graph_.motions(); ++i) {
    if (!graph_.isFree(i)) continue;
    ++freeMotions_;
    const std::uint32_t a = rootOf(graph_.motion(i).from), b = rootOf(graph_.motion(i).to);
    parent[std::max(a, b)] = std::min(a, b);
  }
  components_ = 0;
  for (std::uint32_t i = 0; i < parent.size(); ++i) {
    parent[i] = rootOf(i);
    components_ += parent[i] == i ? 1 : 0;
  }
}

ProvenGraph::Change CertifiedRoadmap::update(std::shared_ptr<const Checker> changed,
                                             unsigned threads, const std::stop_token& stop) {
  const ProvenGraph::Change change = graph_.update(std::move(changed), threads, stop);
  if (change.stopped) return change;
  change.everything ? makeLinks() : findComponents();
  return change;
}

/// The states on the way, both ends included. They are in one component.
std::vector<std::uint32_t> CertifiedRoadmap::shortestWay(std::uint32_t from,
                                                         std::uint32_t to) const {
  struct Seen {
    double least = std::numeric_limits<double>::infinity();  // from the start
    double left = -1.0;                                      // to the goal, at least
    std::uint32_t before = 0;
    bool isDone = false;
  };
  std::vector<Seen> seen(graph_.states());
  using Open = std::pair<double, std::uint32_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  seen[from].least = 0.0;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const std::uint32_t state = open.top().second;
    open.pop();
    if (seen[state].isDone) continue;
    seen[state].isDone = true;
    if (state == to) break;
    for (std::uint32_t i = firstLink_[state]; i < firstLink_[state + 1]; ++i) {
      const Link& link = links_[i];
      Seen& next = seen[link.state];
      const double length = seen[state].least + link.length;
      if (next.isDone || !(length < next.least) || !graph_.isFree(link.motion)) continue;
      if (next.left < 0.0) next.left = places_->distance(link.state, to);
      next.least = length;
      next.before = state;
      open.emplace(length + next.left, link.state);
    }
  }
  std::vector<std::uint32_t> way{to};
  while (way.back() != from) way.push_back(seen[way.back()].before);
  std::ranges::reverse(way);
  return way;
}

std::optional<std::vector<std::vector<double>>> CertifiedRoadmap::path(ConfigurationView start,
                                                                       ConfigurationView goal,
                                                                       Workspace& workspace) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, start, goal] { return path(start, goal, workspace); });
  }
  std::vector<std::vector<double>> points;
  const auto add = [&points](ConfigurationView q) { points.emplace_back(q.begin(), q.end()); };
  add(start);
  const Verdict direct =
      graph_.checker()->certifyMotion(start, goal, workspace, MotionQuery::VerdictOnly).verdict;
  if (direct == Verdict::Free) {
    add(goal);
    return points;
  }
  Joiner starts(*this, start, false, workspace), goals(*this, goal, true, workspace);
  // A start without a state needs no goal. In turns, for either may be in another component.
  for (bool atGoal = false, otherEnded = false;; atGoal = !atGoal) {
    Joiner& own = atGoal ? goals : starts;
    const Joiner& other = atGoal ? starts : goals;
    const bool ended = !own.advance();
    if (ended && (otherEnded || own.joins().empty())) return std::nullopt;
    otherEnded = ended;
    if (ended) continue;
    const Joiner::Join& last = own.joins().back();
    const auto met = std::ranges::find(other.joins(), last.component, &Joiner::Join::component);
    if (met == other.joins().end()) continue;
    const std::uint32_t from = atGoal ? met->state : last.state;
    const std::uint32_t to = atGoal ? last.state : met->state;
    for (const std::uint32_t state : shortestWay(from, to)) add(graph_.state(state));
    add(goal);
    return points;
  }
}

void CertifiedRoadmap::getPlannerData(ob::PlannerData& data) const {
  for (const auto& node : places_->nodes) data.addVertex(ob::PlannerDataVertex(node->state));
  for (std::uint32_t state = 0; state < places_->nodes.size(); ++state)
    for (std::uint32_t i = firstLink_[state]; i < firstLink_[state + 1]; ++i)
      if (graph_.isFree(links_[i].motion))
        data.addEdge(state, links_[i].state, ob::PlannerDataEdge(), ob::Cost(links_[i].length));
}

RoadmapPlanner::RoadmapPlanner(const ob::SpaceInformationPtr& si,
                               std::shared_ptr<const CertifiedRoadmap> roadmap)
    : Planner(si, "RoadmapPlanner"),
      roadmap_(roadmap != nullptr
                   ? std::move(roadmap)
                   : throw std::invalid_argument("RoadmapPlanner: the roadmap must not be null")),
      conversion_(roadmap_->graph().checker()->robot(), roadmap_->graph().checker()->group()),
      workspace_(*roadmap_->graph().checker()) {
  detail::requireSpaceOf(*roadmap_->graph().checker(), *si->getStateSpace());
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  specs_.directed = true;
}

bool RoadmapPlanner::addPath(const std::vector<double>& start, const std::vector<double>& goal) {
  const auto points = roadmap_->path(start, goal, workspace_);
  if (!points) return false;
  const auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
  ob::State* const state = si_->allocState();
  for (const std::vector<double>& q : *points) {
    conversion_.toState(q, state);
    path->append(state);
  }
  si_->freeState(state);
  pdef_->addSolutionPath(path, false, 0.0, getName());
  return true;
}

ob::PlannerStatus RoadmapPlanner::solve(const ob::PlannerTerminationCondition& ptc) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return solve(ptc); });
  }
  checkValidity();
  const auto valuesOf = [this](const ob::State* state) {
    std::vector<double> q(static_cast<std::size_t>(conversion_.dimension()));
    conversion_.toConfiguration(state, q);
    return q;
  };
  pis_.restart();
  std::vector<std::vector<double>> starts;
  while (const ob::State* state = pis_.nextStart()) starts.push_back(valuesOf(state));
  if (starts.empty()) return ob::PlannerStatus::INVALID_START;
  bool anyGoal = false;
  while (const ob::State* state = anyGoal ? pis_.nextGoal() : pis_.nextGoal(ptc)) {
    anyGoal = true;
    for (const std::vector<double>& start : starts)
      if (addPath(start, valuesOf(state))) return ob::PlannerStatus::EXACT_SOLUTION;
  }
  return anyGoal ? ob::PlannerStatus::TIMEOUT : ob::PlannerStatus::INVALID_GOAL;
}

void RoadmapPlanner::getPlannerData(ob::PlannerData& data) const {
  roadmap_->getPlannerData(data);
}

}  // namespace swept
