// SPDX-License-Identifier: BSD-3-Clause
#include "cover/sphere_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "cover/rounded.hpp"
#include "cover/set_cover.hpp"
#include "cover/stopping.hpp"
#include "geometry/single_precision.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostPlaces = 900;
constexpr int kMostSpherePieces = 8000;
/// Relative to the size of the body: a smaller gain in reach is none.
constexpr double kLeastGain = 1e-5;

double largestReach(const auto& balls) {
  double most = -std::numeric_limits<double>::infinity();
  for (const auto& ball : balls) most = std::max(most, ball.reach());
  return most;
}

/// What decides between equal largest reaches: the volume that the spheres add near their surface.
double addedVolume(const auto& balls) {
  double sum = 0.0;
  for (const auto& ball : balls) sum += ball.radius * ball.radius * std::max(ball.reach(), 0.0);
  return sum;
}

bool isBetter(const auto& balls, const auto& than, double gain) {
  const double now = largestReach(balls);
  const double before = largestReach(than);
  if (now < before - gain) return true;
  return now < before + gain && addedVolume(balls) < (1.0 - 1e-4) * addedVolume(than);
}

}  // namespace

SphereFit::SphereFit(std::span<const PosedShape> body, const EnclosingSpheresOptions& options,
                     const StopQuestion& stop)
    : options_(options), stop_(stop), body_(body) {
  divide(options.pieces, std::numeric_limits<double>::infinity());
  findPlaces();
}

/// The largest piece first; those without surface, which large balls contain, count half.
void SphereFit::divide(int count, double largest) {
  const auto sizeOf = [](const BodyPiece& piece) {
    return (piece.cell.isSolid() ? 0.5 : 1.0) * piece.reach;
  };
  const auto less = [&](const BodyPiece& a, const BodyPiece& b) { return sizeOf(a) < sizeOf(b); };
  if (pieces_.empty()) {
    pieces_ = body_.pieces();
    for (const BodyPiece& piece : pieces_)
      size_ = std::max(size_, piece.reach + (piece.middle - pieces_.front().middle).norm());
  }
  std::ranges::make_heap(pieces_, less);
  std::vector<BodyPiece> halves;
  std::vector<BodyPiece> whole;
  while (!pieces_.empty() && static_cast<int>(pieces_.size() + whole.size()) < kMostSpherePieces) {
    const bool enough = static_cast<int>(pieces_.size() + whole.size()) >= count;
    if (enough && sizeOf(pieces_.front()) <= largest) break;
    throwIfStopped(stop_);
    std::ranges::pop_heap(pieces_, less);
    BodyPiece top = std::move(pieces_.back());
    pieces_.pop_back();
    // A ball is one piece.
    if (!body_.canSplit(top) || top.reach < 1e-3 * size_ || top.reach <= 1.001 * top.blur) {
      whole.push_back(std::move(top));
      continue;
    }
    halves.clear();
    body_.split(top, halves);
    for (BodyPiece& half : halves) {
      pieces_.push_back(std::move(half));
      std::ranges::push_heap(pieces_, less);
    }
  }
  std::ranges::move(whole, std::back_inserter(pieces_));
}

void SphereFit::addPlace(const Place& place) {
  throwIfStopped(stop_);
  std::vector<float> needs;
  needs.reserve(pieces_.size());
  for (const BodyPiece& piece : pieces_)
    needs.push_back(static_cast<float>(piece.farthest(place.center) - place.depth));
  places_.push_back(place);
  needs_.push_back(std::move(needs));
}

/// Centres of inscribed balls that touch the surface in a piece, and middles of pieces.
void SphereFit::findPlaces() {
  places_.clear();
  needs_.clear();
  std::vector<Place> found;
  std::vector<Contacts> contacts(body_.shapeCount());
  for (const BodyPiece& piece : pieces_) {
    throwIfStopped(stop_);
    if (piece.cell.isSolid() || piece.cell.patches.front().triangle < 0) continue;
    Vector3d foot = Vector3d::Zero();
    const Cell::Patch& patch = piece.cell.patches.front();
    for (int i = 0; i < patch.count; ++i) foot += piece.cell.corners[i] / patch.count;
    const auto ball =
        body_.solid(piece.shape).inscribed(foot, patch.triangle, size_, contacts[piece.shape]);
    if (ball) found.push_back(placeAt(body_.pose(piece.shape) * ball->center));
  }
  const auto thinOut = [](std::size_t count, std::size_t most) { return count / most + 1; };
  const std::size_t eachFound = thinOut(found.size(), 2 * kMostPlaces / 3);
  for (std::size_t i = 0; i < found.size(); i += eachFound) addPlace(found[i]);
  const std::size_t eachPiece = thinOut(pieces_.size(), kMostPlaces / 3);
  for (std::size_t i = 0; i < pieces_.size(); i += eachPiece) addPlace(placeAt(pieces_[i].middle));
  Vector3d middle = Vector3d::Zero();
  for (const BodyPiece& piece : pieces_)
    middle += piece.middle / static_cast<double>(pieces_.size());
  addPlace(placeAt(middle));
}

/// `noise`: relative, of the reach that each place is given.
SphereFit::Balls SphereFit::greedy(double reach, double noise, std::mt19937& random) const {
  std::uniform_real_distribution<double> uniform(1.0 - noise, 1.0);
  std::vector<std::vector<int>> sets(places_.size());
  std::vector<bool> covered(pieces_.size(), false);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    throwIfStopped(stop_);
    const auto most = static_cast<float>(noise > 0.0 ? reach * uniform(random) : reach);
    for (std::size_t j = 0; j < pieces_.size(); ++j)
      if (needs_[i][j] <= most) {
        sets[i].push_back(static_cast<int>(j));
        covered[j] = true;
      }
  }
  Balls chosen;
  for (const int i : greedyCover(static_cast<int>(pieces_.size()), sets))
    chosen.push_back({places_[static_cast<std::size_t>(i)]});
  for (std::size_t j = 0; j < pieces_.size(); ++j) {
    if (covered[j]) continue;
    const auto isIn = [&](const Ball& ball) {
      return pieces_[j].farthest(ball.place.center) - ball.place.depth <= reach;
    };
    if (std::ranges::none_of(chosen, isIn)) chosen.push_back({placeAt(pieces_[j].middle)});
  }
  return chosen;
}

int SphereFit::countFor(double reach) const {
  std::mt19937 random(options_.seed);
  return static_cast<int>(greedy(reach, 0.0, random).size());
}

/// Nearly the least for which the greedy choice has at most so many balls.
double SphereFit::reachFor(int count, double noise, std::mt19937& random) const {
  double low = 0.0;
  double high = 4.0 * size_;
  for (int step = 0; step < 12; ++step) {
    const double middle =
        step < 6 ? std::sqrt(std::max(low, 1e-3 * high) * high) : 0.5 * (low + high);
    std::mt19937 same = random;
    const auto found = static_cast<int>(greedy(middle, noise, same).size());
    (found <= count ? high : low) = middle;
  }
  return high;
}

void SphereFit::measure(Ball& ball) const {
  ball.radius = 0.0;
  for (const BodyPiece* piece : ball.pieces)
    ball.radius = std::max(ball.radius, piece->farthest(ball.place.center));
}

/// Each piece goes to the ball that reaches least for it.
SphereFit::Balls SphereFit::owned(const Balls& places) const {
  Balls balls = places;
  for (Ball& ball : balls) ball.pieces.clear();
  for (const BodyPiece& piece : pieces_) {
    Ball* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (Ball& ball : balls) {
      const auto& [center, depth] = ball.place;
      if (!((piece.middle - center).norm() - depth < least)) continue;
      const double need = piece.farthest(center) - depth;
      if (!(need < least)) continue;
      least = need;
      best = &ball;
    }
    best->pieces.push_back(&piece);
  }
  std::erase_if(balls, [](const Ball& ball) { return ball.pieces.empty(); });
  for (Ball& ball : balls) measure(ball);
  return balls;
}

/// Pattern search along the axes and away from what is farthest.
void SphereFit::recenter(Ball& ball) const {
  constexpr int kMostTries = 30;
  double step = 0.5 * std::max(ball.reach(), 0.05 * ball.radius);
  const double last = std::max(0.02 * ball.reach(), 1e-5 * size_);
  for (int tries = 0; step > last && tries < kMostTries;) {
    throwIfStopped(stop_);
    Vector3d farthest = ball.place.center;
    double most = -1.0;
    for (const BodyPiece* piece : ball.pieces)
      for (const Vector3d& point : piece->content)
        if (const double squared = (point - ball.place.center).squaredNorm(); squared > most) {
          most = squared;
          farthest = point;
        }
    std::vector<Vector3d> directions{farthest - ball.place.center};
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {1.0, -1.0}) directions.emplace_back(sign * Vector3d::Unit(axis));
    bool moved = false;
    for (const Vector3d& direction : directions) {
      if (!(direction.norm() > 0.0)) continue;
      Ball other;
      const Vector3d center = ball.place.center + step * direction.normalized();
      double radius = 0.0;
      for (const BodyPiece* piece : ball.pieces) radius = std::max(radius, piece->farthest(center));
      ++tries;
      // No depth is known yet, but none is more than a step deeper.
      if (radius - ball.place.depth - step >= ball.reach()) continue;
      const Place place = placeAt(center);
      if (!(radius - place.depth < ball.reach() - 1e-3 * last)) continue;
      ball.place = place;
      ball.radius = radius;
      moved = true;
      break;
    }
    if (!moved) step *= 0.5;
  }
}

SphereFit::Balls SphereFit::settled(const Balls& places, int steps) const {
  Balls best = owned(places);
  Balls balls = best;
  for (int step = 0; step < steps; ++step) {
    bool moved = false;
    for (Ball& ball : balls) {
      if (ball.pieces == ball.centeredFor) continue;
      recenter(ball);
      ball.centeredFor = ball.pieces;
      moved = true;
    }
    if (!moved) break;
    if (isBetter(balls, best, kLeastGain * size_)) best = balls;
    balls = owned(balls);
    if (isBetter(balls, best, kLeastGain * size_)) {
      best = balls;
    } else if (step > 2) {
      break;
    }
  }
  return best;
}

std::pair<std::size_t, double> SphereFit::leastUseful(const Balls& balls) const {
  std::pair<std::size_t, double> least{0, std::numeric_limits<double>::infinity()};
  for (std::size_t b = 0; b < balls.size(); ++b) {
    throwIfStopped(stop_);
    double most = -std::numeric_limits<double>::infinity();
    for (const BodyPiece* piece : balls[b].pieces) {
      double need = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < balls.size(); ++i) {
        const auto& [center, depth] = balls[i].place;
        if (i == b || !((piece->middle - center).norm() - depth < need)) continue;
        need = std::min(need, piece->farthest(center) - depth);
      }
      most = std::max(most, need);
      if (most >= least.second) break;
    }
    if (most < least.second) least = {b, most};
  }
  return least;
}

/// For a second ball among the pieces of one: contains its farthest piece and as many others as a
/// smaller reach allows.
SphereFit::Place SphereFit::placeFor(const Ball& ball) const {
  const BodyPiece& farthest = **std::ranges::max_element(
      ball.pieces, {}, [&](const BodyPiece* piece) { return piece->farthest(ball.place.center); });
  const double aim = ball.reach() > 0.0 ? 0.7 * ball.reach() : 1.3 * ball.reach();
  Place best = placeAt(farthest.middle);
  int most = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto reach = static_cast<float>(aim);
    const auto isIn = [&](const BodyPiece& piece) {
      return needs_[i][static_cast<std::size_t>(&piece - pieces_.data())] <= reach;
    };
    if (!isIn(farthest)) continue;
    const auto count = static_cast<int>(
        std::ranges::count_if(ball.pieces, [&](const BodyPiece* piece) { return isIn(*piece); }));
    if (count <= most) continue;
    most = count;
    best = places_[i];
  }
  return best;
}

/// The ball that others can do without goes to where the reach is largest.
void SphereFit::improve(Balls& balls, int rounds, std::mt19937& random) const {
  int failures = 0;
  for (int round = 0; round < rounds && failures < 4 && balls.size() > 1; ++round) {
    const auto worst =
        static_cast<std::size_t>(std::ranges::max_element(balls, {}, &Ball::reach) - balls.begin());
    std::size_t moved = leastUseful(balls).first;
    // After a failure another one.
    if (failures > 0)
      moved = std::uniform_int_distribution<std::size_t>(0, balls.size() - 1)(random);
    if (moved == worst) {
      ++failures;
      continue;
    }
    Balls next = balls;
    next[moved] = {placeFor(balls[worst])};
    next = settled(next, 3);
    if (isBetter(next, balls, kLeastGain * size_)) {
      balls = std::move(next);
      failures = 0;
    } else {
      ++failures;
    }
  }
}

/// From nothing: what a greedy choice gives, settled, filled up and improved, several times.
SphereFit::Balls SphereFit::searched(int count) const {
  Balls best;
  for (int restart = 0; restart < options_.restarts; ++restart) {
    std::mt19937 random(options_.seed + static_cast<std::uint32_t>(restart));
    const double noise = restart == 0 ? 0.0 : 0.3;
    const double reach = reachFor(count, noise, random);
    Balls balls = greedy(reach, noise, random);
    if (static_cast<int>(balls.size()) > count) balls.resize(static_cast<std::size_t>(count));
    balls = settled(balls, 6);
    fill(balls, count);
    improve(balls, options_.rounds, random);
    if (best.empty() || isBetter(balls, best, kLeastGain * size_)) best = std::move(balls);
  }
  return best;
}

void SphereFit::fill(Balls& balls, int count) const {
  while (static_cast<int>(balls.size()) < count) {
    const auto worst = std::ranges::max_element(balls, {}, &Ball::reach);
    if (worst->pieces.size() < 2) return;
    Balls next = balls;
    next.push_back({placeFor(*worst)});
    next = settled(next, 4);
    if (next.size() <= balls.size()) return;
    balls = std::move(next);
  }
}

/// One ball more or less than before leaves most of the others where they are.
SphereFit::Balls SphereFit::changed(Balls balls, int count) const {
  std::mt19937 random(options_.seed);
  if (static_cast<int>(balls.size()) > count) {
    balls.erase(balls.begin() + static_cast<std::ptrdiff_t>(leastUseful(balls).first));
    balls = settled(balls, 4);
  }
  fill(balls, count);
  improve(balls, options_.rounds, random);
  return balls;
}

EnclosingSpheres SphereFit::atMost(int count, const StopQuestion& stop) {
  stop_ = stop;
  auto found = found_.find(count);
  if (found == found_.end()) {
    auto near = found_.find(count - 1);
    if (near == found_.end()) near = found_.find(count + 1);
    const bool isNear = near != found_.end();
    found = found_
                .emplace(count, Found{isNear ? changed(near->second.balls, count) : searched(count),
                                      isNear})
                .first;
  } else if (found->second.isChanged) {
    found->second.isChanged = false;
    Balls anew = searched(count);
    if (isBetter(anew, found->second.balls, kLeastGain * size_))
      found->second.balls = std::move(anew);
  }
  return finished(found->second.balls);
}

EnclosingSpheres SphereFit::within(double reach, const StopQuestion& stop) {
  stop_ = stop;
  // Dividing them also puts them in another order.
  found_.clear();
  divide(options_.pieces, 0.5 * reach);
  findPlaces();
  std::mt19937 random(options_.seed);
  Balls balls = settled(greedy(reach, 0.0, random), 4);
  for (int restart = 1; restart < options_.restarts; ++restart) {
    Balls other = settled(greedy(reach, 0.2, random), 4);
    if (other.size() < balls.size() && largestReach(other) <= reach) balls = std::move(other);
  }
  // Few places may be left out where pieces are as large as the reach.
  while (largestReach(balls) > reach) {
    Balls more = balls;
    more.push_back({placeFor(*std::ranges::max_element(balls, {}, &Ball::reach))});
    more = settled(more, 3);
    if (!(largestReach(more) < largestReach(balls))) break;
    balls = std::move(more);
  }
  const double allowed = std::max(reach, largestReach(balls));
  while (balls.size() > 1) {
    Balls next = balls;
    next.erase(next.begin() + static_cast<std::ptrdiff_t>(leastUseful(balls).first));
    next = settled(next, 3);
    if (largestReach(next) > allowed) break;
    balls = std::move(next);
  }
  return finished(std::move(balls));
}

/// Pieces that two balls share are divided: the one that reaches farther keeps only what the other
/// does not contain. Then the centres are rounded to single precision.
EnclosingSpheres SphereFit::finished(Balls balls) {
  constexpr int kPasses = 2;
  std::deque<BodyPiece> divided;
  for (int pass = 0; pass < kPasses; ++pass) {
    std::ranges::stable_sort(balls, std::ranges::greater{}, &Ball::reach);
    for (Ball& ball : balls) shrink(ball, balls, divided);
    std::erase_if(balls, [](const Ball& ball) { return ball.pieces.empty(); });
  }
  EnclosingSpheres found;
  found.reach = -std::numeric_limits<double>::infinity();
  for (Ball& ball : balls) {
    ball.place = placeAt(ball.place.center.unaryExpr(&inSinglePrecision));
    measure(ball);
    ball.radius = roundedUp(ball.radius);
    found.spheres.push_back({ball.place.center, ball.radius});
    found.reach = std::max(found.reach, ball.reach());
  }
  return found;
}

/// Only pieces near the ball's surface matter.
void SphereFit::shrink(Ball& ball, Balls& balls, std::deque<BodyPiece>& divided) {
  constexpr double kNearSurface = 0.9;
  const double least = std::max(0.1 * ball.reach(), 2e-3 * size_);
  std::vector<const BodyPiece*> pending = std::move(ball.pieces);
  std::vector<const BodyPiece*> kept;
  std::vector<BodyPiece> halves;
  while (!pending.empty()) {
    throwIfStopped(stop_);
    const BodyPiece& piece = *pending.back();
    pending.pop_back();
    const auto contains = [&](const Ball& other) {
      return &other != &ball && piece.farthest(other.place.center) <= other.radius;
    };
    const auto touches = [&](const Ball& other) {
      return &other != &ball &&
             (piece.middle - other.place.center).norm() < other.radius + 0.5 * piece.reach;
    };
    if (const auto other = std::ranges::find_if(balls, contains); other != balls.end()) {
      other->pieces.push_back(&piece);
    } else if (piece.reach > least && body_.canSplit(piece) &&
               piece.farthest(ball.place.center) > kNearSurface * ball.radius &&
               std::ranges::any_of(balls, touches)) {
      halves.clear();
      body_.split(piece, halves);
      for (BodyPiece& half : halves) {
        divided.push_back(std::move(half));
        pending.push_back(&divided.back());
      }
    } else {
      kept.push_back(&piece);
    }
  }
  ball.pieces = std::move(kept);
  measure(ball);
  if (!ball.pieces.empty()) recenter(ball);
}

}  // namespace swept::detail
