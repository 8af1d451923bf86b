// SPDX-License-Identifier: BSD-3-Clause
#include "robot/shape_cover.hpp"

#include <variant>

namespace swept::detail {

namespace {

struct SameShape {
  const Shape& other;

  bool operator()(const Sphere& s) const { return s.radius == as<Sphere>().radius; }
  bool operator()(const Box& s) const { return s.halfExtents == as<Box>().halfExtents; }
  bool operator()(const Cylinder& s) const { return sameRound(s); }
  bool operator()(const Capsule& s) const { return sameRound(s); }
  bool operator()(const Cone& s) const { return sameRound(s); }
  bool operator()(const Ellipsoid& s) const { return s.semiAxes == as<Ellipsoid>().semiAxes; }
  bool operator()(const Triangle& s) const { return s.corners == as<Triangle>().corners; }
  /// Copies share their data.
  bool operator()(const ConvexHull& s) const {
    return &s.vertices() == &as<ConvexHull>().vertices();
  }
  bool operator()(const TriangleMesh& s) const {
    return &s.vertices() == &as<TriangleMesh>().vertices() &&
           s.sourceError() == as<TriangleMesh>().sourceError();
  }
  bool operator()(const PointCloud& s) const {
    return s.points().data() == as<PointCloud>().points().data();
  }
  bool operator()(const Plane&) const { return false; }
  bool operator()(const HalfSpace&) const { return false; }

 private:
  template <typename Same>
  const Same& as() const {
    return std::get<Same>(other);
  }
  template <typename Round>
  bool sameRound(const Round& s) const {
    return s.radius == as<Round>().radius && s.halfLength == as<Round>().halfLength;
  }
};

}  // namespace

bool areSame(const Shape& a, const Shape& b) {
  return a.index() == b.index() && std::visit(SameShape{b}, a);
}

bool isBounded(const Shape& shape) {
  return !std::holds_alternative<Plane>(shape) && !std::holds_alternative<HalfSpace>(shape);
}

std::shared_ptr<const SphereCover> coverOf(const Shape& shape) {
  if (!isBounded(shape)) return nullptr;
  return std::make_shared<const SphereCover>(
      sphereCover(shape, {.finestOverhang = kCoverOverhang,
                          .finestRelative = kCoverRelative,
                          .mostInnerBalls = kMostInnerBalls}));
}

}  // namespace swept::detail
