// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "random.hpp"
#include "swept/core/shapes.hpp"

/// Random sweeps of two rigid bodies, and what is known about them without asking the library.
namespace sweeps {

/// Every kind of shape, and every meaning of a mesh.
enum class Kind : std::uint8_t {
  Sphere,
  Box,
  Cylinder,
  Capsule,
  Cone,
  Ellipsoid,
  Hull,
  Triangle,
  Plane,
  HalfSpace,
  ClosedMesh,
  OpenMesh,
  SurfaceMesh,
  Cloud
};
inline constexpr std::array<std::string_view, 14> kKindNames{
    "sphere",   "box",   "cylinder",   "capsule",     "cone",      "ellipsoid",    "hull",
    "triangle", "plane", "half-space", "closed mesh", "open mesh", "surface mesh", "cloud"};
inline constexpr int kKinds = static_cast<int>(kKindNames.size());

/// A convex set as its definition has it: a core and a ball added to it.
struct Part {
  enum class Core : std::uint8_t { Points, Box, Cylinder, Cone, Ellipsoid };
  Core core = Core::Points;
  std::vector<Vector3d> points;      ///< m
  Vector3d size = Vector3d::Zero();  ///< m; (radius, -, half length) of round ones
  double ball = 0.0;                 ///< m
  Vector3d center = Vector3d::Zero();
  double radius = 0.0;  ///< m, of a ball about the centre that has all of it

  /// The core's point farthest along n, of any length.
  Vector3d support(const Vector3d& n) const;
};

/// A point of a body, and perhaps a direction in which no other point is farther.
struct Touch {
  Vector3d point;   ///< m
  Vector3d normal;  ///< unit, outward
  bool extreme;
};

struct Body {
  Kind kind = Kind::Sphere;
  swept::Shape shape;
  std::vector<Part> parts;  ///< their union is the body, but for what `shell` encloses
  /// Of a solid mesh.
  std::vector<std::array<Vector3d, 3>> shell;
  Vector3d normal = Vector3d::Zero();  ///< of planes and half-spaces, which have no parts
  double offset = 0.0;                 ///< m
  bool boxy = false;                   ///< its extreme features are those of a box about the origin
  Vector3d half = Vector3d::Zero();    ///< m, of the boxy ones
  double reach = 0.0;                  ///< m, no point is farther from the origin

  bool flat() const { return kind == Kind::Plane || kind == Kind::HalfSpace; }
  bool convex() const { return kind < Kind::ClosedMesh; }
  /// m, largest n . x; not of flat ones.
  double extent(const Vector3d& n) const;
  /// C++ that makes the shape.
  std::string code() const;
};

/// Sizes of about `size` (m): plump ones, thin plates, rods, and ones without extent.
Body makeBody(Kind kind, double size, Random& random);
/// On a face, an edge, a vertex or a round side.
Touch touchOn(const Body& body, double size, Random& random);
/// A point within, where the body has any.
Touch touchIn(const Body& body, double size, Random& random);

}  // namespace sweeps
