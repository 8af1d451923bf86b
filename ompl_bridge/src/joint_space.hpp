// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <vector>

namespace swept::detail {

/// Joints with limits, each with a factor in the distance.
class JointSpace : public ompl::base::RealVectorStateSpace {
 public:
  /// The result of allocState: its values follow it in memory, so that reading them needs one jump,
  /// not two.
  class JointState final : public StateType {
   public:
    explicit JointState(const JointSpace& space) : space_(&space) {}
    const JointSpace& space() const { return *space_; }

   private:
    const JointSpace* space_;
  };

  explicit JointSpace(std::vector<double> weights);

  const std::vector<double>& weights() const { return weights_; }
  double distance(const ompl::base::State* a, const ompl::base::State* b) const override;
  double getMaximumExtent() const override;
  /// Accepts values as far beyond the bounds as isWithin(): the limit in single precision is a
  /// state, too. Samples and enforceBounds() stay within the bounds themselves.
  bool satisfiesBounds(const ompl::base::State* state) const override;
  /// From ranges times weights, as in OMPL's compound spaces: planners derive radii from it.
  double getMeasure() const override;
  /// Its distances and deviations are those of the space: a joint's is divided by its weight.
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override;
  ompl::base::State* allocState() const override;
  void freeState(ompl::base::State* state) const override;

 private:
  std::vector<double> weights_;
};

/// Null for a state that no JointSpace has made.
const JointSpace::JointState* asJointState(const ompl::base::State* state);

}  // namespace swept::detail
