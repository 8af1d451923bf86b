// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/simd_hulls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

constexpr int kSides = 24;

struct Grown {
  std::vector<Vector3d> points;
  double radius = 0.0;
  bool ofGeometry = false;
};

/// Corners of a polygon around a circle, orthogonal to z.
void addCircle(double radius, double z, std::vector<Vector3d>& points) {
  const double outer = radius / std::cos(std::numbers::pi / kSides) * kArithmeticOutward;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    points.emplace_back(outer * std::cos(angle), outer * std::sin(angle), z);
  }
}

struct GrownHull {
  Grown operator()(const Sphere& sphere) const { return {{Vector3d::Zero()}, sphere.radius}; }
  Grown operator()(const Box& box) const {
    Grown result;
    result.ofGeometry = true;
    for (int i = 0; i < 8; ++i)
      result.points.push_back(box.halfExtents.cwiseProduct(Vector3d(
          (i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0)));
    return result;
  }
  Grown operator()(const Cylinder& cylinder) const {
    Grown result;
    addCircle(cylinder.radius, cylinder.halfLength, result.points);
    addCircle(cylinder.radius, -cylinder.halfLength, result.points);
    return result;
  }
  Grown operator()(const Capsule& capsule) const {
    return {{Vector3d(0.0, 0.0, capsule.halfLength), Vector3d(0.0, 0.0, -capsule.halfLength)},
            capsule.radius};
  }
  Grown operator()(const Cone& cone) const {
    Grown result;
    addCircle(cone.radius, -cone.halfLength, result.points);
    result.points.emplace_back(0.0, 0.0, cone.halfLength);
    return result;
  }
  Grown operator()(const Triangle& triangle) const {
    return {{triangle.corners.begin(), triangle.corners.end()}, 0.0, true};
  }
  /// More points than a coarser hull has would take longer than exact geometry.
  Grown operator()(const ConvexHull& hull) const { return ofCoarse(ConvexHull::coarser(hull)); }
  Grown operator()(const TriangleMesh& mesh) const { return ofCoarse(mesh.coarseHull()); }
  static Grown ofCoarse(const ConvexHull& hull) { return {hull.vertices(), hull.error(), true}; }
  template <typename Other>
  Grown operator()(const Other&) const {
    return {};
  }
};

}  // namespace

void SimdHulls::add(const Shape& shape, const Eigen::Isometry3d& body_from_shape,
                    const Eigen::Matrix3d& bodyFromLane, const RestArms& armsOfPath,
                    bool growsByAll) {
  const Grown grown = std::visit(GrownHull(), shape);
  SimdHull hull;
  hull.first = static_cast<std::int32_t>(points.size());
  hull.growsByAll = growsByAll;
  hull.firstArm = static_cast<std::int32_t>(arms.size());
  for (const double arm : armsOfPath.arms) arms.push_back(static_cast<float>(arm * kArmOutward));
  hull.firstGrowth = static_cast<std::int32_t>(growths.size());
  hull.growthCount = static_cast<std::int32_t>(armsOfPath.growths.size());
  for (const RestArms::Growth& growth : armsOfPath.growths)
    growths.push_back({static_cast<std::int32_t>(growth.joint), growth.slide,
                       static_cast<float>(growth.share * kArmOutward)});
  hull.count = static_cast<std::int32_t>(grown.points.size());
  if (grown.radius > 0.0) hull.radius = std::nextafter(static_cast<float>(grown.radius), 1e30F);
  hull.ofGeometry = grown.ofGeometry;
  for (std::size_t i = 0; i < grown.points.size(); i += kLanes) {
    Points& eight = points.emplace_back();
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t at = std::min(i + lane, grown.points.size() - 1);
      inBody.push_back(body_from_shape * grown.points[at]);
      const Vector3d moved = bodyFromLane.transpose() * inBody.back();
      eight.x.lane[lane] = static_cast<float>(moved.x());
      eight.y.lane[lane] = static_cast<float>(moved.y());
      eight.z.lane[lane] = static_cast<float>(moved.z());
    }
  }
  of.push_back(hull);
}

}  // namespace swept::detail
