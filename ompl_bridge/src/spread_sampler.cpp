// SPDX-License-Identifier: BSD-3-Clause
#include "spread_sampler.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>
#include <ompl/base/spaces/SO3StateSpace.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace swept::detail {

namespace {

namespace ob = ompl::base;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The least prime above a number.
int nextPrime(int number) {
  for (;;) {
    ++number;
    bool isPrime = true;
    for (int i = 2; i * i <= number; ++i) isPrime = isPrime && number % i != 0;
    if (isPrime) return number;
  }
}

/// Uniform in SO(3) (K. Shoemake, Uniform random rotations, 1992).
void rotate(const double* u, ob::SO3StateSpace::StateType& state) {
  const double inner = std::sqrt(1.0 - u[0]);
  const double outer = std::sqrt(u[0]);
  state.x = inner * std::sin(kTurn * u[1]);
  state.y = inner * std::cos(kTurn * u[1]);
  state.z = outer * std::sin(kTurn * u[2]);
  state.w = outer * std::cos(kTurn * u[2]);
}

}  // namespace

SpreadSampler::SpreadSampler(const ob::StateSpacePtr& space, std::uint32_t seed) : space_(space) {
  if (!addDimensions(*space)) {
    others_ = space->allocStateSampler();
    return;
  }
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> anywhere;
  int prime = 1;
  for (std::size_t i = 0; i < dimensions_; ++i) {
    prime = nextPrime(prime);
    const double root = std::sqrt(static_cast<double>(prime));
    steps_.push_back(root - std::floor(root));
    place_.push_back(anywhere(random));
  }
}

bool SpreadSampler::addDimensions(const ob::StateSpace& space) {
  if (dynamic_cast<const ob::RealVectorStateSpace*>(&space) != nullptr) {
    dimensions_ += space.getDimension();
  } else if (dynamic_cast<const ob::SO2StateSpace*>(&space) != nullptr) {
    dimensions_ += 1;
  } else if (dynamic_cast<const ob::SO3StateSpace*>(&space) != nullptr) {
    dimensions_ += 3;
  } else if (const auto* compound = dynamic_cast<const ob::CompoundStateSpace*>(&space)) {
    for (unsigned i = 0; i < compound->getSubspaceCount(); ++i)
      if (!addDimensions(*compound->getSubspace(i))) return false;
  } else {
    return false;
  }
  return true;
}

void SpreadSampler::sample(ob::State* state) {
  if (others_) return others_->sampleUniform(state);
  for (std::size_t i = 0; i < dimensions_; ++i) {
    place_[i] += steps_[i];
    if (place_[i] >= 1.0) place_[i] -= 1.0;
  }
  std::size_t at = 0;
  place(*space_, state, at);
}

void SpreadSampler::place(const ob::StateSpace& space, ob::State* state, std::size_t& at) const {
  if (const auto* vector = dynamic_cast<const ob::RealVectorStateSpace*>(&space)) {
    const ob::RealVectorBounds& bounds = vector->getBounds();
    double* const values = state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (unsigned i = 0; i < space.getDimension(); ++i, ++at)
      values[i] =
          std::min(bounds.low[i] + place_[at] * (bounds.high[i] - bounds.low[i]), bounds.high[i]);
  } else if (dynamic_cast<const ob::SO2StateSpace*>(&space) != nullptr) {
    state->as<ob::SO2StateSpace::StateType>()->value = kTurn * place_[at] - std::numbers::pi;
    at += 1;
  } else if (dynamic_cast<const ob::SO3StateSpace*>(&space) != nullptr) {
    rotate(place_.data() + at, *state->as<ob::SO3StateSpace::StateType>());
    at += 3;
  } else {
    const auto& compound = static_cast<const ob::CompoundStateSpace&>(space);
    for (unsigned i = 0; i < compound.getSubspaceCount(); ++i)
      place(*compound.getSubspace(i), state->as<ob::CompoundState>()->components[i], at);
  }
}

}  // namespace swept::detail
