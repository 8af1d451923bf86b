// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "bvh/box_bounds.hpp"
#include "bvh/box_frames.hpp"
#include "bvh/wide_bvh.hpp"
#include "mesh/enclosing_parts.hpp"
#include "narrowphase/convex.hpp"
#include "swept/core/point_cloud.hpp"
#include "swept/core/shapes.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept::detail {

/// One side of a pair: a convex body, or a mesh or cloud seen through its hierarchy.
struct Side {
  const TriangleMesh* mesh = nullptr;
  const PointCloud* cloud = nullptr;
  const WideBvh* bvh = nullptr;  ///< of the mesh or cloud; null: `convex` is the whole body
  Convex convex;                 ///< of a mesh or cloud: its hull
  Convex outer;                  ///< of a mesh or cloud: around its hull, of few points
  double concavity = 0.0;        ///< m, estimate of how far `outer` reaches beyond the body
  const EnclosingParts* parts = nullptr;  ///< of a mesh; null: none are known

  bool isConvex() const { return bvh == nullptr; }
  /// A convex body around the side that is quick to test: itself if it is convex.
  const Convex& around() const { return isConvex() ? convex : outer; }
  static Side of(const Shape& shape);
};

/// A piece of a side: a node of its hierarchy, a primitive (triangle, point), or the whole convex
/// body.
struct Piece {
  int node = -1;       ///< of the hierarchy
  int primitive = -1;  ///< of the mesh or cloud
  int place = -1;      ///< of the box in the hierarchy; -1: of the root or the convex body
  OrientedBox box;     ///< m, in the side's frame; of a convex body: of its core

  bool isLeaf() const { return node < 0; }
  bool isWhole() const { return node < 0 && primitive < 0; }  ///< the whole convex body
};

/// The hierarchies of two sides, placed relative to each other, and bounds between their pieces.
class PiecePair {
 public:
  using Bounds = std::array<float, WideNode::kLanes>;

  PiecePair(const Side& a, const Side& b, const Eigen::Isometry3d& a_from_b);

  Piece rootA() const { return rootOf(a_); }
  Piece rootB() const { return rootOf(b_); }
  static Piece rootOf(const Side& side);
  /// m. Upper bound on the 1-norm of a side's points, in its frame.
  static double reachOf(const Side& side);

  /// The node whose children are tested next: that of the larger piece, in the hierarchy or made in
  /// `room`. At most one of the two is a leaf.
  struct Split {
    bool ofA;
    int index;  ///< in the hierarchy
    const WideNode* node;
  };
  /// Whether it belongs to a. At most one of the two is a leaf.
  static bool isLarger(const Piece& a, const Piece& b);
  Split split(const Piece& a, const Piece& b, WideNode& room) const;

  /// m. Lower bounds on the distances between the children of a node and a piece of the other side;
  /// beyond `enough` they need not be exact.
  /// `directions`: null, or receives the direction of each bound, in the frame of the node's side.
  void boundChildren(const Split& split, const Piece& other, double enough, Bounds& lower,
                     BoxDirections* directions = nullptr) const;

  /// A direction (unit, a's frame, from a to b) along which a child and a piece of the other side
  /// are apart, and their proven separation (m); not positive: none found.
  BoxGap gap(const Piece& child, bool ofA, const Piece& other) const;
  /// The same along this direction from boundChildren().
  BoxGap gap(const Piece& child, bool ofA, const Piece& other, const Eigen::Vector3d& along) const;

  static Piece child(const Split& split, int lane) {
    const std::int32_t at = split.node->child[lane];
    return {at < 0 ? -1 : at, at < 0 ? ~at : -1, placeOf(split, lane), split.node->box(lane)};
  }
  static int placeOf(const Split& split, int lane) { return split.index * WideNode::kLanes + lane; }
  /// The piece of a side with this place.
  Piece piece(bool ofA, int place) const;

  /// Two leaves as convex bodies, each about its own centre so that rounding loses little. It
  /// cannot be moved: the bodies refer to its corners.
  struct Leaves {
    TriangleCorners cornersA;  ///< m, relative to centerA, of a triangle
    TriangleCorners cornersB;
    Eigen::Vector3d centerA = Eigen::Vector3d::Zero();  ///< m, a's frame
    Convex a;
    Convex b;
    Eigen::Isometry3d a_from_b;
  };
  void place(const Piece& pieceA, const Piece& pieceB, Leaves& leaves) const;

  /// The box of a piece of one side, about its centre, and the convex body on the other side. It
  /// cannot be moved.
  struct BoxAndBody {
    std::array<Eigen::Vector3d, 8> corners;  ///< m, relative to the box's centre
    Convex box;
    Convex body;
    Eigen::Isometry3d a_from_b;
  };
  void place(const Piece& piece, bool ofA, BoxAndBody& pair) const;

  /// Whether the box of a convex body says clearly less about distances than the body.
  static bool hasCoarseBox(const Convex& body);

  bool areTriangles(const Piece& pieceA, const Piece& pieceB) const {
    return a_.mesh != nullptr && b_.mesh != nullptr && pieceA.primitive >= 0 &&
           pieceB.primitive >= 0;
  }
  /// Of a triangle of b in a's frame.
  TriangleCorners movedCorners(int triangle) const;
  /// m. Upper bound on the rounding of b's points in a's frame.
  double rounding() const { return rounding_; }

 private:
  bool hasGaps(bool ofA, const Piece& other) const;
  BoxGap ofBodies(BoxGap gap, bool ofA, const Piece& other) const;
  static Eigen::Vector3d placeOne(const Side& side, const Piece& piece, TriangleCorners& corners,
                                  Convex& body);
  float boundAgainstFlat(const OrientedBox& box, bool ofA) const;

  const Side& a_;
  const Side& b_;
  const Eigen::Isometry3d& a_from_b_;
  BoxFrames frames_;
  BoxFrames back_;
  double rounding_;
};

TriangleCorners cornersOf(const TriangleMesh& mesh, int triangle);

}  // namespace swept::detail
