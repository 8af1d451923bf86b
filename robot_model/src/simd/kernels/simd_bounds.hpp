// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "rounding/error_model.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Bounds on the angular velocity of each step's body relative to the reference, and what comes of
/// it for the arms: `turning`, `turned` and `slid` of the scratch. By L3 of ERROR_MODEL.md.
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
    turning[i] = next * kBoundOutward;
    scratch.turned[i] = joint.spin * (2.0F * before + joint.spin) * kBoundOutward;
    scratch.slid[i] = 2.0F * joint.speed * before * kBoundOutward;
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

/// m; the same for the motions Q of L18 of ERROR_MODEL.md, per square of their unit, in intervals
/// of up to `half` on either side. Joints between the two err by turns alone.
float tubeAccelerationOfPoints(const SimdModel& model, int reference, int geometry, float half,
                               SimdScratch& scratch);

}  // namespace swept::detail
