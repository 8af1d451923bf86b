// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "point_cloud/event_integral.hpp"

namespace swept::detail {

/// Two points, one of either cloud, that may meet.
struct NoisyPair {
  std::size_t a;
  std::size_t b;
  ProbabilityRange range;
};

/// Pairs in groups without common points: the groups are independent.
class PairGroups {
 public:
  /// The numbers of points of a and of b.
  PairGroups(std::span<const NoisyPair> pairs, std::size_t pointsA, std::size_t pointsB);

  std::size_t count() const { return starts_.size() - 1; }
  /// Indices of the pairs of a group.
  std::span<const std::size_t> group(std::size_t index) const {
    return std::span(order_).subspan(starts_[index], starts_[index + 1] - starts_[index]);
  }

 private:
  std::vector<std::size_t> order_;
  std::vector<std::size_t> starts_;
};

/// The probability that any pair of a group meets. With pairs p_e:
/// - pairs without a common point are independent: 1 - prod(1 - p_e) over them is a lower bound;
/// - a group is divided into sets of such pairs; the sum over the sets is an upper bound.
/// The estimate assumes that all pairs are independent.
ProbabilityRange groupRange(std::span<const NoisyPair> pairs, std::span<const std::size_t> group);

}  // namespace swept::detail
