// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSampler.h>

#include "swept/core/floating_point_environment.hpp"

namespace swept::detail {

/// Draws the states of `Sampler` in the default floating-point environment. It has no random
/// numbers of its own: a seed gives the same states as for `Sampler`.
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
