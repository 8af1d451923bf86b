// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/ProjectionEvaluator.h>

#include <string>
#include <utility>
#include <vector>

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
  void registerProjections() override {
    Space::registerProjections();
    this->registerDefaultProjection(projection_);
  }

 private:
  ompl::base::ProjectionEvaluatorPtr projection_;
  std::vector<std::string> variables_;
};

}  // namespace swept::detail
