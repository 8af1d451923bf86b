// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Factor that exceeds the few roundings of a bound.
inline constexpr float kOutward = 1.0F + 4e-6F;

/// Bounds on the angular velocity of each step's body relative to the reference, and the resulting
/// factors of the lever arms: `turning`, `turned` and `slid` of the scratch. The lemma is
/// boundMotion's.
inline void boundSteps(const SimdReference& reference, SimdScratch& scratch) {
  float* turning = scratch.turning.data();
  for (std::size_t i = 0; i < reference.steps.size(); ++i) {
    const SimdReference::Step& step = reference.steps[i];
    const SimdJointMotion& joint = scratch.motion[step.body];
    const float before = step.parent < 0 ? 0.0F : turning[step.parent];
    float next = before + joint.spin;
    if (step.turnsAfter) {
      const float start = step.grandparent < 0 ? 0.0F : turning[step.grandparent];
      next = std::min(next, start + scratch.together[step.body]);
    }
    turning[i] = next * kOutward;
    scratch.turned[i] = joint.spin * (2.0F * before + joint.spin) * kOutward;
    scratch.slid[i] = 2.0F * joint.speed * before * kOutward;
  }
}

/// The contribution of the joints' own accelerations.
void addAccelerations(const SimdReference& reference, SimdScratch& scratch);

/// SimdScratch::bounds from SimdModel::carried, in time proportional to the number of lever arms:
/// for every body relative to each of its ancestors that is a reference. The lemma is that of
/// nestedMotionBounds, with boundMotion's data of the joints.
void boundCarried(const SimdModel& model, SimdScratch& scratch);

/// m per unit t squared; bounds the acceleration of every point of the geometry relative to the
/// reference.
float accelerationOfPoints(const SimdModel& model, int reference, int geometry,
                           SimdScratch& scratch);

}  // namespace swept::detail
