// SPDX-License-Identifier: BSD-3-Clause
// Constraints on eight sub-intervals at once: the lemmas of constraint_proof.cpp in single
// precision, with frames and velocities that tier 1 needs anyway.
//
// Lemma. Let e be motionRounding() for a reach of 1 and nothing that slides (of a direction), or
// for the numbers that place a point. Then x(m) and h x'(m), as an observer that rests sees them,
// are together off by no more than e, and by 4 e if the observer moves.
// Proof: a direction is a point of the same chain without translations, at a distance of at most 1
// from all origins, so L6 and L7 of ERROR_MODEL.md hold with a reach of 1; of its 88 u (1 + S / 2)
// to spare, u a unit roundoff, the vector's own entries take 2, three products with a matrix (of
// carrier, frame and region) 5 each, the entries of the last two 2 each, and what is compared (a
// norm, a sum, a product with a unit vector) 8. A point takes as much of its reach, which counts
// the frame's origin; a region's center is added. If the observer moves, its origin and its
// velocity field at the point are off by e each, and its axes turn what is seen by as much as a
// direction is off: the numbers that place it bound what they turn.
//
// Rotation vectors v of M. Let s be that of (M - M^T) / 2, |s| = sin f for f = |v|, and y = 1 - cos
// f, from the trace. f / sin f = 1 + y / 3 + 2 y^2 / 15 + ..., all of whose coefficients are
// positive, so that for y <= 1 it is between 1 + y / 3 + 2 y^2 / 15 and F = 1 + y / 3 + 0.2376 y^2
// (at y = 1 it is pi / 2). So v is within 0.1043 y^2 |s| of F s. If M is off by e, s is by e and y
// by 1.5 e; F has a slope of at most 0.81: F s is off by 3 e. For f <= pi / 2, c of
// rotation_vector.hpp is at most 0.0870, so J w is within 0.0870 f^2 |w| of w - v x w / 2, and what
// v and w are off by changes that by less than (1.27 + 1.5 |w|) e. The rest is
// rotation_vector.hpp's: 1.03 |w|^2 and pi / 2 times what is beyond. With |w| <= pi / 2 all e are
// together less than 10 e.
#include "simd/kernels/constraint_lanes.hpp"

#include <algorithm>
#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "simd/kernels/constraint_lanes.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/compile/single.hpp"
#include "simd/kernels/f8.hpp"
#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

/// A constant matrix, row by row, times a vector.
HWY_INLINE V3 times(const float (&m)[9], const V3& v) {
  const auto row = [&v](const float* r) HWY_ATTR {
    return multiplyAdd(set(r[0]), v.x, multiplyAdd(set(r[1]), v.y, set(r[2]) * v.z));
  };
  return {row(m), row(m + 3), row(m + 6)};
}

/// Where a vector is during the sub-intervals: at + s by, |s| <= 1, up to `beyond`.
struct Seen {
  V3 at, by;
  F8 beyond;
};

HWY_INLINE Seen seenAt(const LaneVector& vector, float beyond, const SimdBlock& block) {
  const SimdBodyState& carrier = block.states[static_cast<std::size_t>(vector.carrier)];
  const SimdBodyState& observer = block.states[static_cast<std::size_t>(vector.observer)];
  const F8 half = load(block.half);
  const V3 local = set3(vector.local);
  const F8 zero = set(0.0F);
  V3 p = addRotated(V3{zero, zero, zero}, carrier.rotation, local);
  V3 velocity{zero, zero, zero};
  V3 spin = load3(carrier.angular);
  if (vector.observer != 0) spin = spin - load3(observer.angular);
  V3 relative = p;
  if (!vector.isDirection) {
    p = p + load3(carrier.origin);
    relative = p - addRotated(load3(observer.origin), observer.rotation, set3(vector.origin));
    velocity = load3(carrier.linear) - load3(observer.linear);
  }
  velocity = half * addCross(velocity, spin, p);
  if (vector.observer != 0) {
    relative = turnedBack(observer.rotation, relative);
    velocity = turnedBack(observer.rotation, velocity);
  }
  return {times(vector.axes, relative), times(vector.axes, velocity), set(beyond)};
}

HWY_INLINE F8 across(const V3& v) {
  return root(multiplyAdd(v.x, v.x, v.y * v.y));
}
HWY_INLINE F8 lengthOf(const V3& v) {
  return root(dot(v, v));
}

HWY_INLINE Lanes tilted(const LaneConstraint& own, const Seen& axis) {
  const F8 lowest = axis.at.z - absolute(axis.by.z) - axis.beyond;
  const F8 sine = set(own.sine[0]);
  const Lanes byCosine = above(lowest, set(own.cosine[0]));
  if (own.wide[0]) return byCosine | above(across(axis.at) - across(axis.by) - axis.beyond, sine);
  const F8 farthest = larger(across(axis.at + axis.by), across(axis.at - axis.by)) + axis.beyond;
  return byCosine | (above(lowest, set(0.0F)) & above(sine, farthest));
}

/// Whether an angle is within its tolerance, by the products of a vector with (a, +-b), unit
/// vectors.
HWY_INLINE Lanes angleWithin(bool wide, float a, float b, const F8& atA, const F8& atB,
                             const F8& byA, const F8& byB, const F8& beyond) {
  const F8 fixed = set(a) * atA, turned = set(b) * atB;
  const F8 fixedBy = set(a) * byA, turnedBy = set(b) * byB;
  const Lanes first = above(fixed + turned - absolute(fixedBy + turnedBy), beyond);
  const Lanes second = above(fixed - turned - absolute(fixedBy - turnedBy), beyond);
  return wide ? first | second : first & second;
}

HWY_INLINE Lanes turnedAs(const LaneConstraint& own, const float (&beyond)[2],
                          const SimdBlock& block) {
  Lanes kept = kAllLanes;
  if (own.limited[0] || own.limited[1]) {
    const Seen z = seenAt(own.first, beyond[0], block);
    if (own.limited[0])
      kept &= angleWithin(own.wide[0], own.sine[0], own.cosine[0], z.at.z, z.at.y, z.by.z, z.by.y,
                          z.beyond);
    if (own.limited[1])
      kept &= above(set(own.sine[1]), absolute(z.at.x) + absolute(z.by.x) + z.beyond);
  }
  if (own.limited[2]) {
    const Seen x = seenAt(own.second, beyond[1], block);
    kept &= angleWithin(own.wide[2], own.sine[2], own.cosine[2], x.at.x, x.at.y, x.by.x, x.by.y,
                        x.beyond);
  }
  return kept;
}

HWY_INLINE Lanes isIn(const LaneRegion& region, const Seen& point, float beyond) {
  const V3 at = times(region.axes, point.at - set3(region.center));
  const V3 by = times(region.axes, point.by);
  const F8 more = set(beyond);
  const auto within = [&more](const F8& x, const F8& g, float half)
                          HWY_ATTR { return above(set(half), absolute(x) + absolute(g) + more); };
  switch (region.type) {
    case ConstraintRegion::Type::Box:
      return within(at.x, by.x, region.size[0]) & within(at.y, by.y, region.size[1]) &
             within(at.z, by.z, region.size[2]);
    case ConstraintRegion::Type::Cylinder:
      return within(at.z, by.z, region.size[1]) &
             above(set(region.size[0]), larger(across(at + by), across(at - by)) + more);
    case ConstraintRegion::Type::Sphere:
      break;
  }
  return above(set(region.size[0]), larger(lengthOf(at + by), lengthOf(at - by)) + more);
}

/// Columns of the matrix A R B of LaneConstraint, seen from the observer.
HWY_INLINE void placeColumns(const LaneConstraint& own, const SimdBlock& block, V3 (&columns)[3]) {
  const LaneVector& bodies = own.first;
  const SimdBodyState& carrier = block.states[static_cast<std::size_t>(bodies.carrier)];
  const SimdBodyState& observer = block.states[static_cast<std::size_t>(bodies.observer)];
  const F8 zero = set(0.0F);
  for (int c = 0; c < 3; ++c) {
    const V3 own3{set(own.turn[c]), set(own.turn[3 + c]), set(own.turn[6 + c])};
    V3 column = addRotated(V3{zero, zero, zero}, carrier.rotation, own3);
    if (bodies.observer != 0) column = turnedBack(observer.rotation, column);
    columns[c] = times(bodies.axes, column);
  }
}

/// `curved`: rad, what the spin's change does; `error`: e of the lemma.
HWY_INLINE Lanes vectorWithin(const LaneConstraint& own, float curved, float error,
                              const SimdBlock& block) {
  const LaneVector& bodies = own.first;
  V3 columns[3];
  placeColumns(own, block, columns);
  const F8 halfOne = set(0.5F);
  const V3 s = halfOne * V3{columns[1].z - columns[2].y, columns[2].x - columns[0].z,
                            columns[0].y - columns[1].x};
  const F8 y = halfOne * (set(3.0F) - columns[0].x - columns[1].y - columns[2].z);
  const SimdBodyState& carrier = block.states[static_cast<std::size_t>(bodies.carrier)];
  const SimdBodyState& observer = block.states[static_cast<std::size_t>(bodies.observer)];
  V3 spin = load3(carrier.angular);
  if (bodies.observer != 0) spin = turnedBack(observer.rotation, spin - load3(observer.angular));
  const V3 w = load(block.half) * times(bodies.axes, spin);
  const F8 all = lengthOf(w);
  const F8 sine = lengthOf(s);
  const F8 growth = multiplyAdd(y, multiplyAdd(y, set(0.2376F), set(0.33333334F)), set(1.0F));
  const V3 v = growth * s;
  const F8 angle = lengthOf(v);
  const V3 way = w - halfOne * cross(v, w);
  const F8 errors = set(10.0F * error);
  F8 more = set(0.0871F) * angle * angle + set(0.0522F) * y * y * sine;
  more = all * (more + set(1.031F) * all) + set(1.571F * curved) + errors;
  // The lemma is about angles of up to a right one.
  Lanes kept = above(set(0.99F), y) & above(set(1.5F), all + set(curved) + errors);
  const F8 at[] = {absolute(v.x) + absolute(way.x), absolute(v.y) + absolute(way.y),
                   absolute(v.z) + absolute(way.z)};
  for (int i = 0; i < 3; ++i)
    if (own.limited[i]) kept &= above(set(own.tolerance[i]), at[i] + more);
  return kept;
}

/// `beyond`: of `first` and of `second`; of vectors what is curved, and the error.
Lanes Kept(const LaneConstraint& own, const float (&beyond)[2], const SimdBlock& block) {
  switch (own.test) {
    case LaneTest::None:
      return 0;
    case LaneTest::Always:
      return kAllLanes;
    case LaneTest::Tilt:
      return tilted(own, seenAt(own.first, beyond[0], block));
    case LaneTest::Euler:
      return turnedAs(own, beyond, block);
    case LaneTest::RotationVector:
      return vectorWithin(own, beyond[0], beyond[1], block);
    case LaneTest::Regions:
      break;
  }
  const Seen point = seenAt(own.first, 0.0F, block);
  Lanes kept = 0;
  for (const LaneRegion& region : own.regions)
    kept |= isIn(region, point, beyond[0] + region.rounding);
  return kept;
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(Kept);

namespace {

/// L3 of ERROR_MODEL.md for one of the two ways, and the same of the body's own turn.
struct LaneMotion {
  double speed = 0.0;         ///< m per unit t, or of a direction
  double acceleration = 0.0;  ///< likewise, per unit t squared
  double turn = 0.0;          ///< rad per unit t
  double turnRate = 0.0;      ///< rad per unit t squared
};

LaneMotion boundAlong(const LanePath& path, bool isDirection, const SimdModel& model,
                      const SimdScratch& scratch) {
  LaneMotion bound;
  double before = 0.0;  // rad per unit t, of the parent
  for (std::size_t i = 0; i < path.bodies.size(); ++i) {
    const auto body = static_cast<std::size_t>(path.bodies[i]);
    const SimdJointMotion& joint = scratch.motion[body];
    const auto spin = static_cast<double>(joint.spin);
    const double turned = scratch.curved ? static_cast<double>(joint.spinAcceleration) : 0.0;
    bound.turnRate += bound.turn * spin + turned;
    if (!path.arms.empty()) {
      const double arm = path.arms[i];
      bound.speed += spin * arm;
      bound.acceleration += spin * arm * (2.0 * bound.turn + spin) + turned * arm;
    }
    if (!isDirection) {
      const auto speed = static_cast<double>(joint.speed);
      bound.speed += speed;
      bound.acceleration += 2.0 * speed * bound.turn;
      if (scratch.curved) bound.acceleration += static_cast<double>(joint.acceleration);
    }
    double next = bound.turn + spin;
    if (i > 0 && model.bodies[body].cosine >= 0.0F)
      next = std::min(next, before + static_cast<double>(scratch.together[body]));
    before = bound.turn;
    bound.turn = next;
  }
  return bound;
}

/// The lemma of constraint_proof.cpp and that above: how far a vector may be off its segment.
float beyondOf(const LaneVector& vector, const SimdModel& model, const MotionExtent& extent,
               const SimdScratch& scratch) {
  const auto half = static_cast<double>(scratch.block.half.lane[0]);
  const LaneMotion carried = boundAlong(vector.carried, vector.isDirection, model, scratch);
  double acceleration = carried.acceleration;
  const double size = vector.isDirection ? 1.0 : vector.magnitude + 2.0 * extent.slid;
  if (!vector.observed.bodies.empty()) {
    const LaneMotion observed = boundAlong(vector.observed, vector.isDirection, model, scratch);
    const double speed = carried.speed + observed.speed;
    const double turn = observed.turn;
    acceleration += observed.acceleration + size * (observed.turnRate + turn * turn) +
                    2.0 * turn * (speed + turn * size);
  }
  MotionExtent own = extent;
  own.reach = size;
  if (vector.isDirection) own.speeds = own.slid = own.slideError = 0.0;
  const double error = motionRounding(static_cast<double>(model.rounding), own);
  return singleAbove(
      (0.5 * half * half * acceleration + (vector.observer == 0 ? 1.0 : 4.0) * error) *
      kArithmeticOutward);
}

/// Of vectors: what their spin's change does, and e.
void boundTurns(const LaneVector& bodies, const SimdModel& model, const MotionExtent& extent,
                const SimdScratch& scratch, float (&beyond)[2]) {
  const auto half = static_cast<double>(scratch.block.half.lane[0]);
  const LaneMotion carried = boundAlong(bodies.carried, true, model, scratch);
  const LaneMotion observed = boundAlong(bodies.observed, true, model, scratch);
  const double rate = carried.turnRate + observed.turnRate + carried.turn * observed.turn;
  MotionExtent own = extent;
  own.reach = 1.0;
  own.speeds = own.slid = own.slideError = 0.0;
  const double error = motionRounding(static_cast<double>(model.rounding), own);
  beyond[0] = singleAbove(0.5 * half * half * rate * kArithmeticOutward);
  beyond[1] = singleAbove((bodies.observer == 0 ? 1.0 : 4.0) * error);
}

}  // namespace

void findKeptLanes(const LaneConstraints& constraints, const SimdModel& model,
                   const MotionExtent& extent, const SimdScratch& scratch,
                   std::span<std::uint8_t> kept) {
  for (std::size_t i = 0; i < constraints.constraints.size(); ++i) {
    const LaneConstraint& own = constraints.constraints[i];
    float beyond[2] = {};
    switch (own.test) {
      case LaneTest::Euler:
        if (own.limited[2]) beyond[1] = beyondOf(own.second, model, extent, scratch);
        [[fallthrough]];
      case LaneTest::Tilt:
      case LaneTest::Regions:
        beyond[0] = beyondOf(own.first, model, extent, scratch);
        break;
      case LaneTest::RotationVector:
        boundTurns(own.first, model, extent, scratch, beyond);
        break;
      case LaneTest::None:
      case LaneTest::Always:
        break;
    }
    kept[i] = static_cast<std::uint8_t>(SWEPT_DISPATCH(Kept)(own, beyond, scratch.block));
  }
}

}  // namespace swept::detail
#endif
