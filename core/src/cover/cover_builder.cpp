// SPDX-License-Identifier: BSD-3-Clause
#include "cover/cover_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cover/rounded.hpp"
#include "cover/set_cover.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

// All relative to the overhang of the level.
constexpr double kSmallestCell = 0.2;  // such a cell is in a ball around its own middle
constexpr double kDeepest = 8.0;       // deeper balls are hardly flatter at this size
constexpr double kSameCenter = 0.3;    // balls this close together, and not deeper by more than
constexpr double kSameDepth = 0.1;     // this, count as known

// A cell in a ball reduced to this part of its radius needs no ball of its own.
constexpr double kAmply = 0.9;

/// Relative to an overhang. Smaller cells need fewer balls, but more time; coarse levels have few
/// cells anyway.
double cellFactor(double relativeOverhang) {
  if (relativeOverhang > 0.2) return 0.8;
  if (relativeOverhang > 0.1) return 1.25;
  return relativeOverhang > 0.06 ? 1.75 : 3.0;
}

/// Overhangs from about a quarter of the radius down, by halves; the last step is at most a factor
/// 1.4. They start a little above a quarter, since eight balls can be enough for a cube.
std::vector<LevelAim> aimsOf(double radius, const SphereCoverOptions& options) {
  constexpr double kFirst = 0.26;
  constexpr double kLeast = 1e-3;
  const double finest =
      std::max(options.finestOverhang, std::max(options.finestRelative, kLeast) * radius);
  std::vector<double> overhangs;
  for (double delta = kFirst * radius; delta > 1.4 * finest; delta *= 0.5)
    overhangs.push_back(delta);
  overhangs.push_back(finest);
  std::vector<LevelAim> aims;
  for (const double delta : overhangs) aims.push_back({delta, cellFactor(delta / radius) * delta});
  return aims;
}

}  // namespace

CoverBuilder::CoverBuilder(const Shape& shape, const SphereCoverOptions& options)
    : options_(options), solid_(shape), cells_(solid_) {
  const BoundingSphere ball = boundingSphere(shape);
  rootRadius_ = ball.radius;
  Node root{};
  root.place = solid_.at(ball.center);
  root.radius = std::max(0.0, ball.radius - solid_.inflation());
  root.beyond = root.radius - root.place.depth;
  root.level = 0;
  root.cells.push_back(cells_.root());
  if (!root.place.inPocket) seen_.push_back(root.place);
  nodes_.push_back(std::move(root));
}

SphereCover CoverBuilder::build() {
  SphereCover cover;
  cover.levels.push_back({nodes_.front().beyond, 1, 0.0});
  for (const LevelAim& aim : aimsOf(rootRadius_, options_)) {
    if (!addLevel(static_cast<int>(cover.levels.size()), aim)) break;
    cover.levels.push_back({aim.overhang, 0, 0.0});
  }
  for (const Node& node : nodes_) cover.nodes.push_back(finished(node));
  for (std::size_t level = 0; level < cover.levels.size(); ++level) {
    SphereCover::Level& report = cover.levels[level];
    const std::vector<int> cut = cover.cut(static_cast<int>(level));
    report.ballCount = static_cast<int>(cut.size());
    for (const int node : cut) {
      report.largestOverhang =
          std::max(report.largestOverhang, static_cast<double>(cover.nodes[node].overhang));
    }
  }
  cover.inner = innerBalls();
  findInsides(cover);
  return cover;
}

bool CoverBuilder::addLevel(int level, const LevelAim& aim) {
  const std::size_t before = nodes_.size();
  for (std::size_t i = 0; i < before; ++i) {
    if (nodes_[i].childCount > 0 || nodes_[i].beyond <= aim.overhang) continue;
    std::vector<Node> children = childrenOf(nodes_[i], level, aim);
    if (children.size() == 1 && children.front().radius <= nodes_[i].radius) {
      // One better ball replaces its parent.
      children.front().level = nodes_[i].level;
      nodes_[i] = std::move(children.front());
      continue;
    }
    if (nodes_.size() + children.size() > static_cast<std::size_t>(options_.mostBalls)) {
      nodes_.resize(before);
      for (Node& node : nodes_) {
        if (node.firstChild >= static_cast<int>(before)) node.childCount = 0;
      }
      return false;
    }
    nodes_[i].firstChild = static_cast<int>(nodes_.size());
    nodes_[i].childCount = static_cast<int>(children.size());
    std::move(children.begin(), children.end(), std::back_inserter(nodes_));
  }
  return true;
}

std::vector<CoverBuilder::Node> CoverBuilder::childrenOf(Node& node, int level,
                                                         const LevelAim& aim) {
  Division division;
  for (const Candidate& place : node.pool) {
    const double radius = place.depth + aim.overhang;
    if (radius > 0.0) division.balls.push_back({place, radius});
  }
  // Balls much deeper than the node's own are rare, and take long to find.
  const double mostDepth = std::min(
      {rootRadius_, kDeepest * aim.overhang, 2.0 * std::max(node.place.depth, aim.overhang)});
  std::vector<Cell> solids = refine(std::move(node.cells), mostDepth, aim, division);
  chooseFor(division, 0);
  placeSolids(std::move(solids), aim.overhang, division);
  chooseFor(division, division.placed);

  std::vector<Node> children(division.chosen.size());
  for (std::size_t k = 0; k < children.size(); ++k) {
    children[k].place = division.balls[division.chosen[k]].place;
    children[k].radius = 0.0;
    children[k].level = level;
  }
  for (std::size_t j = 0; j < division.cells.size(); ++j) {
    Node& child = children[division.owner[j]];
    child.radius = std::max(child.radius, division.cells[j].farthest(child.place.center));
    child.cells.push_back(std::move(division.cells[j]));
  }
  std::vector<int> lastGiven(children.size(), -1);
  for (std::size_t i = 0; i < division.balls.size(); ++i) {
    for (const int k : division.usefulTo[i]) {
      if (std::exchange(lastGiven[k], static_cast<int>(i)) == static_cast<int>(i)) continue;
      children[k].pool.push_back(division.balls[i].place);
    }
  }
  for (Node& child : children) child.beyond = child.radius - child.place.depth;
  node.cells.clear();
  node.pool.clear();
  return children;
}

/// Divides the node's cells with surface until each is small enough for this level and in one of
/// the balls, and finds these balls. Returns the solid cells.
std::vector<Cell> CoverBuilder::refine(std::vector<Cell> pending, double mostDepth,
                                       const LevelAim& aim, Division& division) {
  std::vector<Cell> solids;
  const auto known = static_cast<std::ptrdiff_t>(division.balls.size());
  // Without depth each cell gets its own ball: the larger the better.
  const double largest = solid_.hasDepth() ? aim.largestCell : 2.0 * aim.overhang;
  while (!pending.empty()) {
    Cell cell = std::move(pending.back());
    pending.pop_back();
    if (cell.isSolid()) {
      solids.push_back(std::move(cell));
      continue;
    }
    const bool divisible = cells_.canSplit(cell);
    if (divisible && cell.size() > largest) {
      cells_.split(cell, pending);
      continue;
    }
    if (cell.content.empty()) cells_.gather(cell);
    const bool amply = std::any_of(
        division.balls.begin(), division.balls.begin() + known,
        [&](const Ball& ball) { return cell.isIn(ball.place.center, kAmply * ball.radius); });
    if (!amply) suggest(cell, mostDepth, aim.overhang, division.balls);
    if (amply || isCovered(cell, aim.overhang, divisible, division.balls)) {
      division.cells.push_back(std::move(cell));
    } else {
      cells_.split(cell, pending);
    }
  }
  return solids;
}

/// Chooses balls for the cells from `first` on.
void CoverBuilder::chooseFor(Division& division, std::size_t first) {
  std::vector<std::vector<int>> sets(division.balls.size());
  const std::size_t count = division.cells.size() - first;
  if (count == 0) return;
  // Most cells are clearly in a ball or clearly not; these are tested in one pass.
  struct Ends {
    Vector3d middle;
    double reach;
  };
  std::vector<Ends> ends;
  for (std::size_t j = 0; j < count; ++j) {
    ends.push_back({division.cells[first + j].middle, division.cells[first + j].reach});
  }
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const Ball& ball = division.balls[i];
    for (std::size_t j = 0; j < count; ++j) {
      const double outer = ball.radius + ends[j].reach;
      if (!((ends[j].middle - ball.place.center).squaredNorm() <= outer * outer)) continue;
      if (division.cells[first + j].isIn(ball.place.center, ball.radius)) {
        sets[i].push_back(static_cast<int>(j));
      }
    }
  }
  division.owner.resize(division.cells.size(), -1);
  for (const int index : greedyCover(static_cast<int>(count), sets)) {
    const auto k = static_cast<int>(division.chosen.size());
    division.chosen.push_back(index);
    for (const int j : sets[index]) {
      int& owner = division.owner[first + static_cast<std::size_t>(j)];
      if (owner < 0) owner = k;
    }
  }
  division.usefulTo.resize(division.balls.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const int j : sets[i]) {
      division.usefulTo[i].push_back(division.owner[first + static_cast<std::size_t>(j)]);
    }
  }
}

/// The balls chosen for the surface contain most of the inside. Cells go to a ball that contains
/// them, and are halved while several balls seem to share them. The rest, deep inside, waits for
/// its own choice.
void CoverBuilder::placeSolids(std::vector<Cell> pending, double delta, Division& division) {
  std::vector<Cell> left;
  const auto reachesMiddle = [&](const Cell& cell) {
    return std::any_of(division.chosen.begin(), division.chosen.end(), [&](int index) {
      const Ball& ball = division.balls[index];
      return (cell.middle - ball.place.center).squaredNorm() < ball.radius * ball.radius;
    });
  };
  while (!pending.empty()) {
    Cell cell = std::move(pending.back());
    pending.pop_back();
    if (cell.content.empty()) cells_.gather(cell);
    const auto owner = std::find_if(division.chosen.begin(), division.chosen.end(), [&](int index) {
      const Ball& ball = division.balls[index];
      return cell.isIn(ball.place.center, ball.radius);
    });
    const bool divisible = cells_.canSplit(cell);
    if (owner != division.chosen.end()) {
      division.owner.push_back(static_cast<int>(owner - division.chosen.begin()));
      division.cells.push_back(std::move(cell));
    } else if (divisible && cell.size() > delta && reachesMiddle(cell)) {
      cells_.split(cell, pending);
    } else if (isCovered(cell, delta, divisible, division.balls)) {
      left.push_back(std::move(cell));
    } else {
      cells_.split(cell, pending);
    }
  }
  division.placed = division.cells.size();
  std::move(left.begin(), left.end(), std::back_inserter(division.cells));
}

/// Adds an inscribed ball that touches the surface in the cell.
void CoverBuilder::suggest(const Cell& cell, double mostDepth, double delta,
                           std::vector<Ball>& balls) {
  Vector3d foot = Vector3d::Zero();
  int triangle = -1;
  double nearest = std::numeric_limits<double>::infinity();
  const Vector3d* corner = cell.corners.data();
  for (const Cell::Patch& patch : cell.patches) {
    Vector3d middle = Vector3d::Zero();
    for (int i = 0; i < patch.count; ++i) middle += corner[i] / patch.count;
    corner += patch.count;
    const double squared = (middle - cell.middle).squaredNorm();
    if (!(squared < nearest)) continue;
    nearest = squared;
    foot = middle;
    triangle = patch.triangle;
  }
  if (triangle < 0) return;
  const auto place = solid_.inscribed(foot, triangle, mostDepth, contacts_);
  if (!place) return;
  if (!place->inPocket) seen_.push_back(*place);
  const double closeSquared = kSameCenter * kSameCenter * delta * delta;
  const bool known = std::any_of(balls.begin(), balls.end(), [&](const Ball& ball) {
    return (ball.place.center - place->center).squaredNorm() < closeSquared &&
           ball.place.depth > place->depth - kSameDepth * delta;
  });
  if (!known) balls.push_back({*place, place->depth + delta});
}

/// Whether one of the balls contains the cell, or a ball around the cell's middle, which is then
/// added. Always true if the cell is too small to be halved.
bool CoverBuilder::isCovered(const Cell& cell, double delta, bool divisible,
                             std::vector<Ball>& balls) {
  const auto contains = [&cell](const Ball& ball) {
    return cell.isIn(ball.place.center, ball.radius);
  };
  if (std::any_of(balls.rbegin(), balls.rend(), contains)) return true;
  const Candidate own =
      cell.isSolid() ? solid_.inside(cell.middle) : solid_.at(cell.middle, cell.nearest());
  const bool good = cell.isIn(own.center, own.depth + delta);
  if (!good && divisible && cell.size() >= kSmallestCell * delta) return false;
  balls.push_back({own, good ? own.depth + delta : cell.reach * (1.0 + 1e-12)});
  if (!own.inPocket) seen_.push_back(own);
  return true;
}

SphereCover::Node CoverBuilder::finished(const Node& node) const {
  SphereCover::Node out{};
  out.ball.center = node.place.center.cast<float>();
  const double moved = (out.ball.center.cast<double>() - node.place.center).norm();
  out.ball.radius = roundedUp(node.radius + solid_.inflation() + solid_.pad() + moved);
  const double radius = out.ball.radius - solid_.inflation() + moved;
  out.beyond = roundedUp(std::max(0.0, radius - node.place.depth));
  out.overhang = roundedUp(std::max(0.0, solid_.overhang(node.place, radius)));
  out.inside = -1.0F;
  out.level = node.level;
  out.firstChild = node.firstChild;
  out.childCount = node.childCount;
  return out;
}

/// The known depth of the centre, or what an inner ball leaves around it. Depths that the search
/// for inscribed balls cut short are measured if the ball is for more than one leaf.
void CoverBuilder::findInsides(SphereCover& cover) const {
  for (std::size_t i = 0; i < cover.nodes.size(); ++i) {
    SphereCover::Node& node = cover.nodes[i];
    const Vector3d center = node.ball.center.cast<double>();
    const Candidate& place = nodes_[i].place;
    double depth = place.inPocket ? solid_.depth(place.center) : place.depth;
    if (!place.inPocket && depth > 0.0 && node.childCount > 0) {
      depth = std::max(depth, solid_.inside(place.center).depth);
    }
    depth += solid_.inflation() - solid_.pad() - (center - place.center).norm();
    for (const CoverBall& ball : cover.inner) {
      const double apart = (center - ball.center.cast<double>()).norm();
      depth = std::max(depth, ball.radius - apart * (1.0 + 1e-12));
    }
    if (depth > 0.0) node.inside = roundedDown(depth);
  }
}

/// The deepest balls, each reaching beyond those before by at least half its radius.
std::vector<CoverBall> CoverBuilder::innerBalls() const {
  constexpr float kBeyond = 0.5F;     // of the radius
  constexpr double kSmallest = 0.05;  // of the largest
  std::vector<int> order(seen_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(),
                   [this](int a, int b) { return seen_[a].depth > seen_[b].depth; });
  std::vector<CoverBall> balls;
  for (const int index : order) {
    if (static_cast<int>(balls.size()) >= options_.mostInnerBalls) break;
    const Candidate& place = seen_[index];
    const Eigen::Vector3f center = place.center.cast<float>();
    const double moved = (center.cast<double>() - place.center).norm();
    const float radius = roundedDown(place.depth + solid_.inflation() - solid_.pad() - moved);
    if (!(radius > 0.0F) || (!balls.empty() && radius < kSmallest * balls.front().radius)) break;
    const bool apart = std::all_of(balls.begin(), balls.end(), [&](const CoverBall& ball) {
      return (ball.center - center).norm() + radius >= ball.radius + kBeyond * radius;
    });
    if (apart) balls.push_back({center, radius});
  }
  return balls;
}

}  // namespace swept::detail
