// SPDX-License-Identifier: BSD-3-Clause
// Distances of moving points from obstacles. Included once per instruction set.
#if defined(SWEPT_SIMD_OBSTACLE_KERNELS) == defined(HWY_TARGET_TOGGLE)
#ifdef SWEPT_SIMD_OBSTACLE_KERNELS
#undef SWEPT_SIMD_OBSTACLE_KERNELS
#else
#define SWEPT_SIMD_OBSTACLE_KERNELS
#endif

#include <cstdint>

#include "rounding/error_model.hpp"
#include "simd/compile/obstacles.hpp"
#include "simd/kernels/f8.hpp"
#include "simd/kernels/placed_ball.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {

using LanePart = hn::RebindToSigned<Part>;

HWY_INLINE F8 positive(const F8& a) {
  return larger(a, set(0.0F));
}
HWY_INLINE F8 square(const F8& a) {
  return a * a;
}

/// Lemma: coordinate i of every point of the segment, in the box's frame, is at least |a . x + d| -
/// |a . g| in magnitude.
HWY_INLINE F8 squaredDistance(const SimdBox& box, const Segment& segment) {
  F8 sum = set(0.0F);
  for (int i = 0; i < 3; ++i) {
    const V3 axis = set3(box.axes[i]);
    const F8 at = absolute(dot(axis, segment.x) + set(box.offset[i]));
    const F8 gap = positive(at - absolute(dot(axis, segment.g)) - set(box.half[i]));
    sum = multiplyAdd(gap, gap, sum);
  }
  return sum;
}

HWY_INLINE F8 squaredDistance(const SimdBox& box, const V3& point) {
  F8 sum = set(0.0F);
  for (int i = 0; i < 3; ++i) {
    const F8 at = absolute(dot(set3(box.axes[i]), point) + set(box.offset[i]));
    const F8 gap = positive(at - set(box.half[i]));
    sum = multiplyAdd(gap, gap, sum);
  }
  return sum;
}

HWY_INLINE F8 ballSquared(const SimdRound& ball, const Segment& segment) {
  const F8 squared = nearestSquared(segment.x - set3(ball.center), segment.g);
  return square(positive(root(squared) - set(ball.radius)));
}

/// Parts along an axis and orthogonal to it. The least of each part bounds both together.
struct AxialParts {
  F8 axial;   ///< of the middle, signed
  F8 sweep;   ///< half of the segment's extent along the axis
  F8 radial;  ///< least distance from the axis
};
HWY_INLINE AxialParts axialParts(const SimdRound& shape, const Segment& segment) {
  const V3 axis = set3(shape.axis);
  const V3 y = segment.x - set3(shape.center);
  const F8 s = dot(axis, y);
  const F8 h = dot(axis, segment.g);
  const F8 squared = nearestSquared(along(y, -s, axis), along(segment.g, -h, axis));
  return {s, absolute(h), root(squared)};
}

HWY_INLINE F8 capsuleSquared(const SimdRound& shape, const Segment& segment) {
  const AxialParts parts = axialParts(shape, segment);
  const F8 beyond = positive(absolute(parts.axial) - parts.sweep - set(shape.halfLength));
  const F8 distance = root(multiplyAdd(beyond, beyond, square(parts.radial)));
  return square(positive(distance - set(shape.radius)));
}

HWY_INLINE F8 cylinderSquared(const SimdRound& shape, const Segment& segment) {
  const AxialParts parts = axialParts(shape, segment);
  const F8 beyond = positive(absolute(parts.axial) - parts.sweep - set(shape.halfLength));
  const F8 outside = positive(parts.radial - set(shape.radius));
  return multiplyAdd(beyond, beyond, square(outside));
}

/// A cone lies in its cylinder and under its side.
HWY_INLINE F8 coneSquared(const SimdRound& shape, const Segment& segment) {
  const AxialParts parts = axialParts(shape, segment);
  const F8 beyond = positive(absolute(parts.axial) - parts.sweep - set(shape.halfLength));
  const F8 outside = positive(parts.radial - set(shape.radius));
  const F8 side =
      multiplyAdd(set(shape.across), parts.radial, set(shape.along) * (parts.axial - parts.sweep)) -
      set(shape.offset);
  return larger(multiplyAdd(beyond, beyond, square(outside)), square(positive(side)));
}

HWY_INLINE F8 planesSquared(const LanePlane* planes, int count, const Segment& segment) {
  F8 most = set(0.0F);
  for (int i = 0; i < count; ++i) {
    const V3 normal = set3(planes[i].normal);
    const F8 at = dot(normal, segment.x) - absolute(dot(normal, segment.g));
    most = larger(at - set(planes[i].offset) - set(planes[i].slack), most);
  }
  return square(most);
}

/// A plane, both sides of which are alike. Its slab is as thick as its rounding.
HWY_INLINE F8 slabSquared(const LanePlane& plane, const Segment& segment) {
  const V3 normal = set3(plane.normal);
  const F8 at = absolute(dot(normal, segment.x) - set(plane.offset));
  return square(positive(at - absolute(dot(normal, segment.g)) - set(plane.slack)));
}

/// Lemma: for any unit vector n, the segment keeps the distance n . x - |n . g| - h(n), with h(n) =
/// |S n| the ellipsoid's support. n is the normal at the first hit point if the ellipsoid were a
/// sphere; near a thin ellipsoid its box gives a better bound.
HWY_INLINE F8 ellipsoidSquared(const SimdEllipsoid& shape, const Segment& segment) {
  F8 x[3];
  F8 g[3];
  F8 box = set(0.0F);
  for (int i = 0; i < 3; ++i) {
    const V3 axis = set3(shape.axes[i]);
    x[i] = dot(axis, segment.x) + set(shape.offset[i]);
    g[i] = dot(axis, segment.g);
    const F8 gap =
        positive(absolute(x[i]) - absolute(g[i]) - set(shape.semiAxes[i]) - set(shape.slack));
    box = multiplyAdd(gap, gap, box);
  }
  const V3 scale = set3(shape.inverse);
  const V3 y = {x[0] * scale.x, x[1] * scale.y, x[2] * scale.z};
  const V3 h = {g[0] * scale.x, g[1] * scale.y, g[2] * scale.z};
  const F8 length = larger(dot(h, h), set(1e-30F));
  const F8 s = smaller(larger(-(dot(y, h) / length), set(-1.0F)), set(1.0F));
  const V3 p = along(y, s, h);
  const V3 normal = {p.x * scale.x, p.y * scale.y, p.z * scale.z};
  const F8 inverse = set(1.0F) / root(larger(dot(normal, normal), set(1e-30F)));
  const V3 n = inverse * normal;
  const V3 support = {n.x * set(shape.semiAxes[0]), n.y * set(shape.semiAxes[1]),
                      n.z * set(shape.semiAxes[2])};
  const F8 at = dot(n, V3{x[0], x[1], x[2]}) - absolute(dot(n, V3{g[0], g[1], g[2]}));
  return larger(square(positive(at - root(dot(support, support)) - set(shape.slack))), box);
}

/// Bytes of words in memory.
HWY_INLINE F8 bytesAt(const std::uint32_t* words, const hn::Vec<LanePart> (&index)[kParts]) {
  const hn::RebindToUnsigned<Part> word;
  F8 value;
  for (int i = 0; i < kParts; ++i) {
    const auto found = hn::GatherIndex(word, words, hn::ShiftRight<2>(index[i]));
    // Shifts up and down again: for a right shift by 0 on SSE4, Highway converts 2^32 to an
    // integer, which is an invalid operation for programs that trap these.
    const auto above = hn::BitCast(word, hn::AndNot(index[i], hn::Set(LanePart(), 3)));
    const auto byte = hn::ShiftRight<24>(hn::Shl(found, hn::ShiftLeft<3>(above)));
    value.part[i] = hn::ConvertTo(Part(), hn::BitCast(LanePart(), byte));
  }
  return value;
}

/// The cell of a coordinate, clamped to the grid, also for NaN; adds the square of the distance
/// from the cell's centre.
HWY_INLINE void findCell(const F8& q, float side, float inverse, int count, F8& squared,
                         hn::Vec<LanePart> (&cell)[kParts]) {
  const F8 scaled = q * set(inverse);
  F8 middle;
  for (int i = 0; i < kParts; ++i) {
    cell[i] = hn::Min(hn::Max(hn::ConvertTo(LanePart(), scaled.part[i]), hn::Zero(LanePart())),
                      hn::Set(LanePart(), count - 1));
    middle.part[i] = hn::ConvertTo(Part(), cell[i]);
  }
  const F8 off = q - (middle + set(0.5F)) * set(side);
  squared = multiplyAdd(off, off, squared);
}

/// For points in a field's frame, q in W.
HWY_INLINE F8 cellClearance(const SimdField& field, const V3& q) {
  F8 squared = set(0.0F);
  hn::Vec<LanePart> x[kParts];
  hn::Vec<LanePart> y[kParts];
  hn::Vec<LanePart> z[kParts];
  findCell(q.x, field.cell, field.inverse, 2 * field.blocks[0], squared, x);
  findCell(q.y, field.cell, field.inverse, 2 * field.blocks[1], squared, y);
  findCell(q.z, field.cell, field.inverse, 2 * field.blocks[2], squared, z);
  for (int i = 0; i < kParts; ++i) {
    const auto row = hn::Add(hn::Mul(z[i], hn::Set(LanePart(), 2 * field.blocks[1])), y[i]);
    x[i] = hn::Add(hn::Mul(row, hn::Set(LanePart(), 2 * field.blocks[0])), x[i]);
  }
  return bytesAt(field.cells, x) * set(field.step) - root(squared);
}

/// Negative if there is no brick.
HWY_INLINE F8 voxelClearance(const SimdField& field, const V3& q) {
  F8 squared = set(0.0F);
  hn::Vec<LanePart> x[kParts];
  hn::Vec<LanePart> y[kParts];
  hn::Vec<LanePart> z[kParts];
  const float side = 0.5F * field.cell;
  const float inverse = 2.0F * field.inverse;
  findCell(q.x, side, inverse, 4 * field.blocks[0], squared, x);
  findCell(q.y, side, inverse, 4 * field.blocks[1], squared, y);
  findCell(q.z, side, inverse, 4 * field.blocks[2], squared, z);
  const auto three = hn::Set(LanePart(), 3);
  for (int i = 0; i < kParts; ++i) {
    const auto row = hn::Add(hn::Mul(hn::ShiftRight<2>(z[i]), hn::Set(LanePart(), field.blocks[1])),
                             hn::ShiftRight<2>(y[i]));
    const auto block =
        hn::Add(hn::Mul(row, hn::Set(LanePart(), field.blocks[0])), hn::ShiftRight<2>(x[i]));
    const auto brick = hn::GatherIndex(LanePart(), field.bricks, block);
    const auto within = hn::Add(
        hn::And(x[i], three),
        hn::Add(hn::ShiftLeft<2>(hn::And(y[i], three)), hn::ShiftLeft<4>(hn::And(z[i], three))));
    x[i] = hn::Add(hn::ShiftLeft<6>(brick), within);
  }
  return bytesAt(field.voxels, x) * set(field.fineStep) - root(squared);
}

/// A bound on the distance of points in a field's frame from the obstacle, with the slack
/// subtracted. Lemmas: ClearanceField. Bricks are looked up if cells do not give `enough`, in lanes
/// that are `wanted`.
HWY_INLINE F8 clearance(const SimdField& field, const V3& p, const F8& enough, Lanes wanted) {
  const V3 q = {smaller(larger(p.x, set(field.lower[0])), set(field.upper[0])),
                smaller(larger(p.y, set(field.lower[1])), set(field.upper[1])),
                smaller(larger(p.z, set(field.lower[2])), set(field.upper[2]))};
  const V3 beyond = p - q;
  const F8 outside = dot(beyond, beyond);
  F8 within = positive(cellClearance(field, q));
  const F8 found = root(multiplyAdd(within, within, outside)) - set(field.slack);
  if ((wanted & ~above(found, enough)) == 0) return found;
  within = larger(voxelClearance(field, q), within);
  return root(multiplyAdd(within, within, outside)) - set(field.slack);
}

HWY_INLINE V3 inFrame(const SimdField& field, const V3& x, bool moved) {
  F8 y[3];
  for (int i = 0; i < 3; ++i) {
    y[i] = dot(set3(field.axes[i]), x);
    if (moved) y[i] = y[i] + set(field.offset[i]);
  }
  return {y[0], y[1], y[2]};
}

/// Answer of a field about a segment.
struct FieldAnswer {
  Lanes apart = 0;       ///< the obstacle is farther than the radius from the whole segment
  Lanes worthQuery = 0;  ///< of the others: a finer test may succeed
  F8 middle;             ///< m; a bound for the segment's middle
};

/// Lemma: the ball around the middle x, whose radius is x's clearance minus the radius, covers a
/// part of the segment whose points are all clear; a ball around a point of each rest covers that
/// rest.
HWY_INLINE FieldAnswer askField(const SimdField& field, const Segment& segment, const F8& radius,
                                Lanes wanted) {
  const V3 x = inFrame(field, segment.x, true);
  const F8 length = root(dot(segment.g, segment.g)) * set(kLengthOutward);
  FieldAnswer answer;
  answer.middle = clearance(field, x, radius + length, wanted);
  const F8 room = answer.middle - radius;
  answer.apart = above(room, length);
  // Long segments hardly pass, and take longest.
  answer.worthQuery =
      above(room, set(-field.cell)) & below(length, set(2.0F * field.cell)) & ~answer.apart;
  const Lanes open = wanted & above(room, set(0.0F)) & ~answer.apart;
  if (open == 0) return answer;
  const V3 g = inFrame(field, segment.g, false);
  const F8 rest = set(0.5F) * (length - room);
  const F8 part = (room + rest) / larger(length, set(1e-20F));
  const F8 ahead = clearance(field, along(x, part, g), radius + rest, open) - radius;
  const F8 behind = clearance(field, along(x, -part, g), radius + rest, open) - radius;
  answer.apart |= open & above(smaller(ahead, behind), rest * set(kLengthOutward));
  answer.worthQuery &= ~answer.apart;
  return answer;
}

/// At most the square of the least distance between the segment and the obstacle. For fields use
/// askField().
HWY_INLINE F8 squaredDistance(const SimdObstacles& world, const SimdObstacle& obstacle,
                              const Segment& segment) {
  switch (obstacle.kind) {
    case ObstacleKind::Box:
      return squaredDistance(world.boxes[obstacle.first], segment);
    case ObstacleKind::Ball:
      return ballSquared(world.rounds[obstacle.first], segment);
    case ObstacleKind::Capsule:
      return capsuleSquared(world.rounds[obstacle.first], segment);
    case ObstacleKind::Cylinder:
      return cylinderSquared(world.rounds[obstacle.first], segment);
    case ObstacleKind::Cone:
      return coneSquared(world.rounds[obstacle.first], segment);
    case ObstacleKind::Ellipsoid:
      return ellipsoidSquared(world.ellipsoids[obstacle.first], segment);
    case ObstacleKind::Planes:
      return planesSquared(&world.planes[obstacle.first], obstacle.count, segment);
    case ObstacleKind::Slab:
      return slabSquared(world.planes[obstacle.first], segment);
    case ObstacleKind::Field:
      break;
  }
  return set(0.0F);
}

/// The same for a point.
HWY_INLINE F8 squaredDistance(const SimdObstacles& world, const SimdObstacle& obstacle,
                              const V3& point) {
  if (obstacle.kind == ObstacleKind::Box)
    return squaredDistance(world.boxes[obstacle.first], point);
  return squaredDistance(world, obstacle, Segment{point, set3({0.0F, 0.0F, 0.0F})});
}

}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
