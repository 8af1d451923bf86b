// SPDX-License-Identifier: BSD-3-Clause
#include "projection.hpp"

#include <ompl/base/ProjectionEvaluator.h>

#include <algorithm>
#include <memory>

namespace swept {
namespace {

class LeadingValues : public ompl::base::ProjectionEvaluator {
 public:
  using ProjectionEvaluator::ProjectionEvaluator;

  unsigned int getDimension() const override { return std::min(2u, space_->getDimension()); }
  void project(const ompl::base::State* state,
               Eigen::Ref<Eigen::VectorXd> projection) const override {
    for (unsigned int i = 0; i < getDimension(); ++i)
      projection[i] = *space_->getValueAddressAtIndex(state, i);
  }
};

}  // namespace

void registerProjection(ompl::base::StateSpace& space) {
  if (space.getDimension() > 2 && space.hasDefaultProjection()) return;
  space.registerDefaultProjection(std::make_shared<LeadingValues>(&space));
}

}  // namespace swept
