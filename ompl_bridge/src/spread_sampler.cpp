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

constexpr double kFullTurn = 2.0 * std::numbers::pi;

/// The first numbers of neighbouring seeds are neighbours.
constexpr unsigned long long kWarmUp = 16;

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
  state.x = inner * std::sin(kFullTurn * u[1]);
  state.y = inner * std::cos(kFullTurn * u[1]);
  state.z = outer * std::sin(kFullTurn * u[2]);
  state.w = outer * std::cos(kFullTurn * u[2]);
}

void placeVector(const std::vector<double>& low, const std::vector<double>& width,
                 const ob::State* from, const ob::State* to, double margin, const double* unit,
                 ob::State* state) {
  using Values = ob::RealVectorStateSpace::StateType;
  double* const values = state->as<Values>()->values;
  for (std::size_t i = 0; i < low.size(); ++i) {
    double least = low[i], most = low[i] + width[i];
    if (from != nullptr) {
      const auto [less, more] =
          std::minmax(from->as<Values>()->values[i], to->as<Values>()->values[i]);
      least = std::clamp(less - margin, low[i], most);
      most = std::clamp(more + margin, least, most);
    }
    values[i] = least + unit[i] * (most - least);
  }
}

/// Along the shorter way between two angles.
void placeTurn(const ob::State* from, const ob::State* to, double margin, double unit,
               ob::State* state) {
  using Turn = ob::SO2StateSpace::StateType;
  double& value = state->as<Turn>()->value;
  value = kFullTurn * unit - std::numbers::pi;
  if (from == nullptr) return;
  const double half =
      0.5 * std::remainder(to->as<Turn>()->value - from->as<Turn>()->value, kFullTurn);
  const double middle = from->as<Turn>()->value + half;
  const double widest = std::min(std::abs(half) + margin, std::numbers::pi);
  value = std::remainder(middle + widest * (2.0 * unit - 1.0), kFullTurn);
}

}  // namespace

SpreadSampler::SpreadSampler(const ob::StateSpacePtr& space, std::uint32_t seed) {
  std::vector<unsigned> where;
  if (!addParts(*space, where)) {
    others_ = space->allocStateSampler();
    return;
  }
  std::minstd_rand random(seed);
  random.discard(kWarmUp);
  std::uniform_real_distribution<double> anywhere;
  int prime = 1;
  for (std::size_t i = 0; i < place_.size(); ++i) {
    prime = nextPrime(prime);
    const double root = std::sqrt(static_cast<double>(prime));
    steps_.push_back(root - std::floor(root));
    place_[i] = anywhere(random);
  }
}

bool SpreadSampler::addParts(const ob::StateSpace& space, std::vector<unsigned>& where) {
  const auto add = [&](Part::Kind kind, std::size_t dimensions) -> Part& {
    place_.resize(place_.size() + dimensions);
    return parts_.emplace_back(Part{kind, where, {}, {}});
  };
  if (const auto* vector = dynamic_cast<const ob::RealVectorStateSpace*>(&space)) {
    Part& part = add(Part::Kind::Vector, space.getDimension());
    part.low = vector->getBounds().low;
    for (std::size_t i = 0; i < part.low.size(); ++i)
      part.width.push_back(vector->getBounds().high[i] - part.low[i]);
  } else if (dynamic_cast<const ob::SO2StateSpace*>(&space) != nullptr) {
    add(Part::Kind::Turn, 1);
  } else if (dynamic_cast<const ob::SO3StateSpace*>(&space) != nullptr) {
    add(Part::Kind::Rotation, 3);
  } else if (const auto* compound = dynamic_cast<const ob::CompoundStateSpace*>(&space)) {
    for (unsigned i = 0; i < compound->getSubspaceCount(); ++i) {
      where.push_back(i);
      const bool known = addParts(*compound->getSubspace(i), where);
      where.pop_back();
      if (!known) return false;
    }
  } else {
    return false;
  }
  return true;
}

void SpreadSampler::sample(ob::State* state) {
  sampleIn({}, state);
}

void SpreadSampler::sampleAround(const ob::State* from, const ob::State* to, double margin,
                                 ob::State* state) {
  sampleIn({from, to, margin}, state);
}

void SpreadSampler::sampleIn(const Box& box, ob::State* state) {
  if (others_) return others_->sampleUniform(state);
  for (std::size_t i = 0; i < place_.size(); ++i) {
    place_[i] += steps_[i];
    if (place_[i] >= 1.0) place_[i] -= 1.0;
  }
  const double* unit = place_.data();
  for (const Part& part : parts_) {
    const auto ofPart = [&part](auto* whole) {
      for (const unsigned i : part.where)
        whole = whole->template as<ob::CompoundState>()->components[i];
      return whole;
    };
    ob::State* const own = ofPart(state);
    const ob::State* const from = box.from == nullptr ? nullptr : ofPart(box.from);
    const ob::State* const to = box.to == nullptr ? nullptr : ofPart(box.to);
    switch (part.kind) {
      case Part::Kind::Vector:
        placeVector(part.low, part.width, from, to, box.margin, unit, own);
        unit += part.low.size();
        break;
      case Part::Kind::Turn:
        placeTurn(from, to, box.margin, *unit, own);
        ++unit;
        break;
      case Part::Kind::Rotation:
        rotate(unit, *own->as<ob::SO3StateSpace::StateType>());
        unit += 3;
        break;
    }
  }
}

}  // namespace swept::detail
