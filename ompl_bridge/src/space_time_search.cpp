// SPDX-License-Identifier: BSD-3-Clause
#include "space_time_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "swept/core/verdict.hpp"

namespace swept::detail {

namespace {

constexpr double kTimeWeight = 0.2;   // of waiting, in the distance of two knots
constexpr double kWaitShare = 0.1;    // of extensions that wait where a node is
constexpr int kWaits = 5;             // nodes that wait at the start, to begin with
constexpr int kRootEvery = 8;         // extensions, for another arrival
constexpr int kWiderEvery = 256;      // extensions, for later arrivals
constexpr int kMostSteps = 64;        // of one connection
constexpr double kLeastWindow = 1.0;  // s
constexpr double kSpare = 1e-6;       // s, so that no motion is too short by rounding

}  // namespace

Eigen::VectorXd OwnSpace::way(const Eigen::VectorXd& from, const Eigen::VectorXd& to) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  Eigen::ArrayXd way = to - from;
  return cyclic.select(way - kTurn * (way / kTurn).round(), way).matrix();
}

SpaceTimeSearch::SpaceTimeSearch(const ScheduleChecker& checker, const OwnSpace& space,
                                 unsigned seed)
    : checker_(checker), space_(space), workspace_(checker.checker()), random_(seed) {}

/// In [0, 1), the same on all systems.
double SpaceTimeSearch::uniform() {
  return static_cast<double>(random_()) * 0x1p-32;
}

std::size_t SpaceTimeSearch::index(std::size_t count) {
  return std::min(count - 1, static_cast<std::size_t>(uniform() * static_cast<double>(count)));
}

bool SpaceTimeSearch::isFree(const TimedKnot& from, const TimedKnot& to) {
  const TimedKnot there{from.q + space_.way(from.q, to.q), to.time};
  const std::vector<TimedKnot> knots = restToRest(from, there, space_.planned);
  if (knots.size() == 1) {
    Eigen::MatrixXd rest = from.q.replicate(1, 2);
    return to.time > from.time && checker_.certify({{from.time, to.time}, {std::move(rest)}},
                                                   workspace_, MotionQuery::VerdictOnly)
                                          .verdict == Verdict::Free;
  }
  const std::optional<PiecewisePolynomial> curve = blended(knots, from.time, space_.bounds);
  return curve &&
         checker_.certify(*curve, workspace_, MotionQuery::VerdictOnly).verdict == Verdict::Free;
}

/// Whether an edge of the tree leads from a node to there.
bool SpaceTimeSearch::connects(const Tree& tree, const Node& node, const TimedKnot& to) {
  return tree.direction > 0.0 ? isFree(node.at, to) : isFree(to, node.at);
}

/// Another arrival at a goal, rather an early one.
void SpaceTimeSearch::addRoot() {
  const std::size_t goal = index(goals_.size());
  const double share = backward_.nodes.empty() ? 0.0 : uniform();
  const double time = arrival_.first + share * share * (arrival_.last - arrival_.first);
  const Eigen::VectorXd way = space_.way(forward_.nodes.front().at.q, goals_[goal].q);
  if (time < goals_[goal].restFrom ||
      time < forward_.nodes.front().at.time + space_.planned.restToRest(way))
    return;
  backward_.nodes.push_back({{goals_[goal].q, time}, kRoot, goal});
}

/// A configuration at a time between start and goals, if there is one.
std::optional<TimedKnot> SpaceTimeSearch::sample() {
  TimedKnot knot;
  knot.q.resize(space_.lower.size());
  for (Eigen::Index v = 0; v < knot.q.size(); ++v)
    knot.q[v] = space_.lower[v] + uniform() * (space_.upper[v] - space_.lower[v]);
  const auto from = [&](const Node& root) {
    return space_.planned.restToRest(space_.way(root.at.q, knot.q));
  };
  const Node& start = forward_.nodes.front();
  const Node& root = backward_.nodes[index(backward_.nodes.size())];
  const double first = start.at.time + from(start), last = root.at.time - from(root);
  if (!(first < last)) return std::nullopt;
  knot.time = first + uniform() * (last - first);
  return knot;
}

/// The node from which an edge may lead there, with the least time of motion and of waiting.
std::optional<std::size_t> SpaceTimeSearch::nearest(const Tree& tree, const TimedKnot& to) const {
  std::optional<std::size_t> found;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const TimedKnot& at = tree.nodes[i].at;
    const double duration = tree.direction * (to.time - at.time);
    if (!(duration > 0.0) || kTimeWeight * duration >= least) continue;
    const double motion = space_.planned.restToRest(space_.way(at.q, to.q));
    if (motion > duration || motion + kTimeWeight * duration >= least) continue;
    least = motion + kTimeWeight * duration;
    found = i;
  }
  return found;
}

/// A new node on the way from a node to there, or there. No value: it is not proven.
std::optional<std::size_t> SpaceTimeSearch::step(Tree& tree, std::size_t from, const TimedKnot& to,
                                                 bool whole) {
  const Node& node = tree.nodes[from];
  const Eigen::VectorXd way = space_.way(node.at.q, to.q);
  const double duration = tree.direction * (to.time - node.at.time);
  const double steps = whole ? 1.0 : (way.array().abs() / space_.range).maxCoeff();
  TimedKnot next = to;
  if (steps > 1.0) {
    const Eigen::VectorXd part = way / steps;
    next.q = node.at.q + part;
    next.time =
        node.at.time + tree.direction * std::max(duration / steps, space_.planned.restToRest(part));
    // Stopping on the way may take longer than there is time.
    if (tree.direction * (to.time - next.time) < 0.0) return std::nullopt;
  } else if (duration < space_.planned.restToRest(way)) {
    return std::nullopt;
  }
  if (!connects(tree, node, next)) return std::nullopt;
  tree.nodes.push_back({std::move(next), from, node.goal});
  return tree.nodes.size() - 1;
}

/// A new node towards a sample.
std::optional<std::size_t> SpaceTimeSearch::extend(Tree& tree) {
  if (uniform() < kWaitShare) {
    const std::size_t from = index(tree.nodes.size());
    const double room = tree.direction > 0.0
                            ? arrival_.last - tree.nodes[from].at.time
                            : tree.nodes[from].at.time - forward_.nodes.front().at.time;
    if (!(room > 0.0)) return std::nullopt;
    TimedKnot later = tree.nodes[from].at;
    later.time += tree.direction * uniform() * room;
    return step(tree, from, later, true);
  }
  const std::optional<TimedKnot> to = sample();
  if (!to) return std::nullopt;
  const std::optional<std::size_t> from = nearest(tree, *to);
  return from ? step(tree, *from, *to, false) : std::nullopt;
}

/// The node of the tree that is there, if edges lead there.
std::optional<std::size_t> SpaceTimeSearch::reach(Tree& tree, const TimedKnot& to) {
  std::optional<std::size_t> at = nearest(tree, to);
  if (!at) return std::nullopt;
  if (const std::optional<std::size_t> there = step(tree, *at, to, true)) return there;
  for (int i = 0; at && i < kMostSteps; ++i) {
    at = step(tree, *at, to, false);
    if (at && tree.nodes[*at].at.time == to.time) return at;
  }
  return std::nullopt;
}

std::vector<TimedKnot> SpaceTimeSearch::path(std::size_t first, std::size_t last) const {
  std::vector<TimedKnot> nodes;
  for (std::size_t i = first; i != kRoot; i = forward_.nodes[i].parent)
    nodes.push_back(forward_.nodes[i].at);
  std::ranges::reverse(nodes);
  for (std::size_t i = backward_.nodes[last].parent; i != kRoot; i = backward_.nodes[i].parent)
    nodes.push_back(backward_.nodes[i].at);
  std::vector<TimedKnot> knots;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    // Values of cyclic variables go on beyond a turn.
    nodes[i + 1].q = nodes[i].q + space_.way(nodes[i].q, nodes[i + 1].q);
    const std::vector<TimedKnot> own = restToRest(nodes[i], nodes[i + 1], space_.planned);
    if (own.size() > 1) knots.insert(knots.end(), own.begin(), own.end());
  }
  if (knots.empty()) knots.push_back(nodes.front());
  return knots;
}

std::vector<TimedKnot> SpaceTimeSearch::run(const TimedKnot& start, std::vector<TimedGoal> goals,
                                            double latest, const std::function<bool()>& stop) {
  goals_ = std::move(goals);
  forward_ = {.direction = 1.0, .nodes = {{start}}};
  backward_ = {.direction = -1.0};
  arrival_ = {latest, latest};
  double shortest = std::numeric_limits<double>::infinity();
  for (const TimedGoal& goal : goals_) {
    const double way = space_.planned.restToRest(space_.way(start.q, goal.q));
    arrival_.first = std::min(arrival_.first, std::max(goal.restFrom, start.time + way));
    shortest = std::min(shortest, way);
  }
  arrival_.first += kSpare;
  const double width = std::max(shortest, kLeastWindow);
  arrival_.last = std::min(latest, std::max(arrival_.first, checker_.end()) + width);
  for (int i = 0; i < kWaits && !stop(); ++i) {
    TimedKnot later = start;
    later.time += std::ldexp(std::max(checker_.end() - start.time, kLeastWindow), -i);
    step(forward_, 0, later, true);
  }
  for (int i = 0; !stop(); ++i) {
    if (i % kRootEvery == 0 || backward_.nodes.empty()) addRoot();
    if (i > 0 && i % kWiderEvery == 0) arrival_.last = std::min(latest, arrival_.last + width);
    if (backward_.nodes.empty()) continue;
    const bool fromStart = i % 2 == 0;
    Tree& tree = fromStart ? forward_ : backward_;
    Tree& other = fromStart ? backward_ : forward_;
    // The newest arrival first: it may be reached directly.
    const bool root = i % kRootEvery == 0;
    const std::optional<std::size_t> added =
        root ? std::optional(backward_.nodes.size() - 1) : extend(tree);
    if (!added) continue;
    const std::optional<std::size_t> met =
        root ? reach(forward_, backward_.nodes[*added].at) : reach(other, tree.nodes[*added].at);
    if (!met) continue;
    const bool metForward = root || !fromStart;
    const std::size_t first = metForward ? *met : *added;
    const std::size_t last = metForward ? *added : *met;
    goal_ = backward_.nodes[last].goal;
    return path(first, last);
  }
  return {};
}

}  // namespace swept::detail
