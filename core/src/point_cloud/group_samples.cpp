// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/group_samples.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace swept::detail {

GroupSamples::GroupSamples(const NoisyCloudData& a, const NoisyCloudData& b,
                           const Eigen::Isometry3d& a_from_b, std::span<const NoisyPair> pairs,
                           std::span<const std::size_t> group) {
  std::map<std::pair<bool, std::size_t>, std::size_t> places;
  const auto placeOf = [&](bool ofA, std::size_t point) {
    const auto [entry, isNew] = places.try_emplace({ofA, point}, points_.size());
    if (isNew && ofA) points_.push_back({a.points[point], a.factor(point)});
    if (isNew && !ofA) {
      points_.push_back({a_from_b * b.points[point], a_from_b.linear() * b.factor(point)});
    }
    return entry->second;
  };
  for (const std::size_t index : group) {
    const NoisyPair& pair = pairs[index];
    meetings_.push_back(
        {{placeOf(true, pair.a), placeOf(false, pair.b)}, a.radii[pair.a] + b.radii[pair.b]});
  }
  positions_.resize(points_.size());
}

void GroupSamples::draw(int draws, std::mt19937_64& random) {
  for (int i = 0; i < draws; ++i) {
    for (std::size_t k = 0; k < points_.size(); ++k) {
      const double x = normal_(random);
      const double y = normal_(random);
      positions_[k] = points_[k].mean + points_[k].factor * Eigen::Vector3d(x, y, normal_(random));
    }
    const bool met = std::any_of(meetings_.begin(), meetings_.end(), [&](const Meeting& meeting) {
      const auto& [one, other] = meeting.points;
      return (positions_[one] - positions_[other]).squaredNorm() <= meeting.radius * meeting.radius;
    });
    met_ += met ? 1 : 0;
  }
  draws_ += draws;
}

// Adds one sample of either outcome (Laplace's rule), so that few samples never give certainty.
double GroupSamples::standardError() const {
  const double draws = draws_ + 2.0;
  const double p = (met_ + 1.0) / draws;
  return std::sqrt(p * (1.0 - p) / draws);
}

}  // namespace swept::detail
