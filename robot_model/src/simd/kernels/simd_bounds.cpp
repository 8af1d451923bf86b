// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/simd_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

/// V and d of the lemma, per body.
void boundTurning(const SimdModel& model, SimdScratch& scratch) {
  auto& [turning, excess, carried, driven, slid] = scratch.nested;
  turning[0] = 0.0;
  slid[0] = 0.0;
  for (const int body : model.allBodies) {
    const SimdBody& joint = model.bodies[body];
    const auto spin = static_cast<double>(scratch.motion[body].spin);
    slid[body] = slid[joint.parent] + static_cast<double>(scratch.motion[body].slid);
    turning[body] = turning[joint.parent] + spin;
    excess[body] = 0.0;
    if (joint.cosine < 0.0F) continue;
    const auto together = static_cast<double>(scratch.together[body]);
    const auto previous = static_cast<double>(scratch.motion[joint.parent].spin);
    const double past = turning[model.bodies[joint.parent].parent] + together;
    turning[body] = std::min(turning[body], past);
    excess[body] = std::max(0.0, previous + spin - together);
  }
}

void addAccelerations(const SimdJointMotion& joint, std::size_t at, SimdScratch& scratch) {
  scratch.turned[at] = (scratch.turned[at] + joint.spinAcceleration) * kBoundOutward;
  scratch.slid[at] = (scratch.slid[at] + joint.acceleration) * kBoundOutward;
}

/// What joints do in one unit of time: that of the motion, or that of L18's Q.
struct MotionRates {
  const SimdScratch& scratch;
  float spin(int body) const { return scratch.motion[body].spin; }
  float together(int body, int /*parent*/) const { return scratch.together[body]; }
  float speed(int body) const { return scratch.motion[body].speed; }
  float spinAcceleration(int body) const { return scratch.motion[body].spinAcceleration; }
  float acceleration(int body) const { return scratch.motion[body].acceleration; }
};

struct TubeRates {
  const SimdScratch& scratch;
  const std::vector<float>& errors;  ///< rad, per body
  float half;
  float spin(int body) const { return half * scratch.motion[body].spin + errors[body]; }
  float together(int body, int parent) const {
    return half * scratch.together[body] + errors[body] + errors[parent];
  }
  float speed(int body) const { return half * scratch.motion[body].speed; }
  float spinAcceleration(int body) const {
    return half * half * scratch.motion[body].spinAcceleration;
  }
  float acceleration(int body) const { return half * half * scratch.motion[body].acceleration; }
};

/// Like boundSteps, only for the joints of a path from the index `first` on: `turned` and `slid` of
/// the scratch, by their index.
template <typename Rates>
void boundPath(const SimdModel& model, const Rates& rates, const std::vector<int>& path,
               std::size_t first, SimdScratch& scratch) {
  float before = 0.0F;  // rad per unit t, of the body that the joint hangs on,
  float start = 0.0F;   // and of the one before that
  for (std::size_t i = first; i < path.size(); ++i) {
    const int body = path[i];
    const float spin = rates.spin(body);
    float next = before + spin;
    if (i > first && model.bodies[body].cosine >= 0.0F)
      next = std::min(next, start + rates.together(body, path[i - 1]));
    scratch.turned[i] = spin * (2.0F * before + spin) * kBoundOutward;
    scratch.slid[i] = 2.0F * rates.speed(body) * before * kBoundOutward;
    if (scratch.curved) {
      scratch.turned[i] = (scratch.turned[i] + rates.spinAcceleration(body)) * kBoundOutward;
      scratch.slid[i] = (scratch.slid[i] + rates.acceleration(body)) * kBoundOutward;
    }
    start = before;
    before = next * kBoundOutward;
  }
}

/// Of the points of a geometry, relative to a reference.
template <typename Rates>
float boundPoints(const SimdModel& model, const Rates& rates, int index, int geometry,
                  SimdScratch& scratch) {
  const int reference = model.references[index].body;
  const std::vector<int>& path = model.ancestors[model.geometryBody[geometry]];
  const std::size_t first = model.ancestors[reference].size();
  if (path.size() <= first || (first > 0 && path[first - 1] != reference)) return 0.0F;
  const SimdHull& hull = model.hulls->of[geometry];
  const float* arms = model.hulls->arms.data() + hull.firstArm;
  boundPath(model, rates, path, first, scratch);
  float sum = 0.0F;
  float beyond = 0.0F;  // m, of what slides
  for (std::size_t i = path.size(); i-- > first;) {
    sum += scratch.turned[i] * (arms[i] + beyond) + scratch.slid[i];
    if (hull.growsByAll) beyond += scratch.motion[path[i]].slid;
  }
  for (std::int32_t i = 0; i < hull.growthCount; ++i) {
    const SimdHulls::Growth& growth = model.hulls->growths[hull.firstGrowth + i];
    if (static_cast<std::size_t>(growth.joint) >= first)
      sum += scratch.turned[growth.joint] * growth.share * scratch.motion[growth.slide].slid;
  }
  // One rounding for each term, plus that of the last products.
  const auto terms = static_cast<float>(path.size() * (hull.growsByAll ? 2 : 1) + hull.growthCount);
  return sum * (kBoundOutward + kBoundPerTerm * terms);
}

}  // namespace

void addAccelerations(const SimdReference& reference, SimdScratch& scratch) {
  for (std::size_t i = 0; i < reference.steps.size(); ++i)
    addAccelerations(scratch.motion[reference.steps[i].body], i, scratch);
}

void boundCarried(const SimdModel& model, SimdScratch& scratch) {
  boundTurning(model, scratch);
  auto& [turning, excess, carried, driven, slid] = scratch.nested;
  std::ranges::fill(carried, 0.0);
  std::ranges::fill(driven, 0.0);
  const double rounding = kNestedRoundings * static_cast<double>(model.bodies.size());
  for (std::size_t at = model.bodies.size(); at-- > 1;) {
    const SimdCarried& joint = model.carried[at];
    const auto spin = static_cast<double>(scratch.motion[at].spin);
    const auto speed = static_cast<double>(scratch.motion[at].speed);
    const double spinAcceleration =
        scratch.curved ? static_cast<double>(scratch.motion[at].spinAcceleration) : 0.0;
    const double acceleration =
        scratch.curved ? static_cast<double>(scratch.motion[at].acceleration) : 0.0;
    const double around = turning[model.bodies[at].parent];
    const double less = around - excess[at];
    const double largest = around + excess[at];
    for (std::size_t i = 0; i < joint.bodies.size(); ++i) {
      const int body = joint.bodies[i];
      // The slides beyond this joint move the body away from its axis.
      const double grown = slid[body] - slid[at] + rounding * slid[body];
      const double arm = static_cast<double>(joint.arms[i]) + grown;
      const double own = (spin * spin + spinAcceleration) * arm + acceleration;
      if (joint.around >= 0) {
        const double sum = driven[body] + own - 2.0 * less * carried[body];
        const double error = rounding * (driven[body] + own + 2.0 * largest * carried[body]);
        const int slot = model.references[joint.around].slot[body];
        scratch.bounds[joint.around].acceleration[slot / kLanes].lane[slot % kLanes] =
            kBoundOutward * static_cast<float>(std::max(0.0, sum) + error);
      }
      const double moved = spin * arm + speed;
      carried[body] += moved;
      driven[body] += 2.0 * around * moved + own;
    }
  }
}

float accelerationOfPoints(const SimdModel& model, int reference, int geometry,
                           SimdScratch& scratch) {
  return boundPoints(model, MotionRates{scratch}, reference, geometry, scratch);
}

float tubeAccelerationOfPoints(const SimdModel& model, int reference, int geometry, float half,
                               SimdScratch& scratch) {
  return boundPoints(model, TubeRates{scratch, model.tubeTurn, half}, reference, geometry,
                     scratch) *
         kBoundOutward;
}

}  // namespace swept::detail
