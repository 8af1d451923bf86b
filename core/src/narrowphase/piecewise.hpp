// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <limits>

#include "narrowphase/piece_pair.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// The goal of a search over the pieces of two bodies.
struct PieceGoal {
  /// Pieces apart by more than this are settled. One of the two is used.
  const ApproachBound* approach = nullptr;
  double enough = std::numeric_limits<double>::infinity();  ///< m
  double contact = 0.0;                                     ///< m, stop at points this close
  double tolerance = 0.0;                                   ///< m
  /// Search the pieces even if the hulls say that the motion bound is out of reach.
  bool thorough = true;
  /// Only the triangles of meshes count, not the space they enclose.
  bool surfaces = false;
};

struct PieceResult {
  bool satisfied = false;  ///< every pair of pieces is as far apart as the goal requires
  double lower = std::numeric_limits<double>::infinity();  ///< m, proven for all pieces
  double upper = std::numeric_limits<double>::infinity();  ///< m, witnessed
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of a single separating plane; zero if none
  Eigen::Vector3d hint = Eigen::Vector3d::Zero();    ///< best direction for a warm start
  int iterations = 0;
};

/// Branch and bound over pairs of pieces (hierarchy nodes, triangles, convex bodies), nearest
/// first, after a first test of the hulls. A solid that the other side encloses counts as contact.
PieceResult searchPieces(const Side& a, const Side& b, const Eigen::Isometry3d& a_from_b,
                         const Eigen::Vector3d& guess, const PieceGoal& goal);

}  // namespace swept::detail
