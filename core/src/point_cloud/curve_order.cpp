// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/curve_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "point_cloud/hilbert_curve.hpp"
#include "threads/crew.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// A run of indices that are still to be put in order.
struct Run {
  std::size_t first;
  std::size_t count;
};

/// This many points may share a cell of the grid: as many as a bucket of the hierarchy holds.
constexpr std::size_t kFew = 8;

class CurveOrder {
 public:
  CurveOrder(std::span<const Vector3d> points, Crew& crew)
      : points_(points), crew_(crew), order_(points.size()) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  std::vector<int> run(const Aabb& bounds) {
    sort({0, points_.size()}, bounds);
    while (!crowded_.empty()) {
      const Run run = crowded_.back();
      crowded_.pop_back();
      sort(run, boundsOf(run));
    }
    return std::move(order_);
  }

 private:
  Aabb boundsOf(const Run& run) const {
    Aabb box{point(run.first), point(run.first)};
    for (std::size_t i = run.first; i < run.first + run.count; ++i) {
      box.lower = box.lower.cwiseMin(point(i));
      box.upper = box.upper.cwiseMax(point(i));
    }
    return box;
  }
  const Vector3d& point(std::size_t place) const {
    return points_[static_cast<std::size_t>(order_[place])];
  }

  void sort(const Run& run, const Aabb& box) {
    if (!((box.upper - box.lower).maxCoeff() > 0.0) || run.count <= kFew) return;
    const auto indexBits = static_cast<int>(std::bit_width(run.count - 1));
    const int bits = bitsFor(indexBits);
    makeKeys(run, box, bits, indexBits);
    sortKeys(3 * bits, indexBits);
    const std::vector<int> before(
        order_.begin() + static_cast<std::ptrdiff_t>(run.first),
        order_.begin() + static_cast<std::ptrdiff_t>(run.first + run.count));
    const std::uint64_t mask = (std::uint64_t{1} << indexBits) - 1;
    std::size_t start = 0;
    for (std::size_t i = 0; i < run.count; ++i) {
      order_[run.first + i] = before[keys_[i] & mask];
      if (keys_[i] >> indexBits == keys_[start] >> indexBits) continue;
      noteCrowded(run.first + start, i - start);
      start = i;
    }
    noteCrowded(run.first + start, run.count - start);
  }

  void noteCrowded(std::size_t first, std::size_t count) {
    if (count > kFew) crowded_.push_back({first, count});
  }

  /// For points on a surface about one in sixteen cells is occupied. A key and an index share 64
  /// bits.
  static int bitsFor(int indexBits) {
    const int wanted = std::clamp((indexBits + 1) / 2 + 2, 6, HilbertCurve::kMostBits);
    return std::min((wanted + 1) / 2 * 2, (64 - indexBits) / 6 * 2);
  }

  /// The place on the curve, then the index in the run.
  void makeKeys(const Run& run, const Aabb& box, int bits, int indexBits) {
    const double cells = std::ldexp(1.0, bits);
    const double half = (0.5 * box.upper - 0.5 * box.lower).maxCoeff();
    // Near the least and the greatest double, an inverse or a difference would not be finite.
    const double shrink = half > 1e290 ? 0x1p-40 : half < 1e-290 ? 0x1p100 : 1.0;
    const double scale = cells * (1.0 - 1e-9) / (2.0 * shrink * half);
    constexpr std::size_t kAtOnce = 4;
    const auto cellOf = [&](const Vector3d& p) {
      std::array<std::uint32_t, 3> cell;
      for (int k = 0; k < 3; ++k) {
        const double at = (shrink * p[k] - shrink * box.lower[k]) * scale;
        cell[k] = static_cast<std::uint32_t>(std::clamp(at, 0.0, cells - 1.0));
      }
      return HilbertCurve::cell(cell[0], cell[1], cell[2]);
    };
    constexpr std::size_t kEach = 8192;
    keys_.resize(run.count);
    crew_.forPieces(run.count, kEach, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; i += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, last - i);
        std::array<std::uint64_t, kAtOnce> some{};
        for (std::size_t j = 0; j < count; ++j) some[j] = cellOf(point(run.first + i + j));
        const std::array<std::uint64_t, kAtOnce> indices = HilbertCurve::indices(some, bits);
        for (std::size_t j = 0; j < count; ++j) keys_[i + j] = indices[j] << indexBits | (i + j);
      }
    });
  }

  /// Sorts by the bits from `lowest` on, one digit at a time from the lowest.
  void sortKeys(int bits, int lowest) {
    constexpr int kMostDigit = 11;
    if (keys_.size() < 256) {
      std::sort(keys_.begin(), keys_.end());
      return;
    }
    const int passes = (bits + kMostDigit - 1) / kMostDigit;
    const int digit = (bits + passes - 1) / passes;
    const std::uint64_t mask = (std::uint64_t{1} << digit) - 1;
    sorted_.resize(keys_.size());
    for (int pass = 0; pass < passes; ++pass) {
      const int shift = lowest + pass * digit;
      std::array<std::uint32_t, std::size_t{1} << kMostDigit> place{};
      for (const std::uint64_t key : keys_) ++place[(key >> shift) & mask];
      std::uint32_t next = 0;
      for (std::uint32_t& at : place) next += std::exchange(at, next);
      for (const std::uint64_t key : keys_) sorted_[place[(key >> shift) & mask]++] = key;
      keys_.swap(sorted_);
    }
  }

  std::span<const Vector3d> points_;
  Crew& crew_;
  std::vector<int> order_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint64_t> sorted_;
  std::vector<Run> crowded_;
};

}  // namespace

std::vector<int> curveOrder(std::span<const Vector3d> points, const Aabb& bounds, Crew& crew) {
  return CurveOrder(points, crew).run(bounds);
}

}  // namespace swept::detail
