// SPDX-License-Identifier: BSD-3-Clause
// Your own bounding volume, a ball, in the library's hierarchies. Exits 0 if it gives the same
// distance of two meshes as the library's own query.
#include <cmath>
#include <iostream>

#include "swept/core/distance.hpp"
#include "swept/core/height_field.hpp"
#include "swept/core/traversal/mesh_distance.hpp"

using Eigen::Isometry3d;
using Eigen::Vector3d;
constexpr double kSlack = 1e-13;  // relative: more than all roundings

struct Ball {
  Vector3d middle;  // m
  double radius;    // m; NaN or infinite if points are missing or not finite: contains everything
  static Ball around(const Vector3d& middle, double radius) {
    return {middle, radius + kSlack * (radius + middle.lpNorm<1>())};
  }
  static Ball fit(std::span<const Vector3d> points) {
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& p : points) middle += p / static_cast<double>(points.size());
    if (points.empty()) middle.fill(NAN);
    double radius = 0.0;
    for (const Vector3d& p : points) radius = std::max(radius, (p - middle).norm());
    return around(middle, radius);
  }
  static Ball merge(const Ball& a, const Ball& b) {
    const double apart = (b.middle - a.middle).norm();
    return around(0.5 * (a.middle + b.middle), 0.5 * apart + std::max(a.radius, b.radius));
  }
  Ball inflated(double by) const { return around(middle, radius + by); }
  bool overlaps(const Ball& b, const Isometry3d& a_from_b = Isometry3d::Identity()) const {
    return distanceBound(b, a_from_b) == 0.0;
  }
  double distanceBound(const Ball& b, const Isometry3d& a_from_b) const {
    const Ball placed = around(a_from_b * b.middle, b.radius);
    const double gap = (placed.middle - middle).norm() - radius - placed.radius -
                       kSlack * (middle.lpNorm<1>() + a_from_b.translation().lpNorm<1>());
    return gap > 0.0 && std::isfinite(gap) ? gap : 0.0;  // NaN is not greater
  }
  bool contains(const Vector3d& p) const { return !((p - middle).norm() > radius); }
  Vector3d center() const { return middle; }
  double size() const { return 4.0 * radius * radius; }
};

int main() {
  const auto hills = swept::heightField(2.0, 2.0, 0.3 * Eigen::MatrixXd::Random(30, 30), -1.0);
  swept::BvhModel<Ball> model({.fit = swept::FitToChildren{}});
  model.begin();
  model.addMesh(hills.vertices(), hills.triangles());
  model.end();
  const Isometry3d pose(Eigen::Translation3d(0, 0, 1) * Eigen::AngleAxisd(3, Vector3d::UnitX()));
  const double mine = swept::meshDistance(model, model, pose).upper;
  const double theirs = swept::distance(hills, hills, pose).upper;
  std::cout << "distance with balls " << mine << " m, without " << theirs << " m\n";
  return mine > 0.0 && std::abs(mine - theirs) < 1e-9 ? 0 : 1;
}
