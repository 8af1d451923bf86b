// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/StateSpace.h>

#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "default_sampler.hpp"
#include "swept/core/floating_point_environment.hpp"
namespace swept::detail {

/// The space of a whole group. OMPL registers its own projections, or none, whenever a space is set
/// up; the group's projection is registered after them.
template <typename Space>
class GroupSpace : public Space {
 public:
  using Space::Space;
  void setProjection(ompl::base::ProjectionEvaluatorPtr projection) {
    projection_ = std::move(projection);
  }
  /// The projection of the group, by name.
  void setVariables(std::vector<std::string> variables) { variables_ = std::move(variables); }
  const std::vector<std::string>& variables() const { return variables_; }
  ///@{
  /// The functions of the space itself, in the default environment.
  double distance(const ompl::base::State* a, const ompl::base::State* b) const override {
    if (inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return Space::distance(a, b); });
    }
    return Space::distance(a, b);
  }
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override {
    if (inForeignEnvironment()) {
      return inDefaultEnvironment([&, t] { Space::interpolate(from, to, t, state); });
    }
    Space::interpolate(from, to, t, state);
  }
  bool satisfiesBounds(const ompl::base::State* state) const override {
    if (inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return Space::satisfiesBounds(state); });
    }
    return Space::satisfiesBounds(state);
  }
  void enforceBounds(ompl::base::State* state) const override {
    inDefaultEnvironment([&] { Space::enforceBounds(state); });
  }
  double getMaximumExtent() const override {
    return inDefaultEnvironment([&] { return Space::getMaximumExtent(); });
  }
  double getMeasure() const override {
    return inDefaultEnvironment([&] { return Space::getMeasure(); });
  }
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override {
    return inDefaultEnvironment([this] { return sampler(); });
  }
  ///@}
  void registerProjections() override {
    Space::registerProjections();
    this->registerDefaultProjection(projection_);
  }

 private:
  /// The extent of a space that consists of several, combined as OMPL does.
  ompl::base::StateSamplerPtr sampler() const {
    if constexpr (std::is_same_v<Space, ompl::base::CompoundStateSpace>) {
      const auto all = std::make_shared<DefaultSampler<ompl::base::CompoundStateSampler>>(this);
      const bool weighed = !(this->weightSum_ < std::numeric_limits<double>::epsilon());
      for (unsigned i = 0; i < this->componentCount_; ++i)
        all->addSampler(this->components_[i]->allocStateSampler(),
                        weighed ? this->weights_[i] / this->weightSum_ : 1.0);
      return all;
    } else {
      return Space::allocDefaultStateSampler();
    }
  }

  ompl::base::ProjectionEvaluatorPtr projection_;
  std::vector<std::string> variables_;
};

}  // namespace swept::detail
