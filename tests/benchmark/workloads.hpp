// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "mesh_files.hpp"

/// Meshes and poses made on the spot; the same ones in every run.
namespace swept::benchmark {

inline double uniform(std::mt19937_64& random, double low, double high) {
  // Not std::uniform_real_distribution: its numbers differ between standard libraries.
  return low + (high - low) * 0x1.0p-53 * static_cast<double>(random() >> 11);
}

inline Eigen::Vector3d direction(std::mt19937_64& random) {
  const double z = uniform(random, -1.0, 1.0);
  const double angle = uniform(random, 0.0, 2.0 * std::numbers::pi);
  const double radial = std::sqrt(1.0 - z * z);
  return {radial * std::cos(angle), radial * std::sin(angle), z};
}

inline Eigen::Isometry3d randomPose(std::mt19937_64& random, const Eigen::Vector3d& reach) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const double turn = uniform(random, 0.0, std::numbers::pi);
  pose.linear() = Eigen::AngleAxisd(turn, direction(random)).toRotationMatrix();
  for (int axis = 0; axis < 3; ++axis)
    pose.translation()[axis] = uniform(random, -reach[axis], reach[axis]);
  return pose;
}

/// Grid of m by n cells; `point(u, v)` with u, v in [0, 1]. Wraps around where asked to.
inline Soup grid(int m, int n, bool wrapU, bool wrapV,
                 const std::function<Eigen::Vector3d(double, double)>& point) {
  Soup soup;
  const int rows = wrapU ? m : m + 1, columns = wrapV ? n : n + 1;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      soup.vertices.push_back(point(static_cast<double>(i) / m, static_cast<double>(j) / n));
  const auto index = [&](int i, int j) { return i % rows * columns + j % columns; };
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = index(i, j), b = index(i + 1, j), c = index(i + 1, j + 1), d = index(i, j + 1);
      soup.triangles.emplace_back(a, b, c);
      soup.triangles.emplace_back(a, c, d);
    }
  }
  return soup;
}

/// 2 m n triangles; closed. Bumps of a tenth of the tube.
inline Soup bumpyTorus(int m, int n, double major, double minor) {
  return grid(m, n, true, true, [=](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, b = 2.0 * std::numbers::pi * v;
    const double tube = minor * (1.0 + 0.1 * std::sin(17.0 * a) * std::sin(5.0 * b));
    const double radial = major + tube * std::cos(b);
    return Eigen::Vector3d(radial * std::cos(a), radial * std::sin(a), tube * std::sin(b));
  });
}

/// About `count` triangles, closed: the six faces of a cube, blown up. Unlike a grid of longitudes
/// it has no crowded poles.
inline Soup bumpySphere(int count, double radius) {
  const int cells = std::max(1, static_cast<int>(std::lround(std::sqrt(count / 12.0))));
  Soup soup;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const double side = face % 2 == 0 ? 1.0 : -1.0;
    const Soup part = grid(cells, cells, false, false, [=](double u, double v) {
      Eigen::Vector3d p;
      p[axis] = side;
      // Equal angles, and exact at the borders, where the faces meet.
      const auto spread = [](double t) {
        if (t == 0.0 || t == 1.0) return 2.0 * t - 1.0;
        return std::tan((t - 0.5) * 0.5 * std::numbers::pi);
      };
      p[(axis + 1) % 3] = spread(u);
      p[(axis + 2) % 3] = side * spread(v);
      p.normalize();
      const double bump = std::sin(9.0 * p.x()) * std::sin(8.0 * p.y()) * std::sin(7.0 * p.z());
      return Eigen::Vector3d(radius * (1.0 + 0.08 * bump) * p);
    });
    const auto offset = static_cast<int>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const Eigen::Vector3i& t : part.triangles)
      soup.triangles.emplace_back(t[0] + offset, t[1] + offset, t[2] + offset);
  }
  return soup;
}

/// 2 m n triangles; open, 2 `half` wide.
inline Soup terrain(int m, int n, double half) {
  return grid(m, n, false, false, [=](double u, double v) {
    const double x = half * (2.0 * u - 1.0), y = half * (2.0 * v - 1.0);
    const double z = 0.25 * std::sin(2.1 * x + 0.3) * std::cos(1.7 * y) +
                     0.1 * std::sin(5.3 * x) * std::sin(6.1 * y + 1.0) +
                     0.03 * std::sin(17.0 * x + 3.0 * y);
    return Eigen::Vector3d(x, y, z);
  });
}

/// 2 m n triangles; closed: a thick wheel with teeth.
inline Soup gear(int m, int n, double radius, int teeth) {
  return grid(m, n, true, true, [=](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, b = 2.0 * std::numbers::pi * v;
    const double tooth = 1.0 + 0.15 * std::tanh(4.0 * std::sin(teeth * a));
    const double radial = radius * (0.65 + 0.35 * tooth * std::tanh(2.0 * std::cos(b)));
    return Eigen::Vector3d(radial * std::cos(a), radial * std::sin(a),
                           0.25 * radius * std::tanh(2.0 * std::sin(b)));
  });
}

/// Moves from a free to a touching pose, rotation fixed, until `steps` halvings are done; returns
/// the last free and the last touching pose.
struct Bracket {
  Eigen::Isometry3d free;
  Eigen::Isometry3d touching;
};
inline Bracket bisect(Bracket bracket, int steps,
                      const std::function<bool(const Eigen::Isometry3d&)>& touches) {
  for (int i = 0; i < steps; ++i) {
    Eigen::Isometry3d middle = bracket.free;
    middle.translation() = 0.5 * bracket.free.translation() + 0.5 * bracket.touching.translation();
    (touches(middle) ? bracket.touching : bracket.free) = middle;
  }
  return bracket;
}

}  // namespace swept::benchmark
