// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include "cover/convex_field.hpp"
#include "cover/posed_body.hpp"
#include "cover/sphere_checks.hpp"
#include "cover/stopping.hpp"
#include "swept/core/enclosing_shapes.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

using detail::ConvexField;
using detail::PosedBody;
using Eigen::Vector3d;

/// The distance from the body is 1-Lipschitz: over a cube it is at most that of its middle and half
/// its diagonal. The cube with the largest bound is divided, and dropped when it is not on the
/// surface of the union.
class ExcessSearch {
 public:
  ExcessSearch(const PosedBody& body, std::span<const ConvexField> fields)
      : body_(body), fields_(fields) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const ConvexField& field = fields[i];
      // A point of the shape is at most this far from the ball of the body around its centre.
      const double most = field.reach() - body_.depth(field.center(), false) + roundingOf(field);
      add({std::max(most, 0.0), field.center(), field.reach(), i});
    }
  }

  void run(const SphereExcessOptions& options) {
    int distances = 0;
    while (!cubes_.empty() && distances + 8 <= options.mostDistances) {
      detail::throwIfStopped(options.stop);
      if (!(cubes_.front().bound > (1.0 + options.tolerance) * seen_ + 1e-7)) return;
      std::pop_heap(cubes_.begin(), cubes_.end(), less);
      const Cube top = cubes_.back();
      cubes_.pop_back();
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                            (corner & 4) != 0 ? 1.0 : -1.0);
        Cube part{top.bound, top.middle + 0.5 * top.half * sign, 0.5 * top.half, top.field};
        if (!meetsSurface(part)) continue;
        ++distances;
        const double here = std::max(0.0, -body_.depth(part.middle, false));
        part.bound = std::min(top.bound, here + diagonal(part) + roundingOf(fields_[part.field]));
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
    double half;        ///< m, of an edge
    std::size_t field;  ///< only the surface of this shape counts
  };
  static bool less(const Cube& a, const Cube& b) { return a.bound < b.bound; }
  static double diagonal(const Cube& cube) { return 1.7320508075688774 * cube.half; }
  static double roundingOf(const ConvexField& field) {
    return 1e-12 * (field.center().lpNorm<Eigen::Infinity>() + field.reach());
  }

  void add(const Cube& cube) {
    cubes_.push_back(cube);
    std::push_heap(cubes_.begin(), cubes_.end(), less);
  }

  /// Not if it is off the shape, or in some shape: then it is not on the surface of the union.
  bool meetsSurface(const Cube& cube) const {
    if (fields_[cube.field].missesCube(cube.middle, cube.half)) return false;
    return std::ranges::none_of(fields_, [&](const ConvexField& field) {
      return field.containsCube(cube.middle, cube.half);
    });
  }

  void see(const Cube& cube) {
    const ConvexField& own = fields_[cube.field];
    Vector3d point = cube.middle;
    for (int step = 0; step < kSteps; ++step) point -= own.value(point) * own.outward(point);
    if (!(std::abs(own.value(point)) <= 1e-9 * own.reach())) return;
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (i != cube.field && fields_[i].value(point) < 0.0) return;
    seen_ = std::max(seen_, -body_.depth(point, false));
  }

  static constexpr int kSteps = 3;  // one does, but near edges
  const PosedBody& body_;
  std::span<const ConvexField> fields_;
  std::vector<Cube> cubes_;  ///< a heap
  double seen_ = 0.0;        ///< m
};

double meanExcess(const PosedBody& body, std::span<const ConvexField> fields,
                  const SphereExcessOptions& options, std::mt19937& random) {
  double area = 0.0;
  for (const ConvexField& field : fields) area += field.area();
  double sum = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto points = static_cast<int>(std::ceil(options.samples * fields[i].area() / area));
    for (int k = 0; k < points; ++k) {
      detail::throwIfStopped(options.stop);
      const Vector3d point = fields[i].pointOfSurface(random);
      bool isInner = false;
      for (std::size_t j = 0; j < fields.size() && !isInner; ++j)
        isInner = j != i && fields[j].value(point) < 0.0;
      if (isInner) continue;
      const double weight = fields[i].area() / points;
      all += weight;
      sum += weight * std::max(0.0, -body.depth(point, false));
    }
  }
  return all > 0.0 ? sum / all : 0.0;
}

double volumeRatio(const PosedBody& body, std::span<const ConvexField> fields,
                   const SphereExcessOptions& options, std::mt19937& random) {
  if (!body.hasInside()) return std::numeric_limits<double>::quiet_NaN();
  Eigen::AlignedBox3d box;
  for (const ConvexField& field : fields) box.extend(field.box());
  std::uniform_real_distribution<double> uniform;
  int inUnion = 0;
  int inBody = 0;
  for (int k = 0; k < options.samples; ++k) {
    detail::throwIfStopped(options.stop);
    Vector3d point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = box.min()[axis] + uniform(random) * box.sizes()[axis];
    if (detail::outsideAll(point, fields) <= 0.0) ++inUnion;
    if (body.contains(point)) ++inBody;
  }
  if (inBody == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(inUnion) / inBody;
}

}  // namespace

SphereExcess detail::fieldsExcess(std::span<const PosedShape> body,
                                  std::span<const ConvexField> fields,
                                  const SphereExcessOptions& options) {
  requireSphereOption("samples", options.samples, 1.0);
  requireSphereOption("tolerance", options.tolerance, 0.0, true);
  requireSphereOption("mostDistances", options.mostDistances, 0.0);
  if (body.empty()) throw std::invalid_argument("a body without shapes has no excess");
  if (fields.empty()) return {0.0, 0.0, 0.0, 0.0};
  const PosedBody shapes(body);
  ExcessSearch search(shapes, fields);
  search.run(options);
  std::mt19937 random(options.seed);
  const double mean = meanExcess(shapes, fields, options, random);
  const double ratio = volumeRatio(shapes, fields, options, random);
  return {search.seen(), search.largest(), mean, ratio};
}

SphereExcess sphereExcess(std::span<const PosedShape> body,
                          std::span<const EnclosingSphere> spheres,
                          const SphereExcessOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return sphereExcess(body, spheres, options); });
  detail::requireSpheres(spheres);
  return detail::fieldsExcess(body, detail::fieldsOf(spheres), options);
}

SphereExcess shapesExcess(std::span<const PosedShape> body, std::span<const PosedShape> shapes,
                          double growth, const SphereExcessOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return shapesExcess(body, shapes, growth, options); });
  return detail::fieldsExcess(body, detail::fieldsOf(shapes, growth), options);
}

}  // namespace swept
