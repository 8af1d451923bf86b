// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "mesh_samples.hpp"
#include "swept/core/broadphase/broadphase.hpp"

namespace swept::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Eigen::Vector3d;
using Pairs = std::vector<std::pair<BoxHandle, BoxHandle>>;

inline bool chance(std::mt19937& random, double share) {
  return uniform(random, 0.0, 1.0) < share;
}

/// Kinds of worlds that managers have failed on.
enum class World {
  Even,       ///< sizes alike, evenly spread
  Sizes,      ///< 1e-6 to 1e6 m
  Grid,       ///< few coordinates, so that endpoints coincide; half of the extents zero
  Plates,     ///< 1 mm thin, stacked
  Far,        ///< 1e6 m away every now and then
  Hostile,    ///< one in eight has a NaN, is upside down, or infinite
  Identical,  ///< one of two boxes
};
inline constexpr std::array kWorlds = {World::Even, World::Sizes,   World::Grid,     World::Plates,
                                       World::Far,  World::Hostile, World::Identical};

inline Aabb around(const Vector3d& center, const Vector3d& half) {
  return {center - half, center + half};
}

inline Aabb evenBox(std::mt19937& random, double reach) {
  const Vector3d center = uniformPoint(random, reach);
  return around(center, uniformPoint(random, 0.4).cwiseAbs());
}

inline Aabb hostileBox(std::mt19937& random, double reach) {
  Aabb box = evenBox(random, reach);
  if (!chance(random, 0.125)) return box;
  const int axis = std::uniform_int_distribution<int>(0, 2)(random);
  switch (std::uniform_int_distribution<int>(0, 5)(random)) {
    case 0:
      box.lower[axis] = kNan;
      break;
    case 1:
      box.upper.setConstant(kNan);
      break;
    case 2:
      std::swap(box.lower[axis], box.upper[axis]);
      break;
    case 3:
      box.upper[axis] = kInfinity;
      break;
    case 4:
      box = {Vector3d::Constant(-kInfinity), Vector3d::Constant(kInfinity)};
      break;
    default:
      box.lower[axis] = box.upper[axis] = chance(random, 0.5) ? kInfinity : -1e300;
  }
  return box;
}

/// `reach`: m, of the world; about one pair a box at reach^3 = 1 / 2 of a box.
inline Aabb randomBox(std::mt19937& random, World world, double reach) {
  switch (world) {
    case World::Sizes: {
      const double size = std::pow(10.0, uniform(random, -6.0, chance(random, 0.1) ? 6.0 : 0.0));
      const Vector3d center = uniformPoint(random, reach);
      return around(center, size * uniformPoint(random, 0.5).cwiseAbs());
    }
    case World::Grid: {
      std::uniform_int_distribution<int> cell(0, static_cast<int>(std::ceil(reach)) + 1);
      Vector3d lower;
      for (int k = 0; k < 3; ++k) lower[k] = cell(random);
      Vector3d size = Vector3d::Zero();
      for (int k = 0; k < 3; ++k) size[k] = chance(random, 0.5) ? 0.0 : 1.0;
      return {lower, lower + size};
    }
    case World::Plates: {
      const Vector3d center = uniformPoint(random, 0.5 * reach);
      return around({center.x(), center.y(), 0.01 * center.z()}, {0.5, 0.5, 0.0005});
    }
    case World::Far: {
      const double scale = chance(random, 0.3) ? 1e6 : 1.0;
      const Vector3d center = scale * uniformPoint(random, reach);
      return around(center, uniformPoint(random, 0.5).cwiseAbs());
    }
    case World::Hostile:
      return hostileBox(random, reach);
    case World::Identical: {
      const Vector3d at = Vector3d::Constant(chance(random, 0.5) ? 0.0 : 1.0);
      return {at, at + Vector3d(0.5, 0.0, 0.5)};
    }
    case World::Even:
      break;
  }
  return evenBox(random, reach);
}

inline Aabb shifted(const Aabb& box, const Vector3d& by) {
  return {box.lower + by, box.upper + by};
}

/// What the managers are to agree with: a list of boxes, and the plainest loops.
class Reference {
 public:
  std::map<BoxHandle, Aabb> boxes;

  static Aabb meaning(const Aabb& box) {
    for (int k = 0; k < 3; ++k) {
      if (std::isnan(box.lower[k]) || std::isnan(box.upper[k]) || box.lower[k] > box.upper[k])
        return {Vector3d::Constant(-kInfinity), Vector3d::Constant(kInfinity)};
    }
    return box;
  }
  static bool overlap(const Aabb& first, const Aabb& second) {
    const Aabb a = meaning(first), b = meaning(second);
    for (int k = 0; k < 3; ++k)
      if (std::max(a.lower[k], b.lower[k]) > std::min(a.upper[k], b.upper[k])) return false;
    return true;
  }
  Pairs pairs() const {
    Pairs found;
    for (const auto& [a, boxA] : boxes) {
      for (const auto& [b, boxB] : boxes)
        if (a < b && overlap(boxA, boxB)) found.emplace_back(a, b);
    }
    return found;
  }
  std::vector<BoxHandle> overlapping(const Aabb& box) const {
    std::vector<BoxHandle> found;
    for (const auto& [handle, own] : boxes)
      if (overlap(own, box)) found.push_back(handle);
    return found;
  }
};

template <typename Manager>
Pairs pairsOf(const Manager& manager) {
  Pairs found;
  EXPECT_FALSE(manager.collide([&](BoxHandle a, BoxHandle b) {
    found.emplace_back(a, b);
    return false;
  }));
  return found;
}

template <typename Manager>
std::vector<BoxHandle> overlappingOf(const Manager& manager, const Aabb& box,
                                     BroadphaseScratch& scratch) {
  std::vector<BoxHandle> found;
  EXPECT_FALSE(manager.collide(box, scratch, [&](BoxHandle handle) {
    found.push_back(handle);
    return false;
  }));
  return found;
}

struct Visit {
  BoxHandle handle;
  double distance;  ///< m
  bool operator==(const Visit&) const = default;
};

/// The `most` nearest.
template <typename Manager>
std::vector<Visit> nearestOf(const Manager& manager, const Aabb& box, std::size_t most,
                             BroadphaseScratch& scratch) {
  std::vector<Visit> found;
  manager.distance(box, scratch, [&](BoxHandle handle, double distance) {
    found.push_back({handle, distance});
    return found.size() < most ? kInfinity : -1.0;
  });
  return found;
}

using PairVisit = BroadphaseScratch::Pair;

/// The `most` nearest pairs; of one manager, or of it against `other`.
template <typename Manager>
std::vector<PairVisit> nearestPairsOf(const Manager& manager, const Manager* other,
                                      std::size_t most, BroadphaseScratch& scratch) {
  std::vector<PairVisit> found;
  const auto visit = [&](BoxHandle a, BoxHandle b, double distance) {
    found.push_back({distance, a, b});
    return found.size() < most ? kInfinity : (most % 2 == 0 ? 0.0 : -kInfinity);
  };
  const double bound = other == nullptr ? manager.distance(scratch, visit)
                                        : manager.distance(*other, scratch, visit);
  EXPECT_EQ(bound == kInfinity, found.size() < most);
  return found;
}

/// What `nearestPairsOf` should give.
inline std::vector<PairVisit> nearestPairsOf(const Reference& first, const Reference* second,
                                             std::size_t most) {
  std::vector<PairVisit> all;
  for (const auto& [a, boxA] : first.boxes) {
    for (const auto& [b, boxB] : (second == nullptr ? first : *second).boxes) {
      if (second == nullptr && a >= b) continue;
      all.push_back({boxDistance(Reference::meaning(boxA), Reference::meaning(boxB)), a, b});
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const PairVisit& x, const PairVisit& y) { return x.distance < y.distance; });
  if (all.size() > most) all.resize(most);
  return all;
}

}  // namespace swept::test
