// SPDX-License-Identifier: BSD-3-Clause
#include "acm/link_pieces.hpp"

#include <algorithm>

#include "swept/core/distance.hpp"

namespace swept::detail {

namespace {

/// m. A plane need not be nearer to the best one than this.
constexpr double kPlaneTolerance = 1e-5;

}  // namespace

LinkPieces piecesOf(const Robot& robot, const KinematicModel& model, int link) {
  LinkPieces result;
  for (const CollisionGeometry& geometry : robot.links()[link].collision) {
    const auto* mesh = std::get_if<TriangleMesh>(&geometry.shape);
    LinkPieces::Piece piece{geometry.shape, mesh ? Shape(mesh->hull()) : geometry.shape,
                            model.body_from_link[link] * geometry.link_from_shape,
                            boundingSphere(geometry.shape), -1};
    if (mesh != nullptr) result.sourceError = std::max(result.sourceError, mesh->sourceError());
    piece.ball.center = piece.body_from_shape * piece.ball.center;
    result.reach = std::max(result.reach, piece.ball.center.norm() + piece.ball.radius);
    if (geometry.cover) {
      const int first = static_cast<int>(result.balls.size());
      const int number = static_cast<int>(result.pieces.size());
      piece.root = first;
      for (const SphereCover::Node& node : geometry.cover->nodes)
        result.balls.push_back({piece.body_from_shape * node.ball.center.cast<double>(),
                                static_cast<double>(node.ball.radius), number,
                                first + node.firstChild, node.childCount});
    }
    result.pieces.push_back(std::move(piece));
  }
  return result;
}

LinkDistance linkDistance(const LinkPieces& a, const LinkPieces& b, const LinkChain::Place& place,
                          double enough, double contact) {
  const Eigen::Isometry3d a_from_b = place.base_from_a.inverse() * place.base_from_b;
  LinkDistance result;
  for (const LinkPieces::Piece& first : a.pieces) {
    const Eigen::Isometry3d shape_from_b = first.body_from_shape.inverse() * a_from_b;
    for (const LinkPieces::Piece& second : b.pieces) {
      const double coarse = (a_from_b * second.ball.center - first.ball.center).norm() -
                            first.ball.radius - second.ball.radius;
      DistanceOptions options;
      options.enough = std::min(enough, result.upper);
      options.contact = contact;
      if (coarse > options.enough) {
        result.lower = std::min(result.lower, coarse);
        continue;
      }
      const DistanceResult found =
          distance(first.shape, second.shape, shape_from_b * second.body_from_shape, options);
      ++result.computed;
      result.lower = std::min(result.lower, found.lower);
      result.upper = std::min(result.upper, found.upper);
      if (result.upper <= contact) return result;
    }
  }
  return result;
}

PiecePlane planeBetween(const LinkPieces::Piece& a, const LinkPieces::Piece& b,
                        const LinkChain::Place& place, double least) {
  const Eigen::Isometry3d base_from_first = place.base_from_a * a.body_from_shape;
  DistanceOptions options;
  options.contact = least;
  options.tolerance = std::max(least, kPlaneTolerance);
  const DistanceResult found = distance(
      a.hull, b.hull, base_from_first.inverse() * place.base_from_b * b.body_from_shape, options);
  if (!(found.normal.squaredNorm() > 0.5)) return {Eigen::Vector3d::Zero(), 0.0};
  return {base_from_first.linear() * found.normal, found.lower};
}

}  // namespace swept::detail
