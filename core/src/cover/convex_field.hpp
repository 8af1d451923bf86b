// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <span>
#include <vector>

#include "cover/posed_body.hpp"
#include "swept/core/enclosing_shapes.hpp"

namespace swept::detail {

/// A function of points that tells whether they are in a shape: convex, 1-Lipschitz, at most 0 in
/// the shape and nowhere else. For spheres, boxes, capsules and cylinders it is the signed
/// distance, for hulls and meshes the largest distance from the plane of a face, to its front.
/// Being convex, and 1-Lipschitz, it is at most -b at points p only if their hull grown by b is in
/// the shape.
///
/// Lemma (faces). Let a closed surface of triangles be seen from a point c with all of its
/// triangles turned away: n . (v - c) > 0 for the outward normal n and a corner v of each. Then
/// each ray from c meets a triangle. Let x be outside of what is enclosed: then the segment from c
/// to x meets a triangle at some y before it ends, and n . x > n . y. So if n . x <= n . y for all
/// triangles, x is inside. The computed normal of a triangle with the longest side L and area A is
/// off by less than 8 u L^2 / (2 A), so n . y differs from n . v by up to that times L over the
/// triangle: each plane is moved inward by it. If some triangle is then not turned away from c,
/// nothing is known to be inside, and the function is infinite. What is enclosed may reach beyond
/// the planes, by that and, unless it is convex, by as much as its vertices do (missesCube()).
class ConvexField {
 public:
  explicit ConvexField(const EnclosingSphere& sphere);
  /// Throws std::invalid_argument for shapes that outsideShapes() does not take. `growth`: m.
  explicit ConvexField(const PosedShape& posed, double growth = 0.0);

  double value(const Eigen::Vector3d& p) const;     ///< m
  double rounding(const Eigen::Vector3d& p) const;  ///< m, bound on the error of value(p)
  /// Unit vector along which value() grows at p.
  Eigen::Vector3d outward(const Eigen::Vector3d& p) const;
  /// m. Upper bound on value() over the piece, rounding included: 0 or less, it is in the shape.
  double over(const BodyPiece& piece) const;
  ///@{
  /// Proven, of a cube with edges of 2 `half` (m) along the axes.
  bool containsCube(const Eigen::Vector3d& middle, double half) const;
  bool missesCube(const Eigen::Vector3d& middle, double half) const;
  ///@}
  /// Whether any point is known to be in the shape.
  bool hasInside() const { return closed_; }
  const Eigen::Vector3d& center() const { return center_; }  ///< m, within the shape
  double reach() const { return reach_; }  ///< m, of a ball around center() that contains it
  double area() const { return area_; }    ///< m^2, of its surface
  Eigen::Vector3d pointOfSurface(std::mt19937& random) const;
  const Eigen::AlignedBox3d& box() const { return box_; }

 private:
  enum class Kind { Ball, Capsule, Box, Cylinder, Faces };
  struct Face {
    Eigen::Vector3d normal;  ///< unit
    double offset;           ///< m
  };
  void useFaces(std::span<const Eigen::Vector3d> vertices,
                std::span<const Eigen::Vector3i> triangles, double growth);
  double mostBeyond(double growth) const;
  Eigen::Vector3d local(const Eigen::Vector3d& p) const { return shape_from_body_ * p; }

  Kind kind_ = Kind::Ball;
  Eigen::Isometry3d body_from_shape_ = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d shape_from_body_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d half_ = Eigen::Vector3d::Zero();  ///< m; z: of capsules and cylinders, too
  double radius_ = 0.0;                             ///< m
  double growth_ = 0.0;                             ///< m
  std::vector<Face> faces_;
  double beyond_ = 0.0;                    ///< m; no vertex is farther in front of a plane
  std::vector<Eigen::Vector3d> vertices_;  ///< m, body frame
  std::vector<Eigen::Vector3i> triangles_;
  std::vector<double> areas_;  ///< m^2, up to each triangle
  bool closed_ = true;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double reach_ = 0.0;
  double area_ = 0.0;
  double size_ = 0.0;  ///< m, what rounding is relative to
  Eigen::AlignedBox3d box_;
};

std::vector<ConvexField> fieldsOf(std::span<const EnclosingSphere> spheres);
std::vector<ConvexField> fieldsOf(std::span<const PosedShape> shapes, double growth = 0.0);

/// m: the least value of any field.
double outsideAll(const Eigen::Vector3d& point, std::span<const ConvexField> fields);

///@{
/// Of fields, which are not empty.
OutsideSpheres outsideFields(std::span<const PosedShape> body, std::span<const ConvexField> fields,
                             const OutsideSpheresOptions& options);
SphereExcess fieldsExcess(std::span<const PosedShape> body, std::span<const ConvexField> fields,
                          const SphereExcessOptions& options);
///@}

}  // namespace swept::detail
