// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "mesh_samples.hpp"

/// Solids as programs write them that do not care for closed surfaces.
namespace swept::test {

/// Each triangle by itself: of its edges some are divided, at points that the neighbour knows
/// nothing of, and each corner is off by up to `error` (m) along each axis. `firstOf`: of each
/// triangle of `solid` the first that it became, and the number of all.
inline Soup broken(const Soup& solid, std::mt19937& random, double error,
                   std::vector<std::size_t>* firstOf = nullptr) {
  Soup soup;
  for (const Eigen::Vector3i& triangle : solid.triangles) {
    if (firstOf != nullptr) firstOf->push_back(soup.triangles.size());
    std::vector<Eigen::Vector3d> border;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& a = solid.vertices[triangle[k]];
      const Eigen::Vector3d& b = solid.vertices[triangle[(k + 1) % 3]];
      middle += a / 3.0;
      border.push_back(a);
      const int points = static_cast<int>(random() % 4);
      for (int i = 0; i < points; ++i)
        border.emplace_back(a + (i + uniform(random, 0.2, 0.8)) / points * (b - a));
    }
    if (error > 0.0)
      for (Eigen::Vector3d& point : border) point += uniformPoint(random, error);
    const auto offset = static_cast<int>(soup.vertices.size());
    const auto count = static_cast<int>(border.size());
    soup.vertices.insert(soup.vertices.end(), border.begin(), border.end());
    soup.vertices.push_back(middle);
    for (int i = 0; i < count; ++i)
      soup.triangles.emplace_back(offset + i, offset + (i + 1) % count, offset + count);
  }
  if (firstOf != nullptr) firstOf->push_back(soup.triangles.size());
  return soup;
}

/// An L of 1 m by 1 m by 0.5 m.
inline Soup angleSoup() {
  Soup soup;
  for (const double z : {0.0, 0.5}) {
    for (const auto& [x, y] :
         {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 0.4}, {0.3, 0.4}, {0.3, 1.0}, {0.0, 1.0}})
      soup.vertices.emplace_back(x, y, z);
  }
  for (const Eigen::Vector3i& t :
       std::vector<Eigen::Vector3i>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    soup.triangles.emplace_back(t[2], t[1], t[0]);
    soup.triangles.emplace_back(t.array() + 6);
  }
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    soup.triangles.emplace_back(i, next, next + 6);
    soup.triangles.emplace_back(i, next + 6, i + 6);
  }
  return soup;
}

inline Soup scaledSoup(Soup soup, double factor) {
  for (Eigen::Vector3d& vertex : soup.vertices) vertex *= factor;
  return soup;
}

}  // namespace swept::test
