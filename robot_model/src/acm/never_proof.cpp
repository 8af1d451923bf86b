// SPDX-License-Identifier: BSD-3-Clause
#include "acm/never_proof.hpp"

#include <algorithm>
#include <cmath>

#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

/// Effort of one distance on exact geometry.
constexpr std::int64_t kExactEffort = 100;
/// Effort of one plane between hulls.
constexpr std::int64_t kPlaneEffort = 20;

/// Number of additions (see ChainBounds::work()) that take as long as one unit of effort without
/// the bounds; and as placing a joint.
constexpr std::int64_t kEffortWork = 20;
constexpr std::int64_t kMoveWork = 60;

/// Balls are replaced by their children while their radius is more than this times the approach:
/// for larger approaches, halving the box gains more.
constexpr double kRefineAt = 4.0;

/// m. A box in which open pairs approach by less is not halved any more.
constexpr double kFinestApproach = 1e-6;

}  // namespace

NeverProof::NeverProof(const LinkPieces& a, const LinkPieces& b, const LinkChain& chain,
                       double margin, LinkChain::Place& place)
    : a_(a),
      b_(b),
      chain_(chain),
      margin_(margin),
      place_(place),
      bounds_(chain),
      nearestDistance_(std::numeric_limits<double>::infinity()) {
  double largest = 1.0;  // largest of the joints' values, which have their own rounding
  for (const ChainJoint& joint : chain.joints()) {
    const double value = std::max(std::abs(chain.box().lower[joint.variable]),
                                  std::abs(chain.box().upper[joint.variable]));
    largest = std::max(largest, joint.scale * value);
  }
  const double joints = static_cast<double>(chain.joints().size() + 2);
  required_ =
      margin_ + a.sourceError + b.sourceError +
      tolerance::kRoundingPerJoint * largest * joints * (2.0 * chain.reach() + a.reach + b.reach);
  for (const LinkPieces::Piece& first : a.pieces)
    for (const LinkPieces::Piece& second : b.pieces) arena_.push_back({first.root, second.root});
  middle_.resize(chain.variables().size());
  boxes_.push_back({chain.box(), 0, arena_.size(), 1.0});
}

ChainBounds::Ball NeverProof::ballA(int i, double radius) const {
  return {place_.base_from_a * a_.balls[i].center, radius};
}
ChainBounds::Ball NeverProof::ballB(int i, double radius) const {
  return {place_.base_from_b * b_.balls[i].center, radius};
}

std::int64_t NeverProof::work() const {
  return bounds_.work() + kEffortWork * effort_ + kMoveWork * moves_;
}

/// For one unit of effort, the bounds take up to twice the square of the number of joints, and a
/// box has at least one.
std::int64_t NeverProof::usualWork(std::int64_t budget, std::size_t joints) {
  const auto count = static_cast<std::int64_t>(joints) + 10;
  return 4 * budget * count * count;
}

NeverProof::State NeverProof::run(std::int64_t budget, std::int64_t mostWork) {
  mostWork_ = mostWork;
  while (!boxes_.empty() && !contact_ && effort_ < budget && !outOfWork()) {
    const Box box = std::move(boxes_.back());
    boxes_.pop_back();
    look(box);
  }
  if (contact_) return State::Contact;
  if (!boxes_.empty() || outOfWork()) return State::Open;
  return stuck_ ? State::Stuck : State::Proven;
}

void NeverProof::look(const Box& box) {
  for (std::size_t k = 0; k < middle_.size(); ++k) middle_[k] = box.values.middle(k);
  if (!chain_.moveTo(middle_, place_)) {
    stuck_ = true;
    return;
  }
  moves_ += static_cast<std::int64_t>(chain_.joints().size());
  bounds_.setBox(box.values, place_);
  collectOpen(box);
  if (contact_) return;
  if (!outOfWork() && arena_.size() > firstOpen_) dropFar();
  if (outOfWork()) {  // ended before all its pairs of balls were tested
    stuck_ = true;
    return;
  }
  if (arena_.size() == firstOpen_) {
    share_ += box.share;
  } else {
    split(box);
  }
}

void NeverProof::collectOpen(const Box& box) {
  asked_ = false;
  // Entries that later boxes had appended are no longer needed.
  arena_.resize(box.first + box.count);
  firstOpen_ = arena_.size();
  for (std::size_t i = box.first; i < firstOpen_ && !contact_ && !outOfWork(); ++i)
    refine(arena_[i]);
}

void NeverProof::refine(BallPair pair) {
  work_.assign(1, pair);
  while (!work_.empty() && !contact_ && !outOfWork()) {
    pair = work_.back();
    work_.pop_back();
    double approach = 0.0, gap = 0.0;
    if (isApart(pair, approach, gap)) continue;
    const LinkPieces::Ball& a = a_.balls[pair.a];
    const LinkPieces::Ball& b = b_.balls[pair.b];
    const bool leaves = a.childCount == 0 && b.childCount == 0;
    if (!leaves && std::max(a.radius, b.radius) > kRefineAt * approach) {
      const bool ofA = b.childCount == 0 || (a.childCount > 0 && a.radius >= b.radius);
      const LinkPieces::Ball& parent = ofA ? a : b;
      for (int i = parent.firstChild; i < parent.firstChild + parent.childCount; ++i)
        work_.push_back(ofA ? BallPair{i, pair.b} : BallPair{pair.a, i});
      continue;
    }
    arena_.push_back(pair);
    // Deep overlap has many such pairs; the first of them is enough to detect it. Leaves that are
    // just apart are no exception: around a corner of a box where they touch, halving does not
    // help.
    if (leaves && !asked_) askExact(pair);
  }
}

bool NeverProof::isApart(const BallPair& pair, double& approach, double& gap) {
  ++effort_;
  const ChainBounds::Ball a = ballA(pair.a, 0.0);
  const ChainBounds::Ball b = ballB(pair.b, 0.0);
  const Eigen::Vector3d between = b.center - a.center;
  const double distance = between.norm();
  gap = distance - a_.balls[pair.a].radius - b_.balls[pair.b].radius - required_;
  approach =
      distance > 0.0 ? bounds_.approachAlong(between / distance, a, b) : bounds_.approach(a, b);
  return gap > approach;  // false for NaN
}

void NeverProof::keepWorst(double approach, double gap) {
  if (approach - gap <= worst_.lack) return;
  worst_.lack = approach - gap;
  worst_.approach = approach;
  worst_.shares.assign(bounds_.shares().begin(), bounds_.shares().end());
}

void NeverProof::askExact(const BallPair& leaves) {
  asked_ = true;
  const double approach = bounds_.approach(ballA(leaves.a, a_.balls[leaves.a].radius),
                                           ballB(leaves.b, b_.balls[leaves.b].radius));
  const LinkDistance found = linkDistance(a_, b_, place_, required_ + 2.0 * approach, margin_);
  effort_ += kExactEffort * std::max(1, found.computed);
  exactDistance_ = found.lower;
  contact_ = found.upper <= margin_;
  if (!contact_ && !(found.lower < nearestDistance_)) return;
  nearestDistance_ = found.lower;
  nearest_ = middle_;
}

void NeverProof::dropFar() {
  worst_.lack = -std::numeric_limits<double>::infinity();
  planes_.assign(a_.pieces.size() * b_.pieces.size(), std::nullopt);
  const std::size_t end = arena_.size();
  std::size_t kept = firstOpen_;
  // Pairs are kept in place: none is written before it is read.
  for (std::size_t i = firstOpen_; i < end && !outOfWork(); ++i) {
    const BallPair pair = arena_[i];
    if (!isFar(pair)) arena_[kept++] = pair;
  }
  arena_.resize(kept);
}

bool NeverProof::isFar(const BallPair& pair) {
  ++effort_;
  const ChainBounds::Ball a = ballA(pair.a, a_.balls[pair.a].radius);
  const ChainBounds::Ball b = ballB(pair.b, b_.balls[pair.b].radius);
  const PiecePlane& plane = planeOf(pair);
  if (plane.gap > required_) {
    const double across = bounds_.approachAlong(plane.normal, a, b);
    const double gap = plane.gap - required_;
    if (gap > across) return true;
    keepWorst(across, gap);
  }
  // In any direction; if exact geometry was not used, only to choose the variable to halve.
  const double approach = bounds_.approach(a, b);
  const double gap = asked_ ? exactDistance_ - required_ : 0.0;
  if (gap > approach) return true;
  if (!(plane.gap > required_)) keepWorst(approach, gap);
  return false;
}

const PiecePlane& NeverProof::planeOf(const BallPair& pair) {
  const int first = a_.balls[pair.a].piece, second = b_.balls[pair.b].piece;
  auto& plane = planes_[static_cast<std::size_t>(first) * b_.pieces.size() +
                        static_cast<std::size_t>(second)];
  if (!plane) {
    plane = planeBetween(a_.pieces[first], b_.pieces[second], place_, required_);
    effort_ += kPlaneEffort;
  }
  return *plane;
}

void NeverProof::split(const Box& box) {
  if (worst_.shares.empty() || worst_.approach < kFinestApproach) {
    stuck_ = true;
    return;
  }
  const auto most = std::ranges::max_element(worst_.shares);
  const auto k = static_cast<std::size_t>(most - worst_.shares.begin());
  const std::size_t count = arena_.size() - firstOpen_;
  const double middle = box.values.middle(k);
  for (const bool high : {true, false}) {
    Box part{box.values, firstOpen_, count, 0.5 * box.share};
    (high ? part.values.lower : part.values.upper)[k] = middle;
    boxes_.push_back(std::move(part));
  }
}

}  // namespace swept::detail
