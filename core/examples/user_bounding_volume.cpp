// SPDX-License-Identifier: BSD-3-Clause
// A bounding volume of one's own, a ball. Exits 0 if distances come out as with the library's own.
#include <cmath>
#include <cstdio>

#include "swept/core/traversal/mesh_distance.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Ball {
  Vector3d middle;
  double radius;  // NaN: contains everything. Comparisons below let NaN overlap
  static double slack(double magnitude) { return 1e-14 * magnitude; }  // more than all roundings

  static Ball fit(std::span<const Vector3d> points) {
    Ball ball{Vector3d::Zero(), points.empty() ? NAN : 0.0};
    for (const Vector3d& p : points) ball.middle += p / static_cast<double>(points.size());
    double largest = 0.0;
    for (const Vector3d& p : points) largest = std::max(largest, (p - ball.middle).norm());
    ball.radius += largest + slack(largest + ball.middle.lpNorm<1>());
    return ball;
  }
  static Ball merge(const Ball& a, const Ball& b) {
    const double apart = (b.middle - a.middle).norm();
    if (apart + b.radius <= a.radius) return a;
    if (apart + a.radius <= b.radius) return b;
    const double radius = 0.5 * (apart + a.radius + b.radius);
    const double shift = apart > 0.0 ? (radius - a.radius) / apart : 0.0;
    const Vector3d middle = a.middle + shift * (b.middle - a.middle);
    return {middle, radius + slack(radius + middle.lpNorm<1>() + a.middle.lpNorm<1>())};
  }
  Ball inflated(double by) const { return {middle, radius + by + slack(radius + by)}; }
  double gap(const Ball& other, const Isometry3d& a_from_b) const {
    const double magnitude = middle.lpNorm<1>() + other.middle.lpNorm<1>() + radius + other.radius +
                             a_from_b.translation().lpNorm<1>();
    return (a_from_b * other.middle - middle).norm() - radius - other.radius - slack(magnitude);
  }
  bool overlaps(const Ball& other) const { return overlaps(other, Isometry3d::Identity()); }
  bool overlaps(const Ball& other, const Isometry3d& a_from_b) const {
    return !(gap(other, a_from_b) > 0.0);
  }
  double distanceBound(const Ball& other, const Isometry3d& a_from_b) const {
    const double bound = gap(other, a_from_b);
    return bound > 0.0 && std::isfinite(bound) ? bound : 0.0;
  }
  bool contains(const Vector3d& p) const { return !((p - middle).norm() > radius); }
  Vector3d center() const { return middle; }
  double size() const { return 4.0 * radius * radius; }
};
static_assert(swept::BoundingVolume<Ball>);

// Distance of a heap of triangles from itself, moved.
template <typename BV>
double distanceOfHeaps(const Isometry3d& pose) {
  std::srand(1);
  swept::BvhModel<BV> heap;
  heap.begin();
  for (int i = 0; i < 1000; ++i) {
    const Vector3d at = Vector3d::Random();
    heap.addTriangle(at, at + 0.1 * Vector3d::Random(), at + 0.1 * Vector3d::Random());
  }
  heap.end();
  return swept::meshDistance(heap, heap, pose).upper;
}

}  // namespace

int main() {
  Isometry3d pose(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  pose.translation() = Vector3d(1.9, 1.1, 0.4);
  const double mine = distanceOfHeaps<Ball>(pose);
  const double theirs = distanceOfHeaps<swept::ObbRss>(pose);
  std::printf("distance with balls %.12f m, with OBBRSS %.12f m\n", mine, theirs);
  return mine > 0.0 && std::abs(mine - theirs) < 1e-12 ? 0 : 1;
}
