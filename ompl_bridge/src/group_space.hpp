// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/ProjectionEvaluator.h>

#include <string>
#include <utility>
#include <vector>

#include "swept/core/floating_point_environment.hpp"
namespace swept::detail {

/// A whole group's space. OMPL registers projections of its own, or none, whenever a space is set
/// up; the group's comes after them.
template <typename Space>
class GroupSpace : public Space {
 public:
  using Space::Space;
  void setProjection(ompl::base::ProjectionEvaluatorPtr projection) {
    projection_ = std::move(projection);
  }
  /// Of the group, by name.
  void setVariables(std::vector<std::string> variables) { variables_ = std::move(variables); }
  const std::vector<std::string>& variables() const { return variables_; }
  ///@{
  /// The space's own, in the default environment.
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
  double getMaximumExtent() const override {
    return inDefaultEnvironment([&] { return Space::getMaximumExtent(); });
  }
  double getMeasure() const override {
    return inDefaultEnvironment([&] { return Space::getMeasure(); });
  }
  ///@}
  void registerProjections() override {
    Space::registerProjections();
    this->registerDefaultProjection(projection_);
  }

 private:
  ompl::base::ProjectionEvaluatorPtr projection_;
  std::vector<std::string> variables_;
};

}  // namespace swept::detail
