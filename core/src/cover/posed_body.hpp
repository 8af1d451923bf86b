// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <vector>

#include "cover/cells.hpp"
#include "cover/solid.hpp"
#include "swept/core/enclosing_spheres.hpp"

namespace swept::detail {

/// A part of a body in a box of one of its shapes.
struct BodyPiece {
  std::size_t shape = 0;
  Cell cell;  ///< in the shape's frame
  /// m, body frame; the body in the cell is in the hull of these, grown by `blur`.
  std::vector<Eigen::Vector3d> content;
  double blur = 0.0;
  Eigen::Vector3d middle;  ///< m
  double reach = 0.0;      ///< m, a ball around the middle that contains all of it

  /// m, radius of a ball around `center` that contains the piece, rounding included.
  double farthest(const Eigen::Vector3d& center) const;
};

/// The union of posed shapes, in the frame of their body.
///
/// Lemma (rounding): a corner is mapped to the body's frame with an error of at most 8 roundings of
/// its coordinates and the translation, and a distance computed with 8 of the coordinates. 1e-14 of
/// both, which is in `blur`, covers this. An affine map takes the hull of points to that of their
/// images.
class PosedBody {
 public:
  explicit PosedBody(std::span<const PosedShape> shapes);

  /// One piece for each shape.
  std::vector<BodyPiece> pieces();
  bool canSplit(const BodyPiece& piece) const;
  void split(const BodyPiece& piece, std::vector<BodyPiece>& out);

  std::size_t shapeCount() const { return parts_.size(); }
  const Solid& solid(std::size_t shape) const { return parts_[shape]->solid; }
  const Eigen::Isometry3d& pose(std::size_t shape) const { return parts_[shape]->body_from_shape; }
  bool hasInside() const;
  bool contains(const Eigen::Vector3d& p) const;  ///< sampled points only: not proven
  /// m. Lower bound: the ball of this radius is in one of the shapes, or (negative) some point of
  /// the body is this near. `pockets`: those count as filled, which is not proven.
  double depth(const Eigen::Vector3d& p, bool pockets) const;
  /// m: points of a piece's patches are at most this far from the shape, and those with a radius
  /// have at least `leastRadius`.
  double pointError(std::size_t shape) const;
  double leastRadius(std::size_t shape) const;

 private:
  struct Part {
    explicit Part(const PosedShape& posed);
    Solid solid;
    Cells cells;
    Eigen::Isometry3d body_from_shape, shape_from_body;
    double sourceError = 0.0;  ///< m
    double blur = 0.0;         ///< m
  };
  BodyPiece pieceOf(std::size_t shape, Cell cell);
  std::vector<std::unique_ptr<Part>> parts_;
};

}  // namespace swept::detail
