// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// A quick test of the flat faces of one body that face the middle of another: if the other's point
/// nearest to such a face lies over the face or inside the body, that is the whole answer. The
/// tests do not wait for each other, unlike the steps of a descent.
struct FaceProbe {
  double separation = -std::numeric_limits<double>::infinity();  ///< m, the largest of the faces
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, of that face; the body's frame
  Eigen::Vector3d lowest = Eigen::Vector3d::Zero();  ///< m, the other's point nearest to its plane
  bool over = false;                                 ///< that point projects into the face
  bool inside = false;  ///< the point of some face lies in the body; then it is `lowest`
};

namespace probe {

inline double squaredRho(const Eigen::Vector3d& p) {
  return p.x() * p.x() + p.y() * p.y();
}

/// Faces are perpendicular to a local axis, at `sign * height`.
struct Face {
  int axis;
  double sign;
};

template <Convex::Core kind>
constexpr bool kHasFaces =
    kind == Convex::Core::Box || kind == Convex::Core::Cylinder || kind == Convex::Core::Cone;

inline bool overFace(BoxCore, const Convex& body, const Face& face, const Eigen::Vector3d& p) {
  const int i = (face.axis + 1) % 3;
  const int j = (face.axis + 2) % 3;
  return std::abs(p[i]) <= body.size[i] && std::abs(p[j]) <= body.size[j];
}
inline bool overFace(CylinderCore, const Convex& body, const Face&, const Eigen::Vector3d& p) {
  return squaredRho(p) <= body.size.x() * body.size.x();
}
inline bool overFace(ConeCore, const Convex& body, const Face&, const Eigen::Vector3d& p) {
  return squaredRho(p) <= body.size.x() * body.size.x();
}

/// For a point over the face and not beyond it.
inline bool within(BoxCore, const Convex& body, const Face& face, const Eigen::Vector3d& p) {
  return std::abs(p[face.axis]) <= body.size[face.axis];
}
inline bool within(CylinderCore, const Convex& body, const Face&, const Eigen::Vector3d& p) {
  return std::abs(p.z()) <= body.size.z();
}
inline bool within(ConeCore, const Convex& body, const Face&, const Eigen::Vector3d& p) {
  const double left = (body.size.z() - p.z()) * body.size.x();  // radius here, times the height
  const double height = 2.0 * body.size.z();
  return p.z() >= -body.size.z() && left >= 0.0 && squaredRho(p) * height * height <= left * left;
}

template <Convex::Core kind>
void look(CoreTag<kind> tag, const Convex& body, const Convex& other,
          const Eigen::Matrix3d& rotation, const Eigen::Vector3d& offset, const Face& face,
          FaceProbe& best) {
  const Eigen::Vector3d along = face.sign * rotation.row(face.axis).transpose();
  const Eigen::Vector3d lowest = rotation * other.support(-along) + offset;
  const double separation = face.sign * lowest[face.axis] - body.size[face.axis];
  const bool over = overFace(tag, body, face, lowest);
  const bool inside = separation <= 0.0 && over && within(tag, body, face, lowest);
  if (!inside && (best.inside || !(separation > best.separation))) return;
  best.separation = separation;
  best.normal = face.sign * Eigen::Vector3d::Unit(face.axis);
  best.lowest = lowest;
  best.over = over;
  best.inside = inside;
}

}  // namespace probe

/// `rotation` and `offset` are the pose of the other in the body's frame.
template <Convex::Core kind>
FaceProbe probeFaces(CoreTag<kind> tag, const Convex& body, const Convex& other,
                     const Eigen::Matrix3d& rotation, const Eigen::Vector3d& offset) {
  FaceProbe best;
  if constexpr (kind == Convex::Core::Box) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(std::abs(offset[axis]) > body.size[axis])) continue;
      probe::look(tag, body, other, rotation, offset, {axis, std::copysign(1.0, offset[axis])},
                  best);
    }
  } else {
    const double side = kind == Convex::Core::Cone ? -1.0 : std::copysign(1.0, offset.z());
    if (side * offset.z() > body.size.z()) {
      probe::look(tag, body, other, rotation, offset, {2, side}, best);
    }
  }
  return best;
}

}  // namespace swept::detail
