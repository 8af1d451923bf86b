// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/simd_kinematics.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "simd/kernels/simd_kinematics.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "rounding/error_model.hpp"
#include "simd/kernels/f8.hpp"
#include "simd/kernels/simd_bounds.hpp"
#include "swept/core/simd_dispatch.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

/// For |angle| <= 128, both are within kSineError of the sine and cosine: L6 of ERROR_MODEL.md. The
/// parts of pi/2 have 8, 12 and 24 bits.
HWY_INLINE void sineCosine(const F8& angle, F8& sine, F8& cosine) {
  const F8 k = nearest(angle * set(0.636619772F));
  F8 r = subtractProduct(angle, k, set(1.5703125F));
  r = subtractProduct(r, k, set(4.83751296997e-4F));
  r = subtractProduct(r, k, set(7.54978999e-8F));
  const F8 z = r * r;
  F8 s = multiplyAdd(z, set(2.7557319e-6F), set(-1.98412698e-4F));
  s = multiplyAdd(z, s, set(8.3333333e-3F));
  s = multiplyAdd(z, s, set(-1.6666667e-1F));
  s = multiplyAdd(r * z, s, r);
  F8 c = multiplyAdd(z, set(2.4801587e-5F), set(-1.3888889e-3F));
  c = multiplyAdd(z, c, set(4.1666667e-2F));
  c = multiplyAdd(z, c, set(-0.5F));
  c = multiplyAdd(z, c, set(1.0F));
  const hn::RebindToSigned<Part> integers;
  for (int i = 0; i < kParts; ++i) {
    // Quarter turns: odd ones swap the two, the second bit of k (of k + 1) is the sign.
    const auto turns = hn::ConvertTo(integers, k.part[i]);
    const auto swap =
        hn::RebindMask(Part(), hn::Ne(hn::And(turns, hn::Set(integers, 1)), hn::Zero(integers)));
    const auto signS = hn::BitCast(Part(), hn::ShiftLeft<30>(hn::And(turns, hn::Set(integers, 2))));
    const auto signC = hn::BitCast(
        Part(),
        hn::ShiftLeft<30>(hn::And(hn::Add(turns, hn::Set(integers, 1)), hn::Set(integers, 2))));
    sine.part[i] = hn::Xor(hn::IfThenElse(swap, c.part[i], s.part[i]), signS);
    cosine.part[i] = hn::Xor(hn::IfThenElse(swap, s.part[i], c.part[i]), signC);
  }
}

struct M3 {
  F8 entry[9];  ///< row by row
};

HWY_INLINE M3 setMatrix(const float (&m)[9]) {
  M3 r;
  for (int i = 0; i < 9; ++i) r.entry[i] = set(m[i]);
  return r;
}

/// A row of a product with a matrix on the right.
HWY_INLINE V3 rowTimes(const Row* row, const M3& m) {
  const F8 a = load(row[0]);
  const F8 b = load(row[1]);
  const F8 c = load(row[2]);
  return {multiplyAdd(a, m.entry[0], multiplyAdd(b, m.entry[3], c * m.entry[6])),
          multiplyAdd(a, m.entry[1], multiplyAdd(b, m.entry[4], c * m.entry[7])),
          multiplyAdd(a, m.entry[2], multiplyAdd(b, m.entry[5], c * m.entry[8]))};
}

HWY_INLINE void turnAfter(const float (&after)[9], SimdBodyState& state) {
  const M3 matrix = setMatrix(after);
  for (std::size_t i = 0; i < 3; ++i) {
    const V3 row = rowTimes(state.rotation + 3 * i, matrix);
    store(row.x, state.rotation[3 * i]);
    store(row.y, state.rotation[3 * i + 1]);
    store(row.z, state.rotation[3 * i + 2]);
  }
}

/// The joint's axis is the frame's z axis, except for a floating joint: its axis is left in
/// `angular`.
HWY_INLINE void placeFrame(const SimdBody& body, const SimdJointMotion& motion, const Row& angle,
                           const Row* slide, const SimdBodyState& parent, SimdBodyState& state) {
  V3 offset = set3(body.translation);
  if (slides(body.kind)) offset = offset + V3{load(slide[0]), load(slide[1]), load(slide[2])};
  store3(addRotated(load3(parent.origin), parent.rotation, offset), state.origin);
  F8 sine = set(0.0F);
  F8 cosine = set(1.0F);
  if (turns(body.kind)) sineCosine(load(angle), sine, cosine);
  const bool floating = floats(body.kind);
  const M3 turned = setMatrix(floating ? motion.rotation : body.rotation);
  for (std::size_t i = 0; i < 3; ++i) {
    const V3 row = rowTimes(parent.rotation + 3 * i, turned);
    store(multiplyAdd(cosine, row.x, sine * row.y), state.rotation[3 * i]);
    store(subtractProduct(cosine * row.y, sine, row.x), state.rotation[3 * i + 1]);
    store(row.z, state.rotation[3 * i + 2]);
    if (floating) store(row.z, state.angular[i]);
  }
  if (floating) turnAfter(motion.after, state);
}

/// The rates of the joints in the lanes.
struct Rates {
  F8 turn;   ///< rad per unit t
  V3 slide;  ///< m per unit t
};

template <bool kGiven>
HWY_INLINE Rates ratesOf(const SimdJointMotion& motion, const SimdBlock& block, int body) {
  if constexpr (!kGiven) return {set(motion.angleRate), set3(motion.slideRate)};
  const Row* slide = &block.slideRate[3 * static_cast<std::size_t>(body)];
  return {load(block.angleRate[body]), {load(slide[0]), load(slide[1]), load(slide[2])}};
}

HWY_INLINE void placeVelocity(const SimdBody& body, const Rates& rates, const SimdBodyState& parent,
                              SimdBodyState& state) {
  V3 linear = load3(parent.linear);
  V3 angular = load3(parent.angular);
  if (slides(body.kind)) linear = addRotated(linear, parent.rotation, rates.slide);
  if (turns(body.kind)) {
    const auto& r = state.rotation;
    const V3 axis =
        floats(body.kind) ? load3(state.angular) : V3{load(r[2]), load(r[5]), load(r[8])};
    const V3 spin = rates.turn * axis;
    angular = angular + spin;
    linear = addCross(linear, load3(state.origin), spin);  // - spin x origin
  }
  store3(angular, state.angular);
  store3(linear, state.linear);
}

template <bool kGiven>
HWY_INLINE void placeFrames(const SimdModel& model, const SimdJointMotion* motion,
                            std::span<const int> bodies, SimdBlock& block) {
  const F8 time = load(block.time);
  for (const int b : bodies) {
    const SimdBody& body = model.bodies[b];
    const SimdJointMotion& joint = motion[b];
    Row* slide = &block.slide[3 * static_cast<std::size_t>(b)];
    if constexpr (!kGiven) {
      store(multiplyAdd(time, set(joint.angleRate), set(joint.angle)), block.angle[b]);
      if (slides(body.kind))
        for (int i = 0; i < 3; ++i)
          store(multiplyAdd(time, set(joint.slideRate[i]), set(joint.slide[i])), slide[i]);
    }
    SimdBodyState& state = block.states[b];
    placeFrame(body, joint, block.angle[b], slide, block.states[body.parent], state);
    if (model.rootOfBody[b] < 0) continue;
    const SimdNode& root = model.nodes[model.rootOfBody[b]];
    store3(addRotated(load3(state.origin), state.rotation, set3(root.center)), block.roots[b].at);
  }
}

template <bool kGiven>
HWY_INLINE void placeVelocities(const SimdModel& model, const SimdJointMotion* motion,
                                std::span<const int> bodies, SimdBlock& block) {
  const F8 half = load(block.half);
  for (const int b : bodies) {
    const SimdBody& body = model.bodies[b];
    SimdBodyState& state = block.states[b];
    placeVelocity(body, ratesOf<kGiven>(motion[b], block, b), block.states[body.parent], state);
    if (model.rootOfBody[b] < 0) continue;
    SimdRoot& root = block.roots[b];
    const V3 velocity = addCross(load3(state.linear), load3(state.angular), load3(root.at));
    store3(half * velocity, root.by);
  }
}

void Frames(const SimdModel& model, const SimdJointMotion* motion, std::span<const int> bodies,
            SimdBlock& block) {
  block.given ? placeFrames<true>(model, motion, bodies, block)
              : placeFrames<false>(model, motion, bodies, block);
}

void Velocities(const SimdModel& model, const SimdJointMotion* motion, std::span<const int> bodies,
                SimdBlock& block) {
  block.given ? placeVelocities<true>(model, motion, bodies, block)
              : placeVelocities<false>(model, motion, bodies, block);
}

/// Of each body and its parent, where both only turn about axes at a constant angle.
HWY_INLINE void boundTogether(const SimdModel& model, SimdScratch& scratch) {
  for (const int body : model.allBodies) {
    const SimdBody& joint = model.bodies[body];
    if (joint.cosine < 0.0F) continue;
    const float spin = scratch.motion[body].spin;
    const float previous = scratch.motion[joint.parent].spin;
    scratch.together[body] = kBoundOutward * std::sqrt(previous * previous + spin * spin +
                                                       2.0F * previous * spin * joint.cosine);
  }
}

template <bool kCurved>
HWY_INLINE void boundReference(const SimdModel& model, std::size_t k, SimdScratch& scratch) {
  const SimdReference& reference = model.references[k];
  boundSteps(reference, scratch);
  if constexpr (kCurved) addAccelerations(reference, scratch);
  const std::size_t steps = reference.steps.size();
  const auto rows = static_cast<std::size_t>(reference.rows);
  for (std::size_t r = 0; r < rows; ++r) {
    F8 sum = set(0.0F);
    for (std::size_t i = 0; i < steps; ++i)
      sum = multiplyAdd(set(scratch.turned[i]), load(reference.arms[i * rows + r]), sum);
    if (model.slides)
      for (std::size_t i = 0; i < steps; ++i)
        sum = multiplyAdd(set(scratch.slid[i]), load(reference.carried[i * rows + r]), sum);
    for (const SimdReference::Growth& growth : reference.growths) {
      const F8 slid = set(scratch.motion[growth.slide].slid);
      for (std::size_t i = 0; i < steps; ++i)
        sum = multiplyAdd(set(scratch.turned[i]) * slid, load(growth.shares[i * rows + r]), sum);
    }
    // One rounding for each term, plus that of the last products.
    const float outward =
        kBoundOutward + kBoundPerTerm * static_cast<float>(steps * (1 + reference.growths.size()));
    store(sum * set(outward), scratch.bounds[k].acceleration[r]);
  }
}

void Bound(const SimdModel& model, SimdScratch& scratch) {
  boundTogether(model, scratch);
  if (!model.carried.empty()) return boundCarried(model, scratch);
  scratch.curved ? boundReference<true>(model, 0, scratch)
                 : boundReference<false>(model, 0, scratch);
}

void BoundLinks(const SimdModel& model, SimdScratch& scratch) {
  if (!model.carried.empty()) return;
  for (std::size_t k = 1; k < model.references.size(); ++k)
    scratch.curved ? boundReference<true>(model, k, scratch)
                   : boundReference<false>(model, k, scratch);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swept::detail {

SWEPT_DISPATCH_TABLE(Frames);
SWEPT_DISPATCH_TABLE(Velocities);
SWEPT_DISPATCH_TABLE(Bound);
SWEPT_DISPATCH_TABLE(BoundLinks);

void placeFrames(const SimdModel& model, const std::vector<SimdJointMotion>& motion,
                 std::span<const int> bodies, SimdBlock& block) {
  SWEPT_DISPATCH(Frames)(model, motion.data(), bodies, block);
}

void placeVelocities(const SimdModel& model, const std::vector<SimdJointMotion>& motion,
                     std::span<const int> bodies, SimdBlock& block) {
  SWEPT_DISPATCH(Velocities)(model, motion.data(), bodies, block);
}

void placeBodies(const SimdModel& model, const std::vector<SimdJointMotion>& motion,
                 std::span<const int> bodies, SimdBlock& block) {
  placeFrames(model, motion, bodies, block);
  if (block.mode == SimdMode::Motion) placeVelocities(model, motion, bodies, block);
}

void boundMotion(const SimdModel& model, SimdScratch& scratch) {
  SWEPT_DISPATCH(Bound)(model, scratch);
}

void boundMotionOfLinks(const SimdModel& model, SimdScratch& scratch) {
  SWEPT_DISPATCH(BoundLinks)(model, scratch);
}

}  // namespace swept::detail
#endif
