// SPDX-License-Identifier: BSD-3-Clause
#include "joint_space.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <new>
#include <typeinfo>
#include <utility>

#include "default_sampler.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept::detail {

namespace ob = ompl::base;

namespace {

class Sampler : public ob::RealVectorStateSampler {
 public:
  explicit Sampler(const JointSpace& space) : RealVectorStateSampler(&space), joints_(space) {}

  void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
    forEachJoint(state, near, distance, [&](double value, double reach, double low, double high) {
      return rng_.uniformReal(std::max(low, value - reach), std::min(high, value + reach));
    });
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
    forEachJoint(state, mean, deviation, [&](double value, double reach, double low, double high) {
      return std::clamp(rng_.gaussian(value, reach), low, high);
    });
  }

 private:
  void forEachJoint(ob::State* state, const ob::State* from, double distance, const auto& sample) {
    const ob::RealVectorBounds& bounds = joints_.getBounds();
    const double* values = from->as<ob::RealVectorStateSpace::StateType>()->values;
    double* sampled = state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (std::size_t i = 0; i < joints_.weights().size(); ++i)
      sampled[i] =
          sample(values[i], distance / joints_.weights()[i], bounds.low[i], bounds.high[i]);
  }

  const JointSpace& joints_;
};

}  // namespace

JointSpace::JointSpace(std::vector<double> weights)
    : RealVectorStateSpace(static_cast<unsigned int>(weights.size())),
      weights_(std::move(weights)) {}

double JointSpace::distance(const ob::State* a, const ob::State* b) const {
  const double* from = a->as<StateType>()->values;
  const double* to = b->as<StateType>()->values;
  double sum = 0.0;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const double difference = weights_[i] * (to[i] - from[i]);
    sum += difference * difference;
  }
  return std::sqrt(sum);
}

double JointSpace::getMaximumExtent() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const double range = weights_[i] * (bounds_.high[i] - bounds_.low[i]);
    sum += range * range;
  }
  return std::sqrt(sum);
}

bool JointSpace::satisfiesBounds(const ob::State* state) const {
  const double* values = state->as<StateType>()->values;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    // NaN passes, as it does in OMPL's own space: no checker calls it valid.
    if (!isWithin(values[i], bounds_.low[i], bounds_.high[i]) && !std::isnan(values[i]))
      return false;
  }
  return true;
}

double JointSpace::getMeasure() const {
  double measure = RealVectorStateSpace::getMeasure();
  for (const double weight : weights_) measure *= weight;
  return measure;
}

ob::StateSamplerPtr JointSpace::allocDefaultStateSampler() const {
  return std::make_shared<DefaultSampler<Sampler>>(*this);
}

ob::State* JointSpace::allocState() const {
  static_assert(sizeof(JointState) % alignof(double) == 0);
  void* memory = ::operator new(sizeof(JointState) + weights_.size() * sizeof(double));
  auto* state = new (memory) JointState(*this);
  state->values =
      new (static_cast<std::byte*>(memory) + sizeof(JointState)) double[weights_.size()];
  return state;
}

void JointSpace::freeState(ob::State* state) const {
  auto* joints = static_cast<JointState*>(state);
  joints->~JointState();
  ::operator delete(joints);
}

const JointSpace::JointState* asJointState(const ob::State* state) {
  if (typeid(*state) != typeid(JointSpace::JointState)) return nullptr;
  return static_cast<const JointSpace::JointState*>(state);
}

}  // namespace swept::detail
