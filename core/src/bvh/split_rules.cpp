// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bvh/split_rules.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "bv/principal_axes.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(SplitRule<MeanSplit> && SplitRule<MedianSplit> && SplitRule<PrincipalAxisSplit> &&
              SplitRule<SurfaceAreaSplit>);

namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Bounds {
  Vector3d lower = Vector3d::Constant(kInfinity);
  Vector3d upper = Vector3d::Constant(-kInfinity);

  void include(const Vector3d& low, const Vector3d& high) {
    for (int k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], low[k]);
      upper[k] = std::max(upper[k], high[k]);
    }
  }
  double halfArea() const {
    const Vector3d size = upper - lower;
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  }
};

struct Centers {
  Bounds bounds;
  Vector3d mean;
  int longestAxis = 0;
};

Centers centersOf(std::span<const SplitItem> items) {
  Centers centers;
  Vector3d sum = Vector3d::Zero();
  const double share = 1.0 / static_cast<double>(items.size());
  for (const SplitItem& item : items) {
    const Vector3d center = item.center();
    centers.bounds.include(center, center);
    // Divides before summing: a sum of large coordinates must not overflow.
    sum += share * center;
  }
  centers.mean = sum;
  (centers.bounds.upper - centers.bounds.lower).maxCoeff(&centers.longestAxis);
  return centers;
}

template <typename Goes>
std::size_t part(std::span<SplitItem> items, const Goes& goesLeft) {
  const auto middle = std::partition(items.begin(), items.end(), goesLeft);
  return static_cast<std::size_t>(middle - items.begin());
}

constexpr int kBins = 12;

/// Equal bins along an axis.
struct Bins {
  int axis;
  double lower;      ///< m, of the first bin
  double perLength;  ///< bins per metre

  int of(const SplitItem& item) const {
    const double position = (item.center(axis) - lower) * perLength;
    return std::clamp(static_cast<int>(position), 0, kBins - 1);
  }
};

/// First bin of the right side; 0 if no cut between bins separates the items.
int cheapestCut(std::span<const SplitItem> items, const Bins& bins) {
  std::array<Bounds, kBins> boxes;
  std::array<int, kBins> counts{};
  for (const SplitItem& item : items) {
    const int bin = bins.of(item);
    boxes[bin].include(item.lower, item.upper);
    ++counts[bin];
  }
  std::array<double, kBins> rightCosts{};
  Bounds right;
  for (int i = kBins - 1, count = 0; i > 0; --i) {
    if (counts[i] > 0) right.include(boxes[i].lower, boxes[i].upper);
    count += counts[i];
    rightCosts[i] = count == 0 ? 0.0 : count * right.halfArea();
  }
  int cut = 0;
  double best = kInfinity;
  Bounds left;
  for (int i = 1, count = 0; i < kBins; ++i) {
    if (counts[i - 1] > 0) left.include(boxes[i - 1].lower, boxes[i - 1].upper);
    count += counts[i - 1];
    if (count == 0 || count == static_cast<int>(items.size())) continue;
    const double cost = count * left.halfArea() + rightCosts[i];
    if (cost < best) {
      best = cost;
      cut = i;
    }
  }
  return cut;
}

}  // namespace

std::size_t MeanSplit::operator()(std::span<SplitItem> items) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, items] { return (*this)(items); });
  }
  const Centers centers = centersOf(items);
  const int axis = centers.longestAxis;
  const double mean = centers.mean[axis];
  return part(items, [=](const SplitItem& item) { return item.center(axis) < mean; });
}

std::size_t MedianSplit::operator()(std::span<SplitItem> items) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, items] { return (*this)(items); });
  }
  const int axis = centersOf(items).longestAxis;
  const std::size_t half = items.size() / 2;
  std::nth_element(
      items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
      [axis](const SplitItem& a, const SplitItem& b) { return a.center(axis) < b.center(axis); });
  return half;
}

std::size_t PrincipalAxisSplit::operator()(std::span<SplitItem> items) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, items] { return (*this)(items); });
  }
  const Vector3d mean = centersOf(items).mean;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const SplitItem& item : items) {
    const Vector3d d = item.center() - mean;
    scatter += d * d.transpose();
  }
  const Vector3d axis = detail::principalAxis(scatter);
  return part(items, [&](const SplitItem& item) { return axis.dot(item.center() - mean) < 0.0; });
}

std::size_t SurfaceAreaSplit::operator()(std::span<SplitItem> items) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, items] { return (*this)(items); });
  }
  const Centers centers = centersOf(items);
  const int axis = centers.longestAxis;
  const double length = centers.bounds.upper[axis] - centers.bounds.lower[axis];
  const Bins bins{axis, centers.bounds.lower[axis], kBins / length};
  // For equal centres, and extents so small or large that the scale is not finite.
  if (!(length > 0.0) || !(bins.perLength > 0.0) || !(bins.perLength < kInfinity)) return 0;
  const int cut = cheapestCut(items, bins);
  if (cut == 0) return 0;
  return part(items, [&](const SplitItem& item) { return bins.of(item) < cut; });
}

}  // namespace swept
