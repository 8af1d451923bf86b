// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "swept/core/shapes.hpp"

/// Few spheres that together contain a rigid body: for planners that check spheres alone.
namespace swept {

/// Asked between the steps of long work; true ends it: SearchStopped. Empty: it is never ended. As
/// std::stop_token::stop_requested, whose header would be a quarter of what this one needs.
using StopQuestion = std::function<bool()>;

/// Thrown by work around a body once its StopQuestion is answered with true.
class SearchStopped : public std::runtime_error {
 public:
  SearchStopped();
};

/// A shape and its place on a rigid body.
struct PosedShape {
  Shape shape;  ///< in its own frame
  /// Pose of the shape in the body's frame; its rotation is one up to rounding.
  Eigen::Isometry3d body_from_shape = Eigen::Isometry3d::Identity();
};

/// A ball in the body's frame.
struct EnclosingSphere {
  Eigen::Vector3d center;  ///< m
  double radius;           ///< m
};

/// How far a body reaches out of the union of some spheres: the largest value, over the points p of
/// the body, of the least |p - center| - radius over the spheres. All radii have to grow by just
/// this so that the spheres contain the body. Negative: they could shrink by as much.
struct OutsideSpheres {
  double lower;           ///< m; the body has a point that is at least this far outside
  double upper;           ///< m, proven; at most 0: the spheres contain the body
  Eigen::Vector3d point;  ///< m, body frame: within rounding of that point
  /// From 0 to 1: sampled share of the body's surface that is in no sphere; it proves nothing.
  double surfaceShare;
};

/// How closely the two bounds of OutsideSpheres must agree.
struct OutsideSpheresOptions {
  double tolerance = 1e-5;  ///< m
  int mostSplits = 100000;  ///< of pieces of the body; then the bounds stay as they are
  int samples = 20000;      ///< points of the surface for `surfaceShare`
  StopQuestion stop = {};   ///< ends it, within some milliseconds: SearchStopped
};

/// Judges spheres of any origin. The body is the union of its shapes: a closed mesh counts with its
/// inside, an open one, and one of MeshInterior::Surface, as a surface.
///
/// Proven, rounding included: the body is divided into pieces, each in the hull of a few points
/// (the lemma is that of the covers, sphere_cover.hpp), until the bounds agree or the work is used
/// up. For round shapes the bounds differ by up to the error of a polyhedron around them (0.3 % of
/// their radius); a Sphere and the balls of a PointCloud are not divided, so `upper` is that of the
/// spheres which hold them whole.
///
/// Without spheres both bounds are infinite, without shapes -infinite. Throws std::invalid_argument
/// for planes and half-spaces, for a sphere that is not finite, and for a tolerance that is not
/// above 0.
OutsideSpheres outsideSpheres(std::span<const PosedShape> body,
                              std::span<const EnclosingSphere> spheres,
                              const OutsideSpheresOptions& options = {});

/// How far the surface of a union of spheres is from the body within.
struct SphereExcess {
  /// m, at some point of the surface; like the mean up to 1e-5 of the body's size too large.
  double largestSeen;
  double largest;  ///< m, proven: no point of the surface is farther from the body
  double mean;     ///< m, over the surface, sampled
  /// Volume of the union relative to that of the body, sampled; NaN: the body has no inside.
  double volumeRatio;
};

/// Work for the figures of SphereExcess.
struct SphereExcessOptions {
  int samples = 20000;        ///< of the surface, and as many of the volume
  double tolerance = 0.02;    ///< of `largest`, relative
  int mostDistances = 60000;  ///< for `largest`; then it stays as it is
  std::uint32_t seed = 1;     ///< of the samples
  StopQuestion stop = {};     ///< ends it, within some milliseconds: SearchStopped
};

/// Measures spheres of any origin against a body. Throws std::invalid_argument as outsideSpheres,
/// and for a body without shapes.
SphereExcess sphereExcess(std::span<const PosedShape> body,
                          std::span<const EnclosingSphere> spheres,
                          const SphereExcessOptions& options = {});

/// Spheres that contain a body.
struct EnclosingSpheres {
  /// Together they contain the body: proven. Centres and radii are single precision numbers, so
  /// that a program with such numbers has the same spheres.
  std::vector<EnclosingSphere> spheres;
  /// m. No sphere reaches farther beyond the body: proven, except that pockets of open meshes count
  /// as filled (SphereCover::Node::beyond).
  double reach = 0.0;
};

/// The work of a search.
struct EnclosingSpheresOptions {
  int pieces = 2500;       ///< that the body is divided into
  int restarts = 4;        ///< at least 1
  int rounds = 30;         ///< of one start: a sphere is moved to where the largest reach is
  std::uint32_t seed = 1;  ///< the same seed gives the same spheres, on any number of threads
};

/// Searches for spheres that contain a body: as a solid where its meshes are closed.
///
/// The body is divided into pieces, each in the hull of a few points. Spheres about the medial axis
/// are chosen by a greedy set cover; then pieces go to the sphere that has to reach least beyond
/// the body for them, and each sphere to where it reaches least for its pieces, in turn (Lloyd
/// 1982, with this cost in place of the squared distance); a sphere that others can do without goes
/// to where the reach is largest. In the end, pieces that two spheres share are divided. Each piece
/// stays in one sphere, so the result is proven at any time, rounding included.
///
/// A call asks `stop` every few milliseconds, and throws SearchStopped if that is true. Only how
/// the meshes of a body enclose space is found out to the end. The search is over then, as
/// after any other exception within a call: later calls throw SearchStopped, too.
///
/// One thread at a time may use a search.
class EnclosingSpheresSearch {
 public:
  /// Throws std::invalid_argument for a body without shapes, planes and half-spaces, and for
  /// options below 1 (`rounds`: 0).
  explicit EnclosingSpheresSearch(std::span<const PosedShape> body,
                                  const EnclosingSpheresOptions& options = {},
                                  const StopQuestion& stop = {});
  ~EnclosingSpheresSearch();
  EnclosingSpheresSearch(EnclosingSpheresSearch&&) noexcept;
  EnclosingSpheresSearch& operator=(EnclosingSpheresSearch&&) noexcept;

  /// About how many spheres are needed so that none reaches farther than this (m) beyond the body.
  int countFor(double reach) const;
  /// At most `count` spheres, with a small reach. If one more or one fewer was asked for before,
  /// the search begins at that result, which takes a fraction of the time. Asked again for the same
  /// number, it searches from nothing, too, once, and the better result counts. Throws
  /// std::invalid_argument for less than one.
  EnclosingSpheres atMost(int count, const StopQuestion& stop = {});
  /// Few spheres that reach at most this (m) beyond the body, if the pieces are small enough for
  /// it: see EnclosingSpheres::reach. Throws std::invalid_argument unless it is above 0.
  EnclosingSpheres within(double reach, const StopQuestion& stop = {});

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

}  // namespace swept
