// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

/// Meshes that tests are made of.
namespace swept::test {

/// Triangles before anything looked at them.
struct Soup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;

  /// By value, so that a soup may be appended to itself.
  void append(Soup other) {
    const auto offset = static_cast<int>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const Eigen::Vector3i& t : other.triangles) {
      triangles.emplace_back(t.array() + offset);
    }
  }
  Soup inverted() const {
    Soup out = *this;
    for (Eigen::Vector3i& t : out.triangles) std::swap(t[0], t[1]);
    return out;
  }
  Soup moved(const Eigen::Isometry3d& by) const {
    Soup out = *this;
    for (Eigen::Vector3d& v : out.vertices) v = by * v;
    return out;
  }
};

inline double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Eigen::Vector3d uniformPoint(std::mt19937& random, double size) {
  const double x = uniform(random, -size, size);
  const double y = uniform(random, -size, size);
  return {x, y, uniform(random, -size, size)};
}

inline Eigen::Vector3d unitVector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random);
  const double y = normal(random);
  return Eigen::Vector3d(x, y, normal(random)).normalized();
}

inline Eigen::Isometry3d randomPose(std::mt19937& random, double reach) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d axis = unitVector(random);
  pose.linear() =
      Eigen::AngleAxisd(uniform(random, 0.0, std::numbers::pi), axis).toRotationMatrix();
  pose.translation() = uniformPoint(random, reach);
  return pose;
}

/// Outward-oriented box. Corner i has the upper x, y, z where bit 0, 1, 2 of i is set.
inline Soup boxSoup(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  Soup soup;
  for (int i = 0; i < 8; ++i) {
    soup.vertices.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(),
                               (i & 4 ? upper : lower).z());
  }
  soup.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return soup;
}

/// Triangles by themselves within 1 m of `offset` along each axis, every other one a sliver, of all
/// widths down to 1e-16 m.
inline Soup sliverSoup(std::mt19937& random, int count, const Eigen::Vector3d& offset) {
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d a = offset + uniformPoint(random, 1.0);
    const Eigen::Vector3d along = uniformPoint(random, 0.5);
    const double width = i % 2 == 0 ? 0.5 : std::pow(10.0, -uniform(random, 1.0, 16.0));
    const Eigen::Vector3d apex = a + 0.4 * along + width * unitVector(random);
    soup.append({{a, a + along, apex}, {{0, 1, 2}}});
  }
  return soup;
}

/// Closed grid: `point(u, v)` with u of `m` and v of `n` steps, both wrapping around.
template <typename Point>
Soup wrappedGrid(int m, int n, const Point& point) {
  Soup soup;
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      soup.vertices.push_back(point(static_cast<double>(i) / m, static_cast<double>(j) / n));
      const int a = i * n + j;
      const int b = (i + 1) % m * n + j;
      const int c = (i + 1) % m * n + (j + 1) % n;
      const int d = i * n + (j + 1) % n;
      soup.triangles.emplace_back(a, b, c);
      soup.triangles.emplace_back(a, c, d);
    }
  }
  return soup;
}

inline Soup torusSoup(int m, int n, double major, double minor) {
  return wrappedGrid(m, n, [=](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u;
    const double b = 2.0 * std::numbers::pi * v;
    const double radial = major + minor * std::cos(b);
    return Eigen::Vector3d(radial * std::cos(a), radial * std::sin(a), minor * std::sin(b));
  });
}

/// Outward-oriented star-shaped solid about the origin with random radii in [0.5, 1].
inline Soup blobSoup(std::mt19937& random, int rings, int sectors) {
  Soup soup;
  for (int i = 1; i < rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (int j = 0; j < sectors; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / sectors;
      const Eigen::Vector3d direction(std::sin(polar) * std::cos(angle),
                                      std::sin(polar) * std::sin(angle), std::cos(polar));
      soup.vertices.push_back(uniform(random, 0.5, 1.0) * direction);
    }
  }
  const int top = static_cast<int>(soup.vertices.size());
  const int bottom = top + 1;
  soup.vertices.emplace_back(0.0, 0.0, uniform(random, 0.5, 1.0));
  soup.vertices.emplace_back(0.0, 0.0, -uniform(random, 0.5, 1.0));
  for (int j = 0; j < sectors; ++j) {
    const int next = (j + 1) % sectors;
    soup.triangles.emplace_back(top, j, next);
    const int last = (rings - 2) * sectors;
    soup.triangles.emplace_back(bottom, last + next, last + j);
    for (int i = 0; i + 2 < rings; ++i) {
      const int a = i * sectors;
      const int b = a + sectors;
      soup.triangles.emplace_back(a + j, b + j, b + next);
      soup.triangles.emplace_back(a + j, b + next, a + next);
    }
  }
  return soup;
}

}  // namespace swept::test
