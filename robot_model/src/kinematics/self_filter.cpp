// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/self_filter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <variant>

#include "io/numbers.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/segment_query.hpp"

namespace swept {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Piece {
  const Shape& shape;
  Isometry3d shape_from_model;
  Aabb box;  ///< m, shape's frame, larger by the margin
};

struct PlacedLink {
  Aabb box;  ///< m, model frame, around all pieces, larger by the margin
  std::vector<Piece> pieces;
};

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("withoutRobot: " + what);
}

void requireState(const Robot& robot, std::span<const double> state) {
  if (state.size() != robot.variables().size()) {
    refuse("the state has " + std::to_string(state.size()) + " values instead of " +
           std::to_string(robot.variables().size()));
  }
  for (std::size_t v = 0; v < state.size(); ++v) {
    if (!std::isfinite(state[v])) refuse("'" + robot.variables()[v].name + "' is not finite");
  }
  for (const Joint& joint : robot.joints()) {
    if (joint.type != JointType::Floating) continue;
    const auto first = static_cast<std::size_t>(joint.firstVariable) + 3;
    const Eigen::Map<const Eigen::Vector4d> quaternion(&state[first]);
    if (!(quaternion.norm() > 1e-6)) {
      refuse("the quaternion of joint '" + joint.name + "' has no direction");
    }
  }
}

PlacedLink place(const Link& link, const Isometry3d& model_from_link, double margin) {
  PlacedLink placed;
  for (const CollisionGeometry& geometry : link.collision) {
    const Isometry3d model_from_shape = model_from_link * geometry.link_from_shape;
    const BoundingSphere ball = boundingSphere(geometry.shape);
    const Vector3d center = model_from_shape * ball.center;
    const Aabb box = Aabb{center, center}.inflated(ball.radius + margin);
    placed.box = placed.pieces.empty() ? box : Aabb::merge(placed.box, box);
    placed.pieces.push_back(
        {geometry.shape, model_from_shape.inverse(), boundingBox(geometry.shape).inflated(margin)});
  }
  return placed;
}

std::vector<PlacedLink> place(const Robot& robot, std::span<const double> state, double margin) {
  // A group that moves nothing: every link hangs on the model frame, at the state.
  const detail::KinematicModel model = detail::compileKinematics(
      robot, Group{},
      Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size())));
  std::vector<PlacedLink> links;
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    PlacedLink placed = place(robot.links()[i], model.body_from_link[i], margin);
    if (!placed.pieces.empty()) links.push_back(std::move(placed));
  }
  return links;
}

bool isWithin(const Piece& piece, const Vector3d& point, double margin) {
  const Vector3d local = piece.shape_from_model * point;
  if (!piece.box.contains(local)) return false;
  if (const auto* mesh = std::get_if<TriangleMesh>(&piece.shape)) {
    return pointWithin(*mesh, local, margin).has_value() || mesh->encloses(local);
  }
  static const Shape kPoint = Sphere{0.0};
  DistanceOptions options;
  options.enough = margin;
  options.contact = margin;
  const Isometry3d shape_from_point(Eigen::Translation3d{local});
  return distance(piece.shape, kPoint, shape_from_point, options).upper <= margin;
}

}  // namespace

std::vector<Vector3d> withoutRobot(std::span<const Vector3d> points, const Robot& robot,
                                   std::span<const double> state, double margin) {
  if (!(margin >= 0.0 && std::isfinite(margin))) {
    refuse("the margin is " + detail::formatNumber(margin) + "; it must be finite and at least 0");
  }
  requireState(robot, state);
  const std::vector<PlacedLink> links = place(robot, state, margin);
  const auto isRobot = [&](const Vector3d& point) {
    return std::ranges::any_of(links, [&](const PlacedLink& link) {
      return link.box.contains(point) && std::ranges::any_of(link.pieces, [&](const Piece& piece) {
               return isWithin(piece, point, margin);
             });
    });
  };
  std::vector<Vector3d> kept;
  std::ranges::remove_copy_if(points, std::back_inserter(kept), isRobot);
  return kept;
}

}  // namespace swept
