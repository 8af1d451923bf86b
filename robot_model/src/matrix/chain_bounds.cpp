// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/chain_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swept::detail {

namespace {

using Eigen::Vector3d;

constexpr double kOutward = 1.0 + 1e-9;

}  // namespace

ChainBounds::ChainBounds(const LinkChain& chain) : chain_(chain) {
  const std::size_t count = chain.joints().size();
  for (auto* values : {&half_, &chord_, &reachA_, &reachB_, &free_, &costA_, &costB_})
    values->assign(count, 0.0);
  totalA_.assign(count + 1, 0.0);
  totalB_.assign(count + 1, 0.0);
  shares_.assign(chain.variables().size(), 0.0);
}

void ChainBounds::setBox(const JointBox& box, const LinkChain::Place& place) {
  place_ = &place;
  for (std::size_t j = 0; j < half_.size(); ++j) {
    const ChainJoint& joint = chain_.joints()[j];
    half_[j] = joint.scale * box.half(joint.variable) * kOutward;
    chord_[j] = joint.slides ? half_[j] : std::min(half_[j], 2.0);
  }
}

void ChainBounds::findReaches(const Ball& a, const Ball& b) {
  const std::size_t count = half_.size();
  const auto reach = [&](std::size_t j, const Ball& ball, double moved) {
    if (chain_.joints()[j].slides) return 1.0;
    const LinkChain::Place::Axis& axis = place_->axes[j];
    return axis.direction.cross(ball.center - axis.point).norm() + moved + ball.radius;
  };
  double moved = 0.0;
  for (std::size_t j = 0; j < count; ++j) {
    reachA_[j] = reach(j, a, moved);
    moved += chord_[j] * reachA_[j];
  }
  moved = 0.0;
  for (std::size_t j = count; j-- > 0;) {
    reachB_[j] = reach(j, b, moved);
    moved += chord_[j] * reachB_[j];
  }
  for (std::size_t j = 0; j < count; ++j) free_[j] = chord_[j] * std::min(reachA_[j], reachB_[j]);
}

double ChainBounds::approach(const Ball& a, const Ball& b) {
  findReaches(a, b);
  std::ranges::fill(shares_, 0.0);
  double total = 0.0;
  for (std::size_t j = 0; j < free_.size(); ++j) {
    shares_[chain_.joints()[j].variable] += free_[j];
    total += free_[j];
  }
  return total * kOutward;
}

void ChainBounds::sum(const Vector3d& n, const Ball& ball, bool fromA) {
  const std::size_t count = half_.size();
  const std::vector<double>& reach = fromA ? reachA_ : reachB_;
  std::vector<double>& cost = fromA ? costA_ : costB_;
  std::vector<double>& total = fromA ? totalA_ : totalB_;
  double distal = 0.0;  // sum of e_k r_k over D so far
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = fromA ? i : count - 1 - i;
    const LinkChain::Place::Axis& axis = place_->axes[j];
    double directed;
    if (chain_.joints()[j].slides) {
      directed = half_[j] * std::abs(n.dot(axis.direction));
    } else {
      const double slope = std::abs(n.dot(axis.direction.cross(ball.center - axis.point))) +
                           n.cross(axis.direction).norm() * ball.radius;
      directed = half_[j] * (slope + 0.5 * half_[j] * reach[j] + distal);
    }
    if (directed < free_[j]) distal += half_[j] * reach[j];
    cost[j] = std::min(directed, free_[j]);
    sum += cost[j];
    total[i + 1] = sum;
  }
}

double ChainBounds::approachAlong(const Vector3d& n, const Ball& a, const Ball& b) {
  findReaches(a, b);
  sum(n, a, true);
  sum(n, b, false);
  const std::size_t count = half_.size();
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s <= count; ++s) {
    const double total = totalA_[s] + totalB_[count - s];
    if (!(total < least)) continue;
    least = total;
    best = s;
  }
  std::ranges::fill(shares_, 0.0);
  for (std::size_t j = 0; j < count; ++j)
    shares_[chain_.joints()[j].variable] += j < best ? costA_[j] : costB_[j];
  return least * kOutward;
}

}  // namespace swept::detail
