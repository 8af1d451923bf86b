// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <span>
#include <vector>

#include "cover/posed_body.hpp"
#include "swept/core/enclosing_shapes.hpp"

namespace swept::detail {

/// The tree of shapes around the pieces of a body, by which EnclosingShapesSearch finds few.
class ShapeFit {
 public:
  ShapeFit(std::span<const PosedShape> body, EnclosingKind kind,
           const EnclosingShapesOptions& options, const StopQuestion& stop);

  int countFor(double reach) const { return static_cast<int>(cut(reach).size()); }
  double reachFor(int count) const;
  EnclosingShapes atMost(int count, const StopQuestion& stop);
  EnclosingShapes within(double reach, const StopQuestion& stop);

 private:
  using Pieces = std::vector<const BodyPiece*>;
  struct Node {
    int left = -1, right = -1;            ///< -1: a single piece
    Pieces pieces;                        ///< in it
    std::vector<Eigen::Vector3d> points;  ///< m; about the corners of the hull of their content
    double blur = 0.0;                    ///< m, around the points
    Eigen::AlignedBox3d box;
    PosedShape shape;  ///< contains the points and their blur, up to rounding
    double reach = 0.0;
    bool joined = false;
  };
  struct Shaped {
    PosedShape shape;
    Pieces pieces;
    double reach;  ///< m
  };

  void divide(int pieces);
  bool divideFurther();
  void findFrames(std::span<const PosedShape> body);
  double addPoints(const BodyPiece& piece, std::vector<Eigen::Vector3d>& points) const;
  Node leafOf(const BodyPiece& piece) const;
  Node joinOf(int a, int b) const;
  void fit(Node& node, const ConvexHull& hull) const;  ///< `hull`: of its points
  void agglomerate();
  std::vector<int> neighboursOf(int node) const;
  double reachOf(const PosedShape& shape) const;

  /// Indices of the fewest nodes that hold all pieces and reach no farther, where pieces do not.
  std::vector<int> cut(double reach) const;
  Shaped measured(const Eigen::Matrix3d& axes, Pieces pieces) const;
  PosedShape roomyAround(const Pieces& pieces) const;
  /// `divided` keeps the parts of pieces that it makes.
  bool shrink(Shaped& shaped, std::vector<Shaped>& all, std::deque<BodyPiece>& divided);
  EnclosingShapes finished(const std::vector<int>& nodes);

  std::vector<PosedShape> source_;
  EnclosingKind kind_;
  StopQuestion stop_;  ///< of the present call
  PosedBody body_;
  double size_ = 0.0;  ///< m
  std::deque<BodyPiece> pieces_;
  std::vector<Eigen::Matrix3d> frames_;  ///< of the body's shapes and axes
  std::vector<Node> nodes_;              ///< the last one has all pieces
};

}  // namespace swept::detail
