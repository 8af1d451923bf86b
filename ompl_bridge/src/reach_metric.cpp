// SPDX-License-Identifier: BSD-3-Clause
#include "reach_metric.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "group_space.hpp"
#include "joint_reach.hpp"
#include "joint_space.hpp"
#include "state_layout.hpp"
#include "used_checker.hpp"

namespace swept::detail {

namespace {

namespace ob = ompl::base;

/// Of the largest factor. A joint that moves next to nothing still has a distance.
constexpr double kLeastFactor = 0.05;

}  // namespace

ReachMetric::ReachMetric(const ob::SpaceInformation& si) : space_(si.getStateSpace().get()) {
  if (addParts(si)) normalize();
}

/// Factors are as jointReach() has them.
bool ReachMetric::addParts(const ob::SpaceInformation& si) {
  const std::shared_ptr<const Checker> checker = checkerOf(si);
  if (checker == nullptr) return false;
  const auto* compound = dynamic_cast<const GroupSpace<ob::CompoundStateSpace>*>(space_);
  isCompound_ = compound != nullptr;
  if (!isCompound_ && dynamic_cast<const JointSpace*>(space_) == nullptr) return false;
  const std::vector<JointRun> runs = jointRuns(checker->robot(), checker->group());
  if (runs.size() != (isCompound_ ? compound->getSubspaceCount() : 1)) return false;
  const std::vector<double> reach = jointReach(*checker);
  std::vector<Part> parts;
  for (const JointRun& run : runs) {
    Part part;
    part.space = space_;
    if (isCompound_) {
      const auto index = static_cast<unsigned>(parts.size());
      part.space = compound->getSubspace(index).get();
      part.weight = compound->getSubspaceWeight(index);
    }
    const auto* joints = dynamic_cast<const JointSpace*>(part.space);
    part.ofJoints = joints != nullptr;
    for (const int joint : run.joints) {
      part.factors.push_back(reach[static_cast<std::size_t>(joint)]);
    }
    if (part.factors.size() != (part.ofJoints ? joints->weights().size() : 1)) return false;
    parts.push_back(std::move(part));
  }
  parts_ = std::move(parts);
  return true;
}

void ReachMetric::normalize() {
  double largest = 0.0, squares = 0.0;
  std::size_t count = 0;
  for (const Part& part : parts_) {
    for (const double factor : part.factors) largest = std::max(largest, factor);
  }
  if (!(largest > 0.0)) return parts_.clear();
  for (Part& part : parts_) {
    for (double& factor : part.factors) {
      factor = std::max(factor, kLeastFactor * largest);
      squares += factor * factor;
      ++count;
    }
  }
  const double scale = std::sqrt(static_cast<double>(count) / squares);
  for (Part& part : parts_) {
    for (double& factor : part.factors) factor *= scale;
  }
}

double ReachMetric::distance(const ob::State* a, const ob::State* b) const {
  if (parts_.empty()) return space_->distance(a, b);
  double sum = 0.0;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    const ob::State* const from = isCompound_ ? a->as<ob::CompoundState>()->components[i] : a;
    const ob::State* const to = isCompound_ ? b->as<ob::CompoundState>()->components[i] : b;
    if (!part.ofJoints) {
      sum += part.weight * part.factors.front() * part.space->distance(from, to);
      continue;
    }
    const auto& joints = static_cast<const JointSpace&>(*part.space);
    const double* const start = from->as<JointSpace::StateType>()->values;
    const double* const end = to->as<JointSpace::StateType>()->values;
    double squares = 0.0;
    for (std::size_t j = 0; j < part.factors.size(); ++j) {
      const double difference = part.factors[j] * joints.weights()[j] * (end[j] - start[j]);
      squares += difference * difference;
    }
    sum += part.weight * std::sqrt(squares);
  }
  return sum;
}

std::vector<double> ReachMetric::jointFactors() const {
  return parts_.empty() || isCompound_ ? std::vector<double>() : parts_.front().factors;
}

}  // namespace swept::detail
