// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/SimpleSetup.h>

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

/// What the base classes of OMPL promise their users, state by state, for every kind of space that
/// a group can have. The words of the contracts are those of OMPL's headers.
namespace swept::test {

/// A group of a robot, and a world in which it has to find its way.
struct Subject {
  std::string robot, group, scene;
  bool weighted = false;  ///< and with narrower limits
};

std::ostream& operator<<(std::ostream& out, const Subject& subject);
std::string nameOf(const testing::TestParamInfo<Subject>& info);

const std::vector<Subject>& subjects();

/// `gantry`, `every_joint`, or one of models/robots.
std::shared_ptr<const Robot> robotCalled(const std::string& name);

/// OMPL says that a seed given so late does not repeat what was drawn before, which is right: each
/// test starts with the same numbers, whatever came before it.
struct Seeded {
  Seeded();
};

/// Largest angle (rad) that OMPL's SO(3) takes for none: acos(1 - 1e-9).
inline constexpr double kBlind = 4.5e-5;

class Contract : protected Seeded, public testing::TestWithParam<Subject> {
 protected:
  using State = ompl::base::ScopedState<>;

  Contract();

  /// Of a distance; the largest weight of a joint that turns in space is 3.5.
  double noise() const { return turnsInSpace() ? 3.5 * 4.0 * kBlind : 1e-9; }
  bool turnsInSpace() const;
  State random() const;
  State near(const State& other, double distance) const;
  State randomThatIs(bool valid) const;
  State randomValid() const { return randomThatIs(true); }
  bool equal(const State& a, const State& b) const { return space_->equalStates(a.get(), b.get()); }
  double distance(const State& a, const State& b) const {
    return space_->distance(a.get(), b.get());
  }
  std::vector<double> configuration(const State& state) const;
  /// Of two states for sure: every number is the same.
  static bool same(const State& a, const State& b) { return a.reals() == b.reals(); }

  std::shared_ptr<const Robot> robot_;
  std::shared_ptr<const Checker> checker_;
  const Group& group_;
  ompl::geometric::SimpleSetupPtr setup_;
  ompl::base::SpaceInformationPtr si_ = setup_->getSpaceInformation();
  ompl::base::StateSpacePtr space_ = si_->getStateSpace();
  ompl::base::StateSamplerPtr sampler_ = space_->allocStateSampler();
  StateConversion conversion_{*robot_, group_};
};

}  // namespace swept::test
