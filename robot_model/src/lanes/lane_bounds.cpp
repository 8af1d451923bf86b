// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/lane_bounds.hpp"

namespace swept::detail {

float accelerationOfPoints(const LaneModel& model, int index, int geometry, LaneScratch& scratch) {
  const LaneReference& reference = model.references[index];
  boundSteps(reference, scratch);
  const std::vector<int>& path = model.ancestors[model.geometryBody[geometry]];
  const float* arms = model.hulls->arms.data() + model.hulls->of[geometry].firstArm;
  float sum = 0.0F;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const int step = reference.slot[path[i]];
    if (step >= 0) sum += scratch.turned[step] * arms[i] + scratch.slid[step];
  }
  // One rounding for each step, and what the last product rounds.
  return sum * (kOutward + 0x1p-22F * static_cast<float>(path.size()));
}

}  // namespace swept::detail
