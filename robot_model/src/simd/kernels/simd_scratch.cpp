// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/simd_scratch.hpp"

#include "simd/compile/simd_model.hpp"

namespace swept::detail {

SimdScratch::SimdScratch(const SimdModel& model) {
  if (!model.usable) return;
  motion.resize(model.bodies.size());
  bounds.resize(model.references.size());
  for (std::size_t i = 0; i < bounds.size(); ++i)
    bounds[i].acceleration.resize(model.references[i].rows, Row{});
  for (auto* perStep : {&together, &turning, &turned, &slid})
    perStep->resize(model.bodies.size(), 0.0F);
  if (!model.carried.empty())
    for (auto* perBody :
         {&nested.turning, &nested.excess, &nested.carried, &nested.driven, &nested.slid})
      perBody->resize(model.bodies.size(), 0.0);
  block.angle.resize(model.bodies.size(), Row{});
  block.slide.resize(3 * model.bodies.size(), Row{});
  block.states.resize(model.bodies.size());
  block.roots.resize(model.bodies.size());
  rootsOfEight.resize((model.bodies.size() + kLanes - 1) / kLanes);
  restBase(model);
  block.openLanes.resize(model.sources.size());
  block.finalLanes.resize(model.sources.size());
  wantedLanes.resize(model.sources.size());
}

/// The model frame never moves.
void SimdScratch::restBase(const SimdModel& model) {
  SimdBodyState& base = block.states[0];
  base = SimdBodyState{};
  for (const int diagonal : {0, 4, 8})
    for (float& value : base.rotation[diagonal].lane) value = 1.0F;
  if (model.rootOfBody[0] < 0) return;
  for (int i = 0; i < 3; ++i)
    for (float& value : block.roots[0].at[i].lane)
      value = model.nodes[model.rootOfBody[0]].center[i];
}

}  // namespace swept::detail
