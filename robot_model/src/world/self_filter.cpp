// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/self_filter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <variant>

#include "kinematics/full_state.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/segment_query.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Piece {
  const Shape& shape;
  Isometry3d shape_from_model;
  Aabb box;  ///< m, shape's frame
};

struct PlacedLink {
  Aabb box;  ///< m, model frame, around all pieces
  std::vector<Piece> pieces;
};

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("withoutRobot: " + what);
}

PlacedLink place(const Link& link, const Isometry3d& model_from_link) {
  PlacedLink placed;
  for (const CollisionGeometry& geometry : link.collision) {
    const Isometry3d model_from_shape = model_from_link * geometry.link_from_shape;
    const BoundingSphere ball = boundingSphere(geometry.shape);
    const Vector3d center = model_from_shape * ball.center;
    const Aabb box = Aabb{center, center}.inflated(ball.radius);
    placed.box = placed.pieces.empty() ? box : Aabb::merge(placed.box, box);
    placed.pieces.push_back(
        {geometry.shape, model_from_shape.inverse(), boundingBox(geometry.shape)});
  }
  return placed;
}

bool isWithin(const Piece& piece, const Vector3d& point, double reach) {
  const Vector3d local = piece.shape_from_model * point;
  if (!piece.box.inflated(reach).contains(local)) return false;
  if (const auto* mesh = std::get_if<TriangleMesh>(&piece.shape)) {
    return pointWithin(*mesh, local, reach).has_value() || mesh->encloses(local);
  }
  static const Shape kPoint = Sphere{0.0};
  DistanceOptions options;
  options.enough = reach;
  options.contact = reach;
  const Isometry3d shape_from_point(Eigen::Translation3d{local});
  return distance(piece.shape, kPoint, shape_from_point, options).upper <= reach;
}

/// The robot's geometry at its observed pose.
class PlacedRobot {
 public:
  PlacedRobot(const Robot& robot, std::span<const double> state, double margin) {
    if (!(margin >= 0.0 && std::isfinite(margin))) {
      refuse("the margin is " + detail::formatNumber(margin) +
             "; it must be finite and at least 0");
    }
    const auto size = static_cast<Eigen::Index>(state.size());
    detail::requireFullState(robot, Eigen::Map<const Eigen::VectorXd>(state.data(), size),
                             "withoutRobot", "the state");
    // A group that moves nothing: every link is fixed to the model frame, at the state.
    const detail::KinematicModel model = detail::compileKinematics(
        robot, Group{},
        Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size())));
    for (std::size_t i = 0; i < robot.links().size(); ++i) {
      PlacedLink placed = place(robot.links()[i], model.body_from_link[i]);
      if (!placed.pieces.empty()) links_.push_back(std::move(placed));
    }
  }

  /// Whether some of it is within `reach` (m) of the point.
  bool isNear(const Vector3d& point, double reach) const {
    return std::ranges::any_of(links_, [&](const PlacedLink& link) {
      return link.box.inflated(reach).contains(point) &&
             std::ranges::any_of(link.pieces,
                                 [&](const Piece& piece) { return isWithin(piece, point, reach); });
    });
  }

 private:
  std::vector<PlacedLink> links_;
};

/// Divides cubes of a map where they come near the robot.
class CubeFilter {
 public:
  CubeFilter(const PlacedRobot& robot, const Isometry3d& world_from_map, double margin,
             OccupancyMap& kept)
      : robot_(robot), world_from_map_(world_from_map), margin_(margin), kept_(kept) {}

  void add(const OccupancyMap::Cube& cube) { addPart(cube, Vector3d::Zero(), 1.0); }

 private:
  /// `middle` and `share`: of the part, in sides of the cube. All parts are rounded only once.
  void addPart(const OccupancyMap::Cube& cube, const Vector3d& middle, double share) {
    if (++parts_ > kMostParts) {
      refuse("cubes near the robot have more than " + std::to_string(kMostParts) +
             " parts at a resolution of " + detail::formatNumber(kept_.resolution) + " m");
    }
    const OccupancyMap::Cube part{.center = cube.center + cube.side * middle,
                                  .side = cube.side * share};
    const Vector3d center = world_from_map_ * part.center;
    const bool smallest = !(part.side > 1.5 * kept_.resolution);
    const double halfDiagonal = smallest ? 0.0 : 0.5 * std::sqrt(3.0) * part.side;
    if (!robot_.isNear(center, margin_ + halfDiagonal)) {
      kept_.occupied.push_back(part);
      return;
    }
    // All points of a part that is removed as a whole are within the margin.
    if (smallest || (margin_ >= halfDiagonal && robot_.isNear(center, margin_ - halfDiagonal)))
      return;
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d signs((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                           (corner & 4) != 0 ? 1.0 : -1.0);
      addPart(cube, middle + 0.25 * share * signs, 0.5 * share);
    }
  }

  /// A cube of an OctoMap may be 65 536 of its smallest ones wide.
  static constexpr int kMostParts = 10'000'000;

  const PlacedRobot& robot_;
  const Isometry3d& world_from_map_;
  double margin_;
  OccupancyMap& kept_;
  int parts_ = 0;  ///< parts tested
};

}  // namespace

std::vector<Vector3d> withoutRobot(std::span<const Vector3d> points, const Robot& robot,
                                   ConfigurationView state, double margin) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, points, state, margin] { return withoutRobot(points, robot, state, margin); });
  }
  const PlacedRobot placed(robot, state, margin);
  std::vector<Vector3d> kept;
  std::ranges::remove_copy_if(points, std::back_inserter(kept),
                              [&](const Vector3d& point) { return placed.isNear(point, margin); });
  return kept;
}

Balls ballsWithoutRobot(const Balls& balls, const Robot& robot, ConfigurationView state,
                        double margin) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, state, margin] { return ballsWithoutRobot(balls, robot, state, margin); });
  }
  if (balls.centers.size() != balls.radii.size()) {
    refuse(std::to_string(balls.centers.size()) + " balls have " +
           std::to_string(balls.radii.size()) + " radii");
  }
  const PlacedRobot placed(robot, state, margin);
  Balls kept;
  for (std::size_t i = 0; i < balls.centers.size(); ++i) {
    if (placed.isNear(balls.centers[i], margin + balls.radii[i])) continue;
    kept.centers.push_back(balls.centers[i]);
    kept.radii.push_back(balls.radii[i]);
  }
  return kept;
}

OccupancyMap mapWithoutRobot(const OccupancyMap& map, const Isometry3d& world_from_map,
                             const Robot& robot, ConfigurationView state, double margin) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, state, margin] { return mapWithoutRobot(map, world_from_map, robot, state, margin); });
  }
  if (!(map.resolution > 0.0)) {
    refuse("the map's resolution is " + detail::formatNumber(map.resolution) +
           "; it must be above 0");
  }
  const PlacedRobot placed(robot, state, margin);
  OccupancyMap kept{.resolution = map.resolution, .occupied = {}};
  CubeFilter filter(placed, world_from_map, margin, kept);
  for (const OccupancyMap::Cube& cube : map.occupied) filter.add(cube);
  return kept;
}

}  // namespace swept
