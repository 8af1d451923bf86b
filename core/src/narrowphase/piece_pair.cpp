// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/piece_pair.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>

#include "bvh/box_fit.hpp"
#include "narrowphase/flat_pair.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Grown by at least half a float's last place, so that the sum of doubles for the value may round.
float wellBelow(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}

OrientedBox boxOf(const Vector3d& center, const Vector3d& half) {
  OrientedBox box;
  box.center = center;
  for (int i = 0; i < 3; ++i) box.half[i] = aboveInSingle(half[i]);
  return box;
}

OrientedBox boxAround(std::span<const Vector3d> points) {
  Vector3d lower = points.front();
  Vector3d upper = lower;
  for (const Vector3d& point : points) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  const Vector3d center = 0.5 * lower + 0.5 * upper;
  return boxOf(center, (upper - center).cwiseMax(center - lower));
}

/// A box around the core of a convex body. A plane or half-space has no box, and none of it is
/// tested.
OrientedBox coreBox(const Convex& convex) {
  const Vector3d& size = convex.size;
  switch (convex.core) {
    case Convex::Core::Point:
    case Convex::Core::Segment:
    case Convex::Core::Box:
    case Convex::Core::Ellipsoid:
      return boxOf(Vector3d::Zero(), size);
    case Convex::Core::Cylinder:
    case Convex::Core::Cone:
      return boxOf(Vector3d::Zero(), {size.x(), size.x(), size.z()});
    case Convex::Core::Points:
      return boxAround(convex.points);
    case Convex::Core::Plane:
    case Convex::Core::HalfSpace:
      break;
  }
  return {};
}

/// The error of a hull that leaves out vertices becomes a ball around it, in which witnesses of its
/// distance may lie. As an error, it would allow them anywhere.
Convex grownAround(const ConvexHull& hull) {
  Convex convex = Convex::of(hull);
  convex.radius = std::exchange(convex.error, 0.0);
  convex.omitted = 0.0;
  return convex;
}

double sizeOf(const Piece& piece) {
  if (piece.isLeaf()) return -1.0;
  const auto& half = piece.box.half;
  return half[0] * half[0] + half[1] * half[1] + half[2] * half[2];
}

}  // namespace

Side Side::of(const Shape& shape) {
  return std::visit(
      [](const auto& body) -> Side {
        if constexpr (std::is_same_v<decltype(body), const TriangleMesh&>) {
          const Convex shell = grownAround(body.coarseHull());
          const double reach = body.concavity() + shell.radius;
          return {&body, nullptr, &body.bvh(),          Convex::of(body.hull()),
                  shell, reach,   body.enclosingParts()};
        } else if constexpr (std::is_same_v<decltype(body), const PointCloud&>) {
          Convex hull = Convex::of(body.hull());
          hull.radius = body.largestRadius();
          Convex shell = grownAround(body.hull());
          shell.radius += body.largestRadius();
          return {nullptr, &body, &body.bvh(), hull, shell, hull.extent};
        } else {
          return {nullptr, nullptr, nullptr, Convex::of(body), {}, 0.0};
        }
      },
      shape);
}

TriangleCorners cornersOf(const TriangleMesh& mesh, int triangle) {
  const Eigen::Vector3i& t = mesh.triangles()[triangle];
  return {mesh.vertices()[t[0]], mesh.vertices()[t[1]], mesh.vertices()[t[2]]};
}

PiecePair::PiecePair(const Side& a, const Side& b, const Isometry3d& a_from_b)
    : a_(a),
      b_(b),
      a_from_b_(a_from_b),
      frames_(a_from_b, reachOf(a) + reachOf(b)),
      back_(frames_.inverse()),
      rounding_(tolerance::kSupportRounding * (b.convex.extent + a_from_b.translation().norm())) {}

Piece PiecePair::rootOf(const Side& side) {
  if (!side.isConvex()) return {0, -1, -1, side.bvh->rootBox()};
  return {-1, -1, -1, coreBox(side.convex)};
}

double PiecePair::reachOf(const Side& side) {
  if (!side.isConvex()) return side.bvh->reach();
  return side.convex.isFlat() ? 0.0 : 2.0 * side.convex.extent;
}

bool PiecePair::isLarger(const Piece& a, const Piece& b) {
  return sizeOf(a) >= sizeOf(b);
}

PiecePair::Split PiecePair::split(const Piece& a, const Piece& b, WideNode& room) const {
  const bool ofA = isLarger(a, b);
  const int index = ofA ? a.node : b.node;
  return {ofA, index, &(ofA ? a_ : b_).bvh->node(index, room)};
}

Piece PiecePair::piece(bool ofA, int place) const {
  const Side& side = ofA ? a_ : b_;
  if (place < 0) return rootOf(side);
  const int index = place / WideNode::kLanes;
  WideNode room;
  return child({ofA, index, &side.bvh->node(index, room)}, place % WideNode::kLanes);
}

void PiecePair::boundChildren(const Split& split, const Piece& other, double enough, Bounds& lower,
                              BoxDirections* directions) const {
  const WideNode& node = *split.node;
  const Convex& body = (split.ofA ? b_ : a_).convex;
  const bool flat = other.isWhole() && body.isFlat();
  if (flat || !frames_.usable()) {
    if (directions != nullptr) *directions = {};
    for (int i = 0; i < node.count; ++i) {
      lower[i] = flat ? boundAgainstFlat(node.box(i), split.ofA) : 0.0F;
    }
    return;
  }
  const double grown = other.isWhole() ? body.radius + body.error : 0.0;
  const BoxFrames& frames = split.ofA ? frames_ : back_;
  if (directions != nullptr) {
    boxLowerBounds(node, frames, other.box, aboveInSingle(enough + grown), lower, *directions);
  } else {
    boxLowerBounds(node, frames, other.box, aboveInSingle(enough + grown), lower);
  }
  if (!(grown > 0.0)) return;
  for (int i = 0; i < node.count; ++i) {
    lower[i] = wellBelow(static_cast<double>(lower[i]) - grown);
  }
}

/// A box of one side against the plane or half-space on the other side.
float PiecePair::boundAgainstFlat(const OrientedBox& box, bool ofA) const {
  const Convex& flat = (ofA ? b_ : a_).convex;
  const Convex body = Convex::of(Box{Vector3d(box.half[0], box.half[1], box.half[2])});
  Isometry3d side_from_box;
  side_from_box.translation() = box.center;
  for (int j = 0; j < 3; ++j) {
    side_from_box.linear().col(j) = Vector3d(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
  }
  const GjkResult apart = ofA ? flatPair(flat, body, a_from_b_.inverse() * side_from_box, Goal(0.0))
                              : flatPair(flat, body, a_from_b_ * side_from_box, Goal(0.0));
  // Lemma: flatPair allows for the rounding of the relative coordinates it gets; the coordinates
  // whose differences these are may be larger. The axes are orthonormal only up to kBoxRounding
  // times the size.
  const double rounded =
      tolerance::kSupportRounding * (box.center.norm() + a_from_b_.translation().norm()) +
      2.0 * kBoxRounding * body.extent;
  return wellBelow(apart.lower - rounded);
}

bool PiecePair::hasGaps(bool ofA, const Piece& other) const {
  return frames_.usable() && !(other.isWhole() && (ofA ? b_ : a_).convex.isFlat());
}

BoxGap PiecePair::ofBodies(BoxGap gap, bool ofA, const Piece& other) const {
  const Convex& body = (ofA ? b_ : a_).convex;
  if (other.isWhole()) gap.value -= body.radius + body.error;
  if (!ofA) gap.direction = -(a_from_b_.linear() * gap.direction);
  return gap;
}

BoxGap PiecePair::gap(const Piece& child, bool ofA, const Piece& other) const {
  if (!hasGaps(ofA, other)) return {};
  return ofBodies(boxGap(child.box, ofA ? frames_ : back_, other.box), ofA, other);
}

BoxGap PiecePair::gap(const Piece& child, bool ofA, const Piece& other,
                      const Vector3d& along) const {
  if (!hasGaps(ofA, other)) return {};
  return ofBodies(boxGap(child.box, ofA ? frames_ : back_, other.box, along), ofA, other);
}

/// Returns the centre about which the body is given, in its side's frame.
Vector3d PiecePair::placeOne(const Side& side, const Piece& piece, TriangleCorners& corners,
                             Convex& body) {
  if (piece.isWhole()) {
    body = side.convex;
    return Vector3d::Zero();
  }
  if (side.cloud != nullptr) {
    body = Convex::of(Sphere{side.cloud->radius(static_cast<std::size_t>(piece.primitive))});
    return side.cloud->points()[piece.primitive];
  }
  corners = cornersOf(*side.mesh, piece.primitive);
  Vector3d center = corners[0];
  for (Vector3d& corner : corners) corner -= center;
  body = Convex::ofPoints(corners);
  return center;
}

void PiecePair::place(const Piece& pieceA, const Piece& pieceB, Leaves& leaves) const {
  leaves.centerA = placeOne(a_, pieceA, leaves.cornersA, leaves.a);
  const Vector3d centerB = placeOne(b_, pieceB, leaves.cornersB, leaves.b);
  leaves.a_from_b = a_from_b_;
  leaves.a_from_b.translation() = a_from_b_ * centerB - leaves.centerA;
  // Lemma: the translation, and the relative corners of a triangle, round by a few ulps of the
  // coordinates whose differences they are, which may be far larger than the leaves and their
  // offset.
  const double moved = rounding_ + tolerance::kSupportRounding * a_.convex.extent;
  if (!pieceA.isWhole()) leaves.a.error += moved;
  if (pieceA.isWhole() && !pieceB.isWhole()) leaves.b.error += moved;
}

void PiecePair::place(const Piece& piece, bool ofA, BoxAndBody& pair) const {
  const OrientedBox& box = piece.box;
  const double size = static_cast<double>(box.half[0]) + box.half[1] + box.half[2];
  std::array<Vector3d, 3> axes;
  for (int j = 0; j < 3; ++j) {
    axes[j] =
        (box.half[j] + kBoxSkew * size) * Vector3d(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
  }
  for (int i = 0; i < 8; ++i) {
    pair.corners[i] = (i & 1 ? axes[0] : Vector3d(-axes[0])) +
                      (i & 2 ? axes[1] : Vector3d(-axes[1])) +
                      (i & 4 ? axes[2] : Vector3d(-axes[2]));
  }
  pair.box = Convex::ofPoints(pair.corners);
  pair.body = (ofA ? b_ : a_).convex;
  pair.a_from_b = a_from_b_;
  if (ofA) {
    pair.a_from_b.translation() -= box.center;
  } else {
    pair.a_from_b.translation() = a_from_b_ * box.center;
  }
  // Lemma: corners and translation round by a few ulps of the coordinates whose sums and
  // differences they are.
  pair.box.error = tolerance::kSupportRounding *
                   (box.center.cwiseAbs().sum() + a_from_b_.translation().norm() + size);
}

bool PiecePair::hasCoarseBox(const Convex& body) {
  switch (body.core) {
    case Convex::Core::Cylinder:
    case Convex::Core::Cone:
    case Convex::Core::Ellipsoid:
    case Convex::Core::Points:
      return true;
    case Convex::Core::Point:
    case Convex::Core::Segment:
    case Convex::Core::Box:
    case Convex::Core::Plane:
    case Convex::Core::HalfSpace:
      return false;
  }
  return false;
}

TriangleCorners PiecePair::movedCorners(int triangle) const {
  TriangleCorners corners = cornersOf(*b_.mesh, triangle);
  for (Vector3d& corner : corners) corner = a_from_b_ * corner;
  return corners;
}

}  // namespace swept::detail
