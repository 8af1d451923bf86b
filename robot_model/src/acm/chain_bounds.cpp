// SPDX-License-Identifier: BSD-3-Clause
#include "acm/chain_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Number of additions that take as long as the effect of one joint on two balls: in any direction;
/// in one.
constexpr std::int64_t kReachWork = 10;
constexpr std::int64_t kEffectWork = 20;

}  // namespace

ChainBounds::ChainBounds(const LinkChain& chain) : chain_(chain) {
  const std::size_t count = chain.joints().size();
  for (auto* values : {&half_, &chord_, &tilt_, &cost_, &bestCost_}) values->assign(count, 0.0);
  effectA_.resize(count);
  effectB_.resize(count);
  shares_.assign(chain.variables().size(), 0.0);
}

void ChainBounds::setBox(const JointBox& box, const LinkChain::Place& place) {
  place_ = &place;
  for (std::size_t j = 0; j < half_.size(); ++j) {
    const ChainJoint& joint = chain_.joints()[j];
    half_[j] = joint.scale * box.half(joint.variable) * kChainOutward;
    chord_[j] = joint.slides ? half_[j] : std::min(half_[j], 2.0);
  }
}

double ChainBounds::reach(std::size_t j, const Ball& ball) const {
  if (chain_.joints()[j].slides) return 1.0;
  const LinkChain::Place::Axis& axis = place_->axes[j];
  return axis.direction.cross(ball.center - axis.point).norm() + ball.radius;
}

double ChainBounds::approach(const Ball& a, const Ball& b) {
  // All joints after C; then C moves from one end to the other.
  const std::size_t count = half_.size();
  double total = 0.0;
  for (std::size_t j = 0; j < count; ++j) {
    effectA_[j].any = chord_[j] * reach(j, a);
    effectB_[j].any = chord_[j] * reach(j, b);
    total += effectB_[j].any;
  }
  work_ += kReachWork * static_cast<std::int64_t>(count);
  double least = total;
  std::size_t best = 0;
  for (std::size_t before = 1; before <= count; ++before) {
    total = 0.0;
    std::size_t j = 0;
    for (; j < count && total < least; ++j) total += j < before ? effectA_[j].any : effectB_[j].any;
    work_ += static_cast<std::int64_t>(j);
    if (!(total < least)) continue;
    least = total;
    best = before;
  }
  std::ranges::fill(shares_, 0.0);
  for (std::size_t j = 0; j < count; ++j)
    shares_[chain_.joints()[j].variable] += j < best ? effectA_[j].any : effectB_[j].any;
  return least * kChainOutward;
}

ChainBounds::Effect ChainBounds::effect(std::size_t j, const Vector3d& n, const Ball& ball,
                                        double sign) const {
  const Vector3d& w = place_->axes[j].direction;
  if (chain_.joints()[j].slides) return {half_[j], half_[j] * std::abs(n.dot(w))};
  const Vector3d arm = ball.center - place_->axes[j].point;
  const Vector3d turned = w.cross(arm);
  const double across = n.cross(w).norm() * ball.radius;
  const double slope = std::abs(n.dot(turned)) + across;
  const double along = std::max(0.0, sign * (n.dot(arm) - n.dot(w) * w.dot(arm)) + across);
  return {chord_[j] * (turned.norm() + ball.radius),
          std::min(half_[j], 1.0) * slope + std::min(0.5 * half_[j] * half_[j], 2.0) * along};
}

double ChainBounds::sum(std::size_t before, double most) {
  const std::size_t count = half_.size();
  double total = 0.0, tilt = 0.0;  // f_j
  const auto add = [&](std::size_t j, const Effect& effect) {
    cost_[j] = std::min(effect.directed + std::min(tilt, 2.0) * effect.any, effect.any);
    total += cost_[j];
    tilt += tilt_[j];
    ++work_;
  };
  for (std::size_t j = before; j-- > 0 && total < most;) add(j, effectA_[j]);
  tilt = 0.0;
  for (std::size_t j = before; j < count && total < most; ++j) add(j, effectB_[j]);
  return total;
}

double ChainBounds::approachAlong(const Vector3d& n, const Ball& a, const Ball& b) {
  const std::size_t count = half_.size();
  for (std::size_t j = 0; j < count; ++j) {
    tilt_[j] =
        chain_.joints()[j].slides ? 0.0 : chord_[j] * n.cross(place_->axes[j].direction).norm();
    effectA_[j] = effect(j, n, a, -1.0);
    effectB_[j] = effect(j, n, b, 1.0);
  }
  work_ += kEffectWork * static_cast<std::int64_t>(count);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t before = 0; before <= count; ++before) {
    const double total = sum(before, least);
    if (!(total < least)) continue;
    least = total;
    bestCost_ = cost_;
  }
  std::ranges::fill(shares_, 0.0);
  for (std::size_t j = 0; j < count; ++j) shares_[chain_.joints()[j].variable] += bestCost_[j];
  return least * kChainOutward;
}

}  // namespace swept::detail
