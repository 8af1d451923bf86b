// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "geometry/simplex.hpp"
#include "narrowphase/convex.hpp"

namespace swept::detail {

/// The polytope inside B - A that EPA grows: triangles that know their neighbours, so that finding
/// the faces that a new vertex sees costs only as much as their number. Fixed storage.
///
/// Lemma: where all faces have a positive distance, the ball of the least of these around the
/// origin lies in B - A, however rounding has turned the normals. A face's distance is the least
/// n . v over its corners, so that no point of the face is nearer to the origin, nor to any point x
/// with n . x <= distance. The surface winds once around `center_`: the first tetrahedron does, and
/// replacing faces by a fan adds the tetrahedra between them, each of which lies beyond the plane
/// of its face while the centre lies before it. It then winds once around the whole ball, since
/// neither the way from the centre to the origin nor the ball meets a face. And it cannot wind
/// around a point outside the hull of its vertices.
class Polytope {
 public:
  static constexpr int kMaxVertices = 256;
  static constexpr int kMaxFaces = 2 * kMaxVertices;

  Polytope(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b);

  /// A tetrahedron with the simplex among its faces, edges or corners. On failure `flat` is a
  /// direction along which B - A has next to no extent.
  bool start(const Simplex& simplex, Eigen::Vector3d& flat);

  struct Face {
    std::array<int, 3> vertex;    ///< counter-clockwise seen from outside
    std::array<int, 3> neighbor;  ///< face across the edge from vertex k to vertex k + 1
    Eigen::Vector3d normal;       ///< unit, outward
    int visit;                    ///< the last expansion that saw it from outside
  };
  int nearestFace() const;
  const Face& face(int i) const { return faces_[i]; }
  /// m. No point of the face is nearer to the origin, which is inside the polytope. For slots
  /// without a face it is larger than any length.
  double distance(int face) const { return distances_[face]; }
  int faceSlots() const { return faceSlots_; }
  Simplex triangle(int face) const;

  struct Vertex {
    Eigen::Vector3d difference;  ///< m, of B - A
    Eigen::Vector3d onA;         ///< m
  };
  /// Point of B - A farthest along n.
  Vertex support(const Eigen::Vector3d& n);

  /// Replaces the faces that see the new vertex, one of which is `from`, by a fan from their
  /// border. False if the result would not be a polytope; then nothing changes.
  bool expand(const Vertex& added, int from);

  double rounding() const { return rounding_; }  ///< m
  int evaluations() const { return evaluations_; }

 private:
  static constexpr double kGone = 1e300;  ///< m, key of a removed face

  struct Border {
    int face;  ///< that stays
    int edge;  ///< of it
    int from;  ///< vertex where the edge starts, in the direction of the hole
    int to;
  };

  bool expand(const Vertex& added, int from, double above);
  bool seeAround(const Eigen::Vector3d& point, int from, double above);
  bool borderIsOneLoop() const;
  bool makeFan(int apex);
  bool makeFace(const std::array<int, 3>& corners, Face& face, double& distance) const;
  bool makeTetrahedron();
  bool widen(double least, Eigen::Vector3d& flat);
  int takeSlot();

  const Eigen::Vector3d& point(int i) const { return vertices_[i].difference; }
  Eigen::Vector3d edge(int i) const { return point(i) - point(0); }
  void dropFlat(double least);

  const Convex& a_;
  const Convex& b_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d offset_;
  Eigen::Vector3d center_;
  double rounding_ = 0.0;
  int vertexCount_ = 0;
  int faceSlots_ = 0;
  int freeCount_ = 0;
  int visibleCount_ = 0;
  int borderCount_ = 0;
  int visit_ = 0;
  int evaluations_ = 0;
  std::array<double, kMaxFaces> distances_;
  std::array<Vertex, kMaxVertices> vertices_;
  std::array<Face, kMaxFaces> faces_;
  std::array<int, kMaxFaces> free_;
  std::array<int, kMaxFaces> visible_;
  std::array<Border, kMaxFaces> border_;
  std::array<int, kMaxFaces> fan_;
};

}  // namespace swept::detail
