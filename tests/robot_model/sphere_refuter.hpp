// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Whether spheres contain a robot: read and decided by other means than those of the library, of
/// which nothing is included.
namespace swept::test {

struct RefuterBall {
  Eigen::Vector3d center;  ///< m, frame of the link
  double radius;           ///< m
};

/// Triangles of a link, m, in its frame: those of meshes and boxes, and of polyhedra within round
/// shapes, whose corners are on the surface.
struct RefuterLink {
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
  std::vector<std::vector<std::array<Eigen::Vector3d, 3>>> shapes;  ///< the same, per shape
  std::vector<RefuterBall> balls;                                   ///< of the other file
};

/// The links of a URDF with the spheres of a spherized one. Reads .obj and binary .stl; throws
/// std::runtime_error for what it cannot read.
std::map<std::string, RefuterLink> readRefuterLinks(const std::filesystem::path& urdf,
                                                    const std::filesystem::path& spheres);

/// m: how far points of the surface, as many as this over the link, are outside all balls, at most.
/// Half of them are on edges and corners. Negative: none is outside.
double sampledOutside(const RefuterLink& link, std::uint64_t points, std::uint32_t seed);

/// Whether each triangle is in the union of the balls grown by `error` (m): it is halved until each
/// part has its three corners in one ball, which is convex. False also where `error` is too small
/// to tell.
bool surfaceIsContained(const RefuterLink& link, double error);

/// Whether the inside of each closed shape is contained, too, if its surface is.
///
/// Lemma: a linear function over a bounded gap between balls is largest at a point where three
/// spheres meet. For at a point of one sphere alone, or of two, there is a direction along which
/// the gap goes on: tangentially, outside the balls, and so to larger values. So if no such point
/// that is outside all other balls is inside the shape, there is no gap.
bool insideIsContained(const RefuterLink& link, double error);

}  // namespace swept::test
