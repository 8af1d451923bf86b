// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bv/kdop.hpp"

#include <algorithm>
#include <cmath>

#include "bv/box_pair.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(BoundingVolume<KDop<16>> && BoundingVolume<KDop<18>> && BoundingVolume<KDop<24>>);

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Directions with components -1, 0 and 1.
constexpr std::array<std::array<int, 3>, 12> kDirections{{{1, 0, 0},
                                                          {0, 1, 0},
                                                          {0, 0, 1},
                                                          {1, 1, 0},
                                                          {1, -1, 0},
                                                          {1, 0, 1},
                                                          {1, 0, -1},
                                                          {0, 1, 1},
                                                          {0, 1, -1},
                                                          {1, 1, -1},
                                                          {1, -1, 1},
                                                          {-1, 1, 1}}};

/// Slabs with orthogonal directions: boxes around the polytope. The last one needs K >= 18.
constexpr std::array<std::array<int, 3>, 4> kFrames{{{0, 1, 2}, {3, 4, 2}, {5, 6, 1}, {7, 8, 0}}};

constexpr int frameCount(int k) {
  return k >= 18 ? 4 : 3;
}

double along(int slab, const Vector3d& p) {
  const auto& d = kDirections[slab];
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (d[i] != 0) sum += d[i] * p[i];
  }
  return sum;
}

constexpr double squaredLength(int slab) {
  const auto& d = kDirections[slab];
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

struct Interval {
  double lower;
  double upper;
};

/// Range of `direction` . p over the polytope: a direction is the sum of its components along the
/// three directions of a frame, each within its slab; the best frame counts.
template <int K>
Interval rangeAlong(const KDop<K>& dop, const Vector3d& direction) {
  Interval best{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int f = 0; f < frameCount(K); ++f) {
    double middle = 0.0;
    double reach = 0.0;
    for (int slab : kFrames[f]) {
      const double part = along(slab, direction) / squaredLength(slab);
      middle += part * (0.5 * dop.upper[slab] + 0.5 * dop.lower[slab]);
      reach += std::abs(part) * (0.5 * dop.upper[slab] - 0.5 * dop.lower[slab]);
    }
    best.lower = std::max(best.lower, middle - reach);
    best.upper = std::min(best.upper, middle + reach);
  }
  return best;
}

/// m; largest sum of absolute coordinates in the polytope's box.
template <int K>
double reachOf(const KDop<K>& dop) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += std::max(std::abs(dop.lower[k]), std::abs(dop.upper[k]));
  return sum;
}

template <int K>
detail::BoxPair pairOf(const KDop<K>& a, const KDop<K>& b, const Isometry3d& a_from_b) {
  const auto half = [](const KDop<K>& dop) {
    return Vector3d(0.5 * dop.upper[0] - 0.5 * dop.lower[0],
                    0.5 * dop.upper[1] - 0.5 * dop.lower[1],
                    0.5 * dop.upper[2] - 0.5 * dop.lower[2]);
  };
  detail::BoxPair p;
  p.rotation = a_from_b.linear();
  p.offset = p.rotation * b.center() + a_from_b.translation() - a.center();
  p.halfA = half(a);
  p.halfB = half(b);
  // A projection on a slab's direction adds up to three coordinates, hence the factor.
  p.margin = 3.0 * detail::volumeMargin(reachOf(a) + reachOf(b) +
                                        detail::magnitude(a_from_b.translation()));
  return p;
}

/// m^2; proven lower bound on the squared distance of `a` to `b`, which is bounded again in a's
/// frame; 0 if no slab of a separates them. b's points are rotation * p + translation. The squares
/// of the gaps along orthogonal slabs add up.
template <int K>
double squaredSlabBound(const KDop<K>& a, const KDop<K>& b, const Eigen::Matrix3d& rotation,
                        const Vector3d& translation, double margin) {
  std::array<double, KDop<K>::kSlabs> squares;
  double best = 0.0;
  for (int k = 0; k < KDop<K>::kSlabs; ++k) {
    const auto& d = kDirections[k];
    const Vector3d direction = rotation.transpose() * Vector3d(d[0], d[1], d[2]);
    const Interval range = rangeAlong(b, direction);
    const double shift = along(k, translation);
    const double gap = std::max(range.lower + shift - a.upper[k], a.lower[k] - range.upper - shift);
    squares[k] = detail::provenSquare(gap, margin) / squaredLength(k);
    best = std::max(best, squares[k]);
  }
  for (int f = 0; f < frameCount(K); ++f) {
    best = std::max(best, squares[kFrames[f][0]] + squares[kFrames[f][1]] + squares[kFrames[f][2]]);
  }
  return best;
}

/// m^2; the better of the two orders.
template <int K>
double squaredBound(const KDop<K>& a, const KDop<K>& b, const Isometry3d& a_from_b, double margin) {
  const Eigen::Matrix3d rotation = a_from_b.linear();
  const Vector3d translation = a_from_b.translation();
  const Eigen::Matrix3d inverse = rotation.transpose();
  const Vector3d back = -(inverse * translation);
  return std::max(squaredSlabBound(a, b, rotation, translation, margin),
                  squaredSlabBound(b, a, inverse, back, margin));
}

}  // namespace

template <int K>
KDop<K> KDop<K>::fit(std::span<const Vector3d> points) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points] { return fit(points); });
  }
  KDop dop;
  dop.lower.fill(NAN);
  dop.upper.fill(NAN);
  if (points.empty()) return dop;
  for (int k = 0; k < kSlabs; ++k) dop.lower[k] = dop.upper[k] = along(k, points.front());
  double zero = 0.0;  // becomes NaN with the first non-finite coordinate
  for (const Vector3d& p : points) {
    zero += 0.0 * p[0] + 0.0 * p[1] + 0.0 * p[2];
    for (int k = 0; k < kSlabs; ++k) {
      const double at = along(k, p);
      dop.lower[k] = at < dop.lower[k] ? at : dop.lower[k];
      dop.upper[k] = at > dop.upper[k] ? at : dop.upper[k];
    }
  }
  // Lemma: sums of two or three coordinates round by at most an epsilon of the sum of their
  // absolute values, here and again in contains(). The coordinates themselves are exact.
  const double growth = 1e-15 * reachOf(dop) + zero;
  for (int k = 0; k < kSlabs; ++k) {
    dop.lower[k] -= k < 3 ? zero : growth;
    dop.upper[k] += k < 3 ? zero : growth;
  }
  return dop;
}

template <int K>
KDop<K> KDop<K>::merge(const KDop& a, const KDop& b) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return merge(a, b); });
  }
  KDop dop;
  for (int k = 0; k < kSlabs; ++k) {
    // The products keep a NaN that minimum and maximum may drop.
    const double poison = 0.0 * a.lower[k] + 0.0 * b.lower[k];
    dop.lower[k] = std::min(a.lower[k], b.lower[k]) + poison;
    dop.upper[k] = std::max(a.upper[k], b.upper[k]) + poison;
  }
  return dop;
}

template <int K>
KDop<K> KDop<K>::inflated(double by) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, by] { return inflated(by); });
  }
  KDop dop;
  const double rounding = 2e-15 * (by + reachOf(*this));
  for (int k = 0; k < kSlabs; ++k) {
    const double growth = by * std::sqrt(squaredLength(k)) + rounding;
    dop.lower[k] = lower[k] - growth;
    dop.upper[k] = upper[k] + growth;
  }
  return dop;
}

template <int K>
bool KDop<K>::overlaps(const KDop& other, const Isometry3d& a_from_b) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return overlaps(other, a_from_b); });
  }
  const detail::BoxPair p = pairOf(*this, other, a_from_b);
  if (detail::separatedByFaces(p)) return false;
  return !(squaredBound(*this, other, a_from_b, p.margin) > 0.0);
}

template <int K>
double KDop<K>::distanceBound(const KDop& other, const Isometry3d& a_from_b) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return distanceBound(other, a_from_b); });
  }
  const detail::BoxPair p = pairOf(*this, other, a_from_b);
  return detail::boundFromSquare(
      std::max(squaredBound(*this, other, a_from_b, p.margin), detail::squaredFaceBound(p)));
}

template <int K>
bool KDop<K>::contains(const Vector3d& p) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return contains(p); });
  }
  for (int k = 0; k < kSlabs; ++k) {
    const double at = along(k, p);
    if (at < lower[k] || at > upper[k]) return false;
  }
  return true;
}

template struct KDop<16>;
template struct KDop<18>;
template struct KDop<24>;

}  // namespace swept
