// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <span>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "swept/core/shapes.hpp"

#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

using Eigen::Vector3d;

/// Grows sizes and moves points away from a middle.
struct Scaling {
  double factor;
  Vector3d middle;  ///< m

  Vector3d operator()(const Vector3d& point) const { return middle + factor * (point - middle); }
  std::vector<Vector3d> operator()(std::span<const Vector3d> points) const {
    std::vector<Vector3d> moved;
    moved.reserve(points.size());
    for (const Vector3d& point : points) moved.push_back((*this)(point));
    return moved;
  }

  Shape of(const Sphere& s) const { return makeSphere(factor * s.radius); }
  Shape of(const Box& s) const { return makeBox(2.0 * factor * s.halfExtents); }
  Shape of(const Cylinder& s) const {
    return makeCylinder(factor * s.radius, 2.0 * factor * s.halfLength);
  }
  Shape of(const Capsule& s) const {
    return makeCapsule(factor * s.radius, 2.0 * factor * s.halfLength);
  }
  Shape of(const Cone& s) const { return makeCone(factor * s.radius, 2.0 * factor * s.halfLength); }
  Shape of(const Ellipsoid& s) const { return makeEllipsoid(factor * s.semiAxes); }
  Shape of(const Triangle& s) const {
    return makeTriangle((*this)(s.corners[0]), (*this)(s.corners[1]), (*this)(s.corners[2]));
  }
  Shape of(const ConvexHull& s) const { return ConvexHull::scaled(s, factor, middle); }
  Shape of(const TriangleMesh& s) const {
    return TriangleMesh::build((*this)(s.vertices()), s.triangles(), s.interior(), 0.0)
        .withSourceError(factor * s.sourceError());
  }
  Shape of(const PointCloud& s) const {
    std::vector<double> radii;
    for (std::size_t i = 0; i < s.points().size(); ++i) radii.push_back(factor * s.radius(i));
    return PointCloud::build((*this)(s.points()), radii);
  }
  Shape of(const Plane& s) const { return s; }
  Shape of(const HalfSpace& s) const { return s; }
};

}  // namespace

Shape scaled(const Shape& shape, double factor) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, factor] { return scaled(shape, factor); });
  }
  if (!(factor > 0.0) || !std::isfinite(factor)) {
    std::ostringstream message;
    message << "scaled: the factor is " << factor << "; allowed: finite and above zero";
    throw std::invalid_argument(message.str());
  }
  const Aabb box = boundingBox(shape);
  // Also for boxes that span more than half of the range of doubles.
  const Scaling scaling{factor, 0.5 * box.lower + 0.5 * box.upper};
  return std::visit([&](const auto& s) { return scaling.of(s); }, shape);
}

}  // namespace swept
