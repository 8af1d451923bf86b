// SPDX-License-Identifier: BSD-3-Clause
#include "drawer.hpp"

#include <algorithm>
#include <cmath>

namespace soak {

namespace {

constexpr double kRoom = 1.0;  // m, for what nothing bounds: the bodies are in there
constexpr int kHalvings = 14;  // rad or m become some 1e-4

}  // namespace

Drawer::Drawer(const swept::Checker& checker, std::uint64_t seed) : random_(seed) {
  const swept::Robot& robot = checker.robot();
  for (const int i : checker.group().variables) {
    const swept::Variable& variable = robot.variables()[i];
    const bool limited = std::isfinite(variable.lower) && std::isfinite(variable.upper);
    const double bound = variable.cyclic ? M_PI : kRoom;
    limited_.push_back(limited);
    if (variable.name.ends_with("/rot_x")) orientations_.push_back(static_cast<int>(lower_.size()));
    lower_.push_back(limited ? variable.lower : -bound);
    upper_.push_back(limited ? variable.upper : bound);
  }
  scratch_.resize(lower_.size());
  open_ = shut_ = scratch_;
  for (Recent* recent : {&free_, &blocked_, &touching_}) {
    for (State& q : recent->states) {
      q.resize(lower_.size());
      anywhere(q);
    }
  }
}

double Drawer::uniform(double lower, double upper) {
  return lower + (upper - lower) * static_cast<double>(random_() >> 11) * 0x1p-53;
}

void Drawer::normalise(std::span<double> q) const {
  for (const int i : orientations_) {
    double squared = 0;
    for (int k = 0; k < 4; ++k) squared += q[i + k] * q[i + k];
    if (squared < 1e-6) q[i + 3] = squared = 1.0;
    for (int k = 0; k < 4; ++k) q[i + k] /= std::sqrt(squared);
  }
}

void Drawer::anywhere(std::span<double> q) {
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = uniform(lower_[i], upper_[i]);
  normalise(q);
}

void Drawer::someAtLimits(std::span<double> q) {
  for (std::size_t i = 0; i < q.size(); ++i)
    if (limited_[i] && oneIn(3)) q[i] = oneIn(2) ? lower_[i] : upper_[i];
}

void Drawer::recall(const Recent& recent, std::span<double> q) {
  std::ranges::copy(recent.states[random_() % recent.states.size()], q.begin());
}

void Drawer::step(std::span<const double> from, double length, std::span<double> to) {
  double squared = 0;
  for (double& d : scratch_) {
    d = uniform(-1, 1);
    squared += d * d;
  }
  const double factor = length / std::sqrt(std::max(squared, 1e-6));
  for (std::size_t i = 0; i < to.size(); ++i)
    to[i] = std::clamp(from[i] + factor * scratch_[i], lower_[i], upper_[i]);
  normalise(to);
}

void Drawer::between(const State& a, const State& b, std::span<double> q) const {
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = (a[i] + b[i]) / 2;
  normalise(q);
}

void Drawer::bisect(std::span<double> q) {
  if (halvings_ == 0) {
    recall(free_, open_);
    recall(blocked_, shut_);
    halvings_ = kHalvings;
  }
  between(open_, shut_, q);
  pending_ = true;
}

void Drawer::learn(std::span<const double> q, swept::Verdict verdict) {
  const bool free = verdict == swept::Verdict::Free;
  if (oneIn(4)) (free ? free_ : blocked_).add(q);
  if (!pending_) return;
  // Only the answer about the middle that bisect() gave out tells anything about the way.
  between(open_, shut_, scratch_);
  if (!std::ranges::equal(scratch_, q)) return;
  pending_ = false;
  std::ranges::copy(q, (free ? open_ : shut_).begin());
  if (--halvings_ == 0) touching_.add(q);
}

void Drawer::state(std::span<double> q) {
  switch (random_() % 8) {
    case 0:
    case 1:
      return anywhere(q);
    case 2:
      anywhere(q);
      return someAtLimits(q);
    case 3:
    case 4:
      recall(oneIn(2) ? free_ : blocked_, q);
      return step(q, uniform(0, 0.3), q);
    case 5:
      break;
    default:
      if (!pending_) return bisect(q);
  }
  recall(touching_, q);
  step(q, 0.1 * std::pow(10.0, -uniform(0, 6)), q);
}

void Drawer::motion(std::span<double> from, std::span<double> to) {
  const auto kind = random_() % 16;
  if (kind < 8) {
    recall(free_, from);
    return step(from, uniform(0.02, 0.4), to);
  }
  recall(kind < 12 ? touching_ : free_, from);
  if (kind < 10) return step(from, 0.3 * std::pow(10.0, -uniform(0, 5)), to);
  if (kind < 12) return recall(touching_, to);
  if (kind < 14) return recall(free_, to);
  anywhere(to);
  if (kind == 14) someAtLimits(to);
}

}  // namespace soak
