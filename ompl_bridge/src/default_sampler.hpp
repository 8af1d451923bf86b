// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSampler.h>

#include "swept/core/floating_point_environment.hpp"

namespace swept::detail {

/// Draws what `Sampler` draws, in the default floating-point environment. Has no random numbers of
/// its own: seeds give the states that they give to `Sampler`.
template <typename Sampler>
class DefaultSampler final : public Sampler {
 public:
  using Sampler::Sampler;

  void sampleUniform(ompl::base::State* state) override {
    inDefaultEnvironment([&] { Sampler::sampleUniform(state); });
  }
  void sampleUniformNear(ompl::base::State* state, const ompl::base::State* near,
                         double distance) override {
    inDefaultEnvironment([&] { Sampler::sampleUniformNear(state, near, distance); });
  }
  void sampleGaussian(ompl::base::State* state, const ompl::base::State* mean,
                      double deviation) override {
    inDefaultEnvironment([&] { Sampler::sampleGaussian(state, mean, deviation); });
  }
};

}  // namespace swept::detail
