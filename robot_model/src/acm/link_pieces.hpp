// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "acm/link_chain.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// A link's collision geometry in its body's frame, with all balls of its covers in one list.
struct LinkPieces {
  struct Piece {
    Shape shape;
    Shape hull;  ///< of the shape, if that is a mesh; else the shape itself
    Eigen::Isometry3d body_from_shape;
    BoundingSphere ball;  ///< body frame
    int root = -1;        ///< first ball of its cover; -1: it has none
  };
  struct Ball {
    Eigen::Vector3d center;  ///< m, body frame
    double radius;           ///< m
    int piece;
    int firstChild;  ///< children are consecutive
    int childCount;  ///< 0: a leaf
  };
  std::vector<Piece> pieces;
  std::vector<Ball> balls;
  double reach = 0.0;        ///< m, no point is farther from the body's origin
  double sourceError = 0.0;  ///< m, the largest of its meshes (TriangleMesh::sourceError)

  /// Each piece has a cover.
  bool covered() const {
    return std::ranges::all_of(pieces, [](const Piece& piece) { return piece.root >= 0; });
  }
};

LinkPieces piecesOf(const Robot& robot, const KinematicModel& model, int link);

/// Least distance of two links at one place of the chain, as an interval.
struct LinkDistance {
  double lower = std::numeric_limits<double>::infinity();  ///< m
  double upper = std::numeric_limits<double>::infinity();  ///< m
  int computed = 0;                                        ///< pieces compared on exact geometry
};
/// Skips pieces that are proven farther than `enough`, and everything once two points at most
/// `contact` apart are known (m).
LinkDistance linkDistance(const LinkPieces& a, const LinkPieces& b, const LinkChain::Place& place,
                          double enough, double contact);

/// A plane between two pieces at one place of the chain: n . (b - a) >= gap for all points a of the
/// first and b of the second, proven for the rounded poses.
struct PiecePlane {
  Eigen::Vector3d normal;  ///< unit, base frame
  double gap;              ///< m; not positive: none is known
};
/// Gives up if two points at most `least` apart (m) are known.
PiecePlane planeBetween(const LinkPieces::Piece& a, const LinkPieces::Piece& b,
                        const LinkChain::Place& place, double least);

}  // namespace swept::detail
