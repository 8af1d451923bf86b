// SPDX-License-Identifier: BSD-3-Clause
#include "certify/simd_witness.hpp"

#include "swept/core/distance.hpp"

namespace swept::detail {

std::optional<Eigen::Vector3d> commonPoint(const CheckerModel& model, const SimdContact& contact) {
  const GeometryPair& pair = model.pairs[contact.pair];
  const Eigen::Vector3d point(contact.point[0], contact.point[1], contact.point[2]);
  if (pair.self) return point;
  // The link holds everything within `inside` of the point, whatever rounding there was.
  const WorldGeometry& world = model.worldGeometry[pair.b];
  DistanceOptions options;
  options.contact = static_cast<double>(contact.inside);
  const Eigen::Isometry3d point_from_world(Eigen::Translation3d(-point));
  const DistanceResult found =
      distance(Sphere{0.0}, world.shape, point_from_world * world.world_from_shape, options);
  if (!(found.upper <= options.contact)) return std::nullopt;
  if (!(found.upper > 0.0)) return point;
  return Eigen::Vector3d(point + found.pointB);
}

std::optional<Witness> pointWitness(const CheckerModel& model, std::uint32_t index,
                                    const Eigen::Vector3d& point, double t) {
  const GeometryPair& pair = model.pairs[index];
  const WorldGeometry& world = model.worldGeometry[pair.b];
  const Eigen::Isometry3d point_from_world(Eigen::Translation3d(-point));
  DistanceOptions options;
  options.contact = pair.margin;
  const DistanceResult found =
      distance(Sphere{0.0}, world.shape, point_from_world * world.world_from_shape, options);
  if (!(found.upper <= pair.margin)) return std::nullopt;
  Witness witness;
  witness.t = t;
  witness.bodyA = model.nameOfA(pair);
  witness.bodyB = model.nameOfB(pair);
  witness.selfPair = model.isSelfPair(pair);
  witness.pointA = point;
  witness.pointB = point + found.pointB;
  witness.distance = found.upper;
  witness.margin = pair.margin;
  return witness;
}

std::optional<Witness> simdWitness(const CheckerModel& model, const SimdContact& contact,
                                   double t) {
  const std::optional<Eigen::Vector3d> point = commonPoint(model, contact);
  if (!point) return std::nullopt;
  const GeometryPair& pair = model.pairs[contact.pair];
  Witness witness;
  witness.t = t;
  witness.bodyA = model.nameOfA(pair);
  witness.bodyB = model.nameOfB(pair);
  witness.selfPair = model.isSelfPair(pair);
  witness.pointA = *point;
  witness.pointB = *point;
  witness.margin = pair.margin;
  return witness;
}

}  // namespace swept::detail
