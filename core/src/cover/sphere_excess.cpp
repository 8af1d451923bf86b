// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include "cover/posed_body.hpp"
#include "cover/sphere_checks.hpp"
#include "swept/core/enclosing_spheres.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

using detail::PosedBody;
using Eigen::Vector3d;

/// The distance from the body is 1-Lipschitz: over a cube it is at most that of its middle and half
/// its diagonal. The cube with the largest bound is divided, and dropped when it is not on the
/// surface of the union.
class ExcessSearch {
 public:
  ExcessSearch(const PosedBody& body, std::span<const EnclosingSphere> spheres)
      : body_(body), spheres_(spheres) {
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      // A point of the ball is at most this far from the ball of the body around the centre.
      const double most =
          spheres[i].radius - body_.depth(spheres[i].center, false) + roundingOf(spheres[i]);
      add({std::max(most, 0.0), spheres[i].center, spheres[i].radius, i});
    }
  }

  void run(double tolerance, int mostDistances) {
    int distances = 0;
    while (!cubes_.empty() && distances + 8 <= mostDistances) {
      if (!(cubes_.front().bound > (1.0 + tolerance) * seen_ + 1e-7)) return;
      std::pop_heap(cubes_.begin(), cubes_.end(), less);
      const Cube top = cubes_.back();
      cubes_.pop_back();
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                            (corner & 4) != 0 ? 1.0 : -1.0);
        Cube part{top.bound, top.middle + 0.5 * top.half * sign, 0.5 * top.half, top.sphere};
        if (!meetsSurface(part)) continue;
        ++distances;
        const double here = std::max(0.0, -body_.depth(part.middle, false));
        part.bound = std::min(top.bound, here + diagonal(part) + roundingOf(spheres_[part.sphere]));
        see(part);
        if (part.bound > seen_) add(part);
      }
    }
  }

  double seen() const { return seen_; }
  double largest() const { return cubes_.empty() ? seen_ : std::max(seen_, cubes_.front().bound); }

 private:
  struct Cube {
    double bound;  ///< m
    Vector3d middle;
    double half;         ///< m, of an edge
    std::size_t sphere;  ///< only its surface counts
  };
  static bool less(const Cube& a, const Cube& b) { return a.bound < b.bound; }
  static double diagonal(const Cube& cube) { return 1.7320508075688774 * cube.half; }
  static double roundingOf(const EnclosingSphere& sphere) {
    return 1e-12 * (sphere.center.lpNorm<Eigen::Infinity>() + sphere.radius);
  }

  void add(const Cube& cube) {
    cubes_.push_back(cube);
    std::push_heap(cubes_.begin(), cubes_.end(), less);
  }

  /// Not if it is off the sphere, or in a ball: then it is not on the surface of the union.
  bool meetsSurface(const Cube& cube) const {
    const EnclosingSphere& own = spheres_[cube.sphere];
    const double error = roundingOf(own);
    if ((cube.middle - own.center).norm() - diagonal(cube) > own.radius + error) return false;
    return std::ranges::none_of(spheres_, [&](const EnclosingSphere& ball) {
      const Vector3d far = (cube.middle - ball.center).cwiseAbs().array() + cube.half;
      return far.norm() < ball.radius - error - roundingOf(ball);
    });
  }

  void see(const Cube& cube) {
    const EnclosingSphere& own = spheres_[cube.sphere];
    const Vector3d away = cube.middle - own.center;
    if (!(away.norm() > 0.0)) return;
    const Vector3d point = own.center + own.radius * away.normalized();
    for (std::size_t i = 0; i < spheres_.size(); ++i)
      if (i != cube.sphere && (point - spheres_[i].center).norm() < spheres_[i].radius) return;
    seen_ = std::max(seen_, -body_.depth(point, false));
  }

  const PosedBody& body_;
  std::span<const EnclosingSphere> spheres_;
  std::vector<Cube> cubes_;  ///< a heap
  double seen_ = 0.0;        ///< m
};

double meanExcess(const PosedBody& body, std::span<const EnclosingSphere> spheres, int samples,
                  std::mt19937& random) {
  std::normal_distribution<double> normal;
  double area = 0.0;
  for (const EnclosingSphere& sphere : spheres) area += sphere.radius * sphere.radius;
  double sum = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const auto& [center, radius] = spheres[i];
    const auto points = static_cast<int>(std::ceil(samples * radius * radius / area));
    for (int k = 0; k < points; ++k) {
      const double x = normal(random);
      const double y = normal(random);
      const double z = normal(random);
      const Vector3d point = center + radius * Vector3d(x, y, z).normalized();
      bool isInner = false;
      for (std::size_t j = 0; j < spheres.size() && !isInner; ++j)
        isInner = j != i && (point - spheres[j].center).norm() < spheres[j].radius;
      if (isInner) continue;
      const double weight = radius * radius / points;
      all += weight;
      sum += weight * std::max(0.0, -body.depth(point, false));
    }
  }
  return all > 0.0 ? sum / all : 0.0;
}

double volumeRatio(const PosedBody& body, std::span<const EnclosingSphere> spheres, int samples,
                   std::mt19937& random) {
  if (!body.hasInside()) return std::numeric_limits<double>::quiet_NaN();
  Vector3d lower = spheres.front().center;
  Vector3d upper = lower;
  for (const auto& [center, radius] : spheres) {
    lower = lower.cwiseMin(Vector3d(center.array() - radius));
    upper = upper.cwiseMax(Vector3d(center.array() + radius));
  }
  std::uniform_real_distribution<double> uniform;
  int inUnion = 0;
  int inBody = 0;
  for (int k = 0; k < samples; ++k) {
    Vector3d point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = lower[axis] + uniform(random) * (upper[axis] - lower[axis]);
    if (detail::outsideAll(point, spheres) <= 0.0) ++inUnion;
    if (body.contains(point)) ++inBody;
  }
  if (inBody == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(inUnion) / inBody;
}

}  // namespace

SphereExcess sphereExcess(std::span<const PosedShape> body,
                          std::span<const EnclosingSphere> spheres,
                          const SphereExcessOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return sphereExcess(body, spheres, options); });
  detail::requireSpheres(spheres);
  detail::requireSphereOption("samples", options.samples, 1.0);
  detail::requireSphereOption("tolerance", options.tolerance, 0.0, true);
  detail::requireSphereOption("mostDistances", options.mostDistances, 0.0);
  if (body.empty()) throw std::invalid_argument("a body without shapes has no excess");
  if (spheres.empty()) return {0.0, 0.0, 0.0, 0.0};
  const PosedBody shapes(body);
  ExcessSearch search(shapes, spheres);
  search.run(options.tolerance, options.mostDistances);
  std::mt19937 random(options.seed);
  const double mean = meanExcess(shapes, spheres, options.samples, random);
  const double ratio = volumeRatio(shapes, spheres, options.samples, random);
  return {search.seen(), search.largest(), mean, ratio};
}

}  // namespace swept
