// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "core/error_table_placement.hpp"

namespace extremes {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using error_table::Body;
using error_table::Point;
using error_table::Random;
using error_table::Real;
using error_table::Solid;
using error_table::Truth;

/// Two solids, one pose, and a truth in 50 digits.
struct Sample {
  Solid a, b;
  Isometry3d pose = Isometry3d::Identity();  ///< a_from_b
  Truth truth = {};                          ///< m, of the signed distance
  /// At the pose that this touch tells, b touches a; moved from there along touch.n it is apart,
  /// and the other way it overlaps.
  std::optional<error_table::Touch> touch = {};
  /// m; where the world has a.
  Vector3d place = Vector3d::Zero();
  /// m. Along the touch's normal, of two that touch with faces; 0: not known.
  double thickness = 0.0;
  /// m, without what is between a body and the origin of its frame; 0: the largest extent.
  double span = 0.0;

  /// m, larger extent and offset; errors are relative to it.
  double size() const { return std::max(a.body.extent, b.body.extent) + pose.translation().norm(); }
  /// m. A few roundings of support evaluations: bodies this close may be said to touch.
  double rounding() const;
};

/// One line of the table per query.
struct PairCase {
  std::string name;
  std::string baseline;
  double workLimit;
  std::function<Sample(Random& random, int i)> draw;
  bool bothSides = true;
  int samples = 120;
  double motionWorkLimit = 10.0;  ///< of continuousCollide
};

enum class Form : std::uint8_t {
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
  Mesh,
  Cloud,
};

/// All but the plane, which has no inside and no end.
std::vector<Form> mostForms();

struct Wanted {
  std::vector<Form> shapes = mostForms();
  double sizeA = 1.0, sizeB = 1.0;  ///< m
  double gap = 0.0;                 ///< m; 0: any, by order of magnitude. Overlap: the depth
  double awayFromOrigin = 0.0;      ///< m, of the corners of those that have corners
};

/// One of the shapes that are wanted.
Solid drawOne(Random& random, const Wanted& wanted, double size);
/// Apart, or touching now and then.
Sample drawApart(Random& random, const Wanted& wanted);
/// Overlapping, with a known depth: balls roll inside one of the two (or a half-space is one), or
/// both are polytopes, whose depth is looked for among all normals.
Sample drawOverlapping(Random& random, const Wanted& wanted);
/// One after the other.
Sample drawEither(Random& random, const Wanted& wanted, int i);

/// The two at a touch moved by a gap along its normal: with a lemma for the truth where apart.
Sample apartAt(Solid a, Solid b, const error_table::Touch& touch, const Real& gap);
/// Balls roll inside the two (or one of them) all over the surface; deeper than `depth` (m) is what
/// their radii add up to.
Sample overlapAt(Solid a, Solid b, const error_table::Touch& touch, const Real& depth);
/// m. The shortest way out of each other of two polytopes or triangles, from all normals that the
/// faces of their difference can have; negative where one of these tells that they are apart.
Real depthOf(const Body& a, const Body& b, const Isometry3d& pose);
/// Of two polytopes, whatever their pose; nothing where they are apart.
std::optional<Sample> overlappingAt(Solid a, Solid b, const Isometry3d& pose);

/// A polytope of these points; `faces` outward.
Solid meshOf(std::vector<Vector3d> points, std::vector<Eigen::Vector3i> faces);
Solid boxOf(const Vector3d& half);
Solid boxMeshOf(const Vector3d& half);
Solid triangleOf(const Vector3d& a, const Vector3d& b, const Vector3d& c);
Solid sphereOf(double radius);
/// The hull of points each of which is a vertex; without faces and edges.
Solid hullOf(std::vector<Vector3d> points);

/// Two boxes with parallel axes, turned by a permutation: the truth from the gaps along the axes.
Sample alignedBoxes(Solid a, const Vector3d& halfA, Solid b, const Vector3d& halfB,
                    const Matrix3d& turn, const Vector3d& translation);

std::vector<PairCase> scaleCases();
std::vector<PairCase> gapCases();
std::vector<PairCase> parallelCases();
std::vector<PairCase> sliverCases();
std::vector<PairCase> nestedCases();
std::vector<PairCase> hullCases();
std::vector<PairCase> rotationCases();

}  // namespace extremes
