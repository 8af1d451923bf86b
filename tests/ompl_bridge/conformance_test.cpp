// SPDX-License-Identifier: BSD-3-Clause
// What the base classes of OMPL promise their users, state by state, for every kind of space that a
// group can have. The words of the contracts are those of OMPL's headers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ompl/base/ConstrainedSpaceInformation.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>
#include <ompl/base/spaces/constraint/AtlasStateSpace.h>
#include <ompl/base/spaces/constraint/ProjectedStateSpace.h>
#include <ompl/util/Console.h>
#include <ompl/util/Exception.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <ostream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "fixtures.hpp"
#include "models_dir.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using State = ob::ScopedState<>;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

/// A group of a robot, and a world in which it has to find its way.
struct Subject {
  std::string robot, group, scene;
  bool weighted = false;  ///< and with narrower limits
};

std::ostream& operator<<(std::ostream& out, const Subject& subject) {
  return out << subject.robot << "_" << subject.group << (subject.weighted ? "_weighted" : "");
}

std::string nameOf(const testing::TestParamInfo<Subject>& info) {
  std::ostringstream out;
  out << info.param;
  return out.str();
}

const std::vector<Subject> kSubjects = {
    {"gantry", "all", "boxes"},                    // RealVector
    {"every_joint", "limited", "blocks"},          // RealVector, with a joint that mimics
    {"every_joint", "limited", "blocks", true},    // the same, weighted
    {"every_joint", "turn_only", "blocks"},        // SO(2)
    {"every_joint", "all", "blocks"},              // all kinds
    {"every_joint", "all", "blocks", true},        // the same, weighted
    {"rook7", "arm", "shelf"},                     // RealVector
    {"rook7", "arm_with_gripper", "narrow_slot"},  // with a finger that mimics the other
    {"rook6", "arm", "table_objects"},             // SO(2), RealVector, SO(2)
    {"rook6_cart", "base", "table_objects"},       // SE(2)
    {"rook6_cart", "whole_body", "narrow_slot"},   // SE(2), SO(2), RealVector, SO(2)
    {"drifter", "body", "tunnel_trap"},            // SE(3)
};

std::shared_ptr<const Robot> robotCalled(const std::string& name) {
  static std::map<std::string, std::shared_ptr<const Robot>> robots;
  auto& robot = robots[name];
  const auto folder = std::filesystem::path(modelsDir()) / "robots" / name;
  if (!robot) {
    robot = name == "gantry" ? gantry()
            : name == "every_joint"
                ? everyJoint()
                : Robot::load(folder / (name + ".urdf"), folder / (name + ".srdf"));
  }
  return robot;
}

std::shared_ptr<const World> worldCalled(const std::string& name) {
  if (name == "boxes") return worldOf(boxes());
  if (name == "blocks") {
    return worldOf({{{1.0, 0.0, 0.3}, {1.2, 1.6, 1.0}}, {{-0.6, 0.0, 0.5}, {0.8, 0.8, 0.8}}});
  }
  return std::make_shared<const World>(
      World::load(std::filesystem::path(modelsDir()) / "scenes" / (name + ".yaml")));
}

std::shared_ptr<const Checker> checkerFor(const Subject& subject) {
  static std::map<std::string, std::shared_ptr<const Checker>> checkers;
  auto& checker = checkers[subject.robot + " " + subject.group];
  if (!checker) {
    checker = std::make_shared<const Checker>(robotCalled(subject.robot), subject.group,
                                              worldCalled(subject.scene));
  }
  return checker;
}

/// Translations that the robot does not bound stay where there is something to hit.
StateSpaceOptions optionsOf(const Robot& robot, const Group& group, bool weighted) {
  StateSpaceOptions options;
  for (const int index : group.variables) {
    const Variable& variable = robot.variables()[index];
    if (std::isinf(variable.lower) && !variable.cyclic) options.limits[variable.name] = {-0.9, 0.7};
  }
  double weight = 0.5;
  for (const int j : weighted ? group.joints : std::vector<int>{})
    options.weights[robot.joints()[j].name] = weight += 0.5;
  if (weighted) options.limits["elbow"] = {-1.5, 0.5};
  return options;
}

/// Largest angle (rad) that OMPL's SO(3) takes for none: acos(1 - 1e-9).
constexpr double kBlind = 4.5e-5;

/// OMPL says that a seed given so late does not repeat what was drawn before, which is right: each
/// test starts with the same numbers, whatever came before it.
struct Seeded {
  Seeded() {
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    ompl::RNG::setSeed(42);
  }
};

class Contract : protected Seeded, public testing::TestWithParam<Subject> {
 protected:
  Contract() { setup_->getSpaceInformation()->setup(); }

  /// Of a distance; the largest weight of a joint that turns in space is 3.5.
  double noise() const { return turnsInSpace() ? 3.5 * 4.0 * kBlind : 1e-9; }
  bool turnsInSpace() const {
    for (const int j : group_.joints)
      if (robot_->joints()[j].type == JointType::Floating) return true;
    return false;
  }
  State random() const {
    State state(space_);
    sampler_->sampleUniform(state.get());
    return state;
  }
  State near(const State& other, double distance) const {
    State state(space_);
    sampler_->sampleUniformNear(state.get(), other.get(), distance);
    return state;
  }
  State randomThatIs(bool valid) const {
    constexpr int kTries = 100'000;
    State state(space_);
    for (int i = 0; i < kTries; ++i) {
      sampler_->sampleUniform(state.get());
      if (si_->isValid(state.get()) == valid) return state;
    }
    throw std::runtime_error("the world of the test leaves no such state");
  }
  State randomValid() const { return randomThatIs(true); }
  bool equal(const State& a, const State& b) const { return space_->equalStates(a.get(), b.get()); }
  double distance(const State& a, const State& b) const {
    return space_->distance(a.get(), b.get());
  }
  std::vector<double> configuration(const State& state) const {
    std::vector<double> q(conversion_.dimension());
    conversion_.toConfiguration(state.get(), q);
    return q;
  }
  /// Of two states for sure: every number is the same.
  static bool same(const State& a, const State& b) { return a.reals() == b.reals(); }

  std::shared_ptr<const Robot> robot_ = robotCalled(GetParam().robot);
  std::shared_ptr<const Checker> checker_ = checkerFor(GetParam());
  const Group& group_ = checker_->group();
  og::SimpleSetupPtr setup_ = makeSimpleSetup(
      checker_, {.space = optionsOf(*robot_, group_, GetParam().weighted), .motions = {}});
  ob::SpaceInformationPtr si_ = setup_->getSpaceInformation();
  ob::StateSpacePtr space_ = si_->getStateSpace();
  ob::StateSamplerPtr sampler_ = space_->allocStateSampler();
  StateConversion conversion_{*robot_, group_};
};

INSTANTIATE_TEST_SUITE_P(Of, Contract, testing::ValuesIn(kSubjects), nameOf);

// ---------------------------------------------------------------------------------- StateSpace

TEST_P(Contract, SpaceCopiesAndComparesStates) {
  int changes = 0;
  for (int i = 0; i < 50; ++i) {
    const State original = random();
    const std::vector<double> before = original.reals();
    State copy = random();
    EXPECT_FALSE(equal(copy, original));
    space_->copyState(copy.get(), original.get());
    EXPECT_TRUE(equal(copy, original));
    EXPECT_EQ(copy.reals(), before);
    EXPECT_EQ(original.reals(), before);
    ob::State* clone = space_->cloneState(original.get());
    EXPECT_TRUE(space_->equalStates(clone, original.get()));
    space_->freeState(clone);
    for (unsigned int k = 0; k < before.size(); ++k) {
      space_->copyState(copy.get(), original.get());
      *space_->getValueAddressAtIndex(copy.get(), k) += before[k] > 0.0 ? -0.02 : 0.02;
      EXPECT_EQ(original.reals(), before);
      space_->enforceBounds(copy.get());
      // Along the quaternion itself there is no change once it has unit length again.
      if (turnsInSpace() && k + 4 >= before.size() && std::abs(before[k]) > 0.7) continue;
      ++changes;
      EXPECT_FALSE(equal(copy, original)) << k;
      EXPECT_GT(distance(copy, original), 1e-6) << k;
    }
  }
  EXPECT_GE(changes, 50);
}

TEST_P(Contract, SpaceMeasuresWithAMetric) {
  EXPECT_TRUE(space_->isMetricSpace());
  EXPECT_TRUE(space_->hasSymmetricDistance());
  const double extent = space_->getMaximumExtent();
  ASSERT_TRUE(std::isfinite(extent));
  int far = 0, close = 0;
  double longest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const State a = random(), b = random(), c = i % 2 == 0 ? random() : near(a, 0.02);
    const double ab = distance(a, b), bc = distance(b, c), ac = distance(a, c);
    EXPECT_EQ(distance(a, a), 0.0);
    EXPECT_NEAR(distance(b, a), ab, 1e-12);
    EXPECT_GT(ab, 0.0);
    EXPECT_LE(ab, extent);
    EXPECT_LE(ab, ac + bc + noise());
    EXPECT_LE(ac, ab + bc + noise());
    longest = std::max(longest, ab);
    far += ac > 0.2 * extent;
    close += ac < 0.05 * extent;
  }
  EXPECT_GT(far, 200);
  EXPECT_GT(close, 200);
  EXPECT_GT(longest, 0.4 * extent) << "the extent is no tight bound";
}

TEST_P(Contract, SpaceInterpolatesAtConstantSpeed) {
  EXPECT_TRUE(space_->hasSymmetricInterpolate());
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const State a = random(), b = i % 4 == 0 ? near(a, 0.1) : random();
    const double length = distance(a, b), t = unit(engine), u = unit(engine);
    State at(space_), other(space_);
    space_->interpolate(a.get(), b.get(), 0.0, at.get());
    EXPECT_LE(distance(a, at), 1e-9);
    space_->interpolate(a.get(), b.get(), 1.0, at.get());
    EXPECT_LE(distance(b, at), 1e-9);
    space_->interpolate(a.get(), b.get(), t, at.get());
    EXPECT_NEAR(distance(a, at), t * length, noise());
    EXPECT_NEAR(distance(at, b), (1.0 - t) * length, noise());
    EXPECT_TRUE(space_->satisfiesBounds(at.get()));
    space_->interpolate(a.get(), b.get(), u, other.get());
    EXPECT_NEAR(distance(at, other), std::abs(t - u) * length, noise());
    space_->interpolate(b.get(), a.get(), 1.0 - t, other.get());
    EXPECT_LE(distance(at, other), noise());
    // "The memory location of state is not required to be different from either from or to."
    State from(a), to(b);
    space_->interpolate(from.get(), to.get(), t, from.get());
    EXPECT_TRUE(same(from, at));
    from = a;
    space_->interpolate(from.get(), to.get(), t, to.get());
    EXPECT_TRUE(same(to, at));
  }
}

TEST_P(Contract, SpaceKeepsItsBounds) {
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> factor(-6.0, 6.0);
  int outside = 0;
  constexpr int kStates = 500;
  for (int i = 0; i < kStates; ++i) {
    State state = random();
    EXPECT_TRUE(space_->satisfiesBounds(state.get()));
    const std::vector<double> inside = state.reals();
    space_->enforceBounds(state.get());
    // A quaternion that is scaled to unit length again changes in its last digit.
    EXPECT_THAT(state.reals(), testing::Pointwise(testing::DoubleNear(1e-15), inside));

    std::vector<double> reals = inside;
    for (double& value : reals) value = factor(engine) * (std::abs(value) + 0.1);
    space_->copyFromReals(state.get(), reals);
    outside += !space_->satisfiesBounds(state.get());
    space_->enforceBounds(state.get());
    EXPECT_TRUE(space_->satisfiesBounds(state.get()));
    const std::vector<double> once = state.reals();
    space_->enforceBounds(state.get());
    EXPECT_THAT(state.reals(), testing::Pointwise(testing::DoubleNear(1e-15), once));
    for (std::size_t k = 0; k < reals.size(); ++k) {
      if (!robot_->variables()[group_.variables[k]].cyclic) continue;
      EXPECT_NEAR(std::remainder(once[k] - reals[k], 2.0 * kPi), 0.0, 1e-12);
    }
  }
  EXPECT_GT(outside, kStates / 4);
}

TEST_P(Contract, SpaceSerializesStates) {
  const unsigned int length = space_->getSerializationLength();
  EXPECT_EQ(length, sizeof(double) * group_.variables.size());
  for (int i = 0; i < 50; ++i) {
    const State state = random();
    State back = random();
    std::vector<unsigned char> bytes(length + 8, 0xa5);
    space_->serialize(bytes.data(), state.get());
    for (unsigned int k = length; k < bytes.size(); ++k) EXPECT_EQ(bytes[k], 0xa5);
    space_->deserialize(back.get(), bytes.data());
    EXPECT_TRUE(same(back, state));
  }
}

/// In the order of the group's configuration, and by the names of its variables.
TEST_P(Contract, SpaceGivesAccessToItsValues) {
  const auto count = static_cast<unsigned int>(group_.variables.size());
  ASSERT_EQ(space_->getValueLocations().size(), count);
  int named = 0;
  for (int i = 0; i < 50; ++i) {
    const State state = random();
    const std::vector<double> q = configuration(state);
    std::vector<double> reals;
    space_->copyToReals(reals, state.get());
    EXPECT_EQ(reals, q);
    State back = random();
    space_->copyFromReals(back.get(), reals);
    EXPECT_TRUE(same(back, state));
    for (unsigned int k = 0; k < count; ++k) {
      EXPECT_EQ(*space_->getValueAddressAtIndex(back.get(), k), q[k]);
      EXPECT_EQ(*space_->getValueAddressAtLocation(state.get(), space_->getValueLocations()[k]),
                q[k]);
      const std::string& name = robot_->variables()[group_.variables[k]].name;
      if (!space_->getValueLocationsByName().contains(name)) continue;
      ++named;
      EXPECT_EQ(*space_->getValueAddressAtName(state.get(), name), q[k]) << name;
    }
    EXPECT_EQ(space_->getValueAddressAtIndex(back.get(), count), nullptr);
  }
  EXPECT_GE(named, 50);
}

/// No piece of a motion is longer than the longest valid segment, and none is missing.
TEST_P(Contract, SpaceCountsValidSegments) {
  EXPECT_GT(space_->getLongestValidSegmentLength(), 0.0);
  EXPECT_NEAR(space_->getLongestValidSegmentLength(),
              space_->getLongestValidSegmentFraction() * space_->getMaximumExtent(), 1e-12);
  for (int i = 0; i < 200; ++i) {
    const State a = random(), b = i % 2 == 0 ? random() : near(a, 0.05);
    const unsigned int count = space_->validSegmentCount(a.get(), b.get());
    EXPECT_EQ(space_->validSegmentCount(b.get(), a.get()), count);
    EXPECT_GE(count, 1u);
    EXPECT_LE(distance(a, b), count * space_->getLongestValidSegmentLength() * (1.0 + 1e-12));
    if (!space_->isCompound()) {
      EXPECT_GT(distance(a, b), (count - 1) * space_->getLongestValidSegmentLength());
    }
    // OMPL's compounds count the segments of their parts, which do not hear of the factor.
    space_->setValidSegmentCountFactor(3);
    EXPECT_EQ(space_->validSegmentCount(a.get(), b.get()),
              space_->isCompound() ? count : 3 * count);
    space_->setValidSegmentCountFactor(1);
  }
}

TEST_P(Contract, SpacePassesOmplsOwnChecks) {
  EXPECT_NO_THROW(space_->sanityChecks());
  EXPECT_FALSE(space_->isDiscrete());
  EXPECT_FALSE(space_->isHybrid());
  unsigned int freedom = 0;
  double measure = 1.0;
  for (const int j : group_.joints) {
    const JointType type = robot_->joints()[j].type;
    freedom += type == JointType::Floating ? 6 : type == JointType::Planar ? 3 : 1;
  }
  EXPECT_EQ(space_->getDimension(), freedom);
  if (!space_->isCompound()) {
    const ob::RealVectorBounds& bounds = space_->as<ob::RealVectorStateSpace>()->getBounds();
    for (unsigned int k = 0; k < freedom; ++k) measure *= bounds.high[k] - bounds.low[k];
    EXPECT_NEAR(space_->getMeasure(), measure, 1e-12 * measure);
  }
  EXPECT_GT(space_->getMeasure(), 0.0);
  EXPECT_TRUE(std::isfinite(space_->getMeasure()));
  EXPECT_TRUE(space_->includes(space_));
  EXPECT_TRUE(space_->covers(space_));
  std::ostringstream text;
  space_->printSettings(text);
  space_->printState(random().get(), text);
  space_->diagram(text);
  space_->list(text);
  EXPECT_THAT(text.str(), HasSubstr(group_.name));
}

TEST_P(Contract, SamplersStayInBounds) {
  const State centre = random();
  std::map<double, double> nearMean, gaussMean;
  for (const double reach : {0.0, 0.01, 0.3, 100.0}) {
    State state(space_);
    for (int i = 0; i < 300; ++i) {
      sampler_->sampleUniformNear(state.get(), centre.get(), reach);
      EXPECT_TRUE(space_->satisfiesBounds(state.get()));
      nearMean[reach] += distance(state, centre) / 300;
      sampler_->sampleGaussian(state.get(), centre.get(), reach);
      EXPECT_TRUE(space_->satisfiesBounds(state.get()));
      gaussMean[reach] += distance(state, centre) / 300;
    }
  }
  for (const auto& mean : {nearMean, gaussMean}) {
    EXPECT_LE(mean.at(0.0), noise());
    EXPECT_GT(mean.at(0.01), mean.at(0.0));
    EXPECT_LT(mean.at(0.01), 0.3 * mean.at(0.3));
    EXPECT_LT(mean.at(0.3), mean.at(100.0));
  }
}

/// What enforceBounds makes of values far outside are the ends of the space: uniform samples come
/// near them all. Angles without limits and orientations have theirs at half a turn.
TEST_P(Contract, UniformSamplesReachAllOfTheSpace) {
  const std::size_t count = group_.variables.size();
  std::vector<double> low(count, kInfinity), high(count, -kInfinity);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> q = configuration(random());
    for (std::size_t k = 0; k < count; ++k) {
      low[k] = std::min(low[k], q[k]);
      high[k] = std::max(high[k], q[k]);
    }
  }
  State floor(space_), ceiling(space_);
  space_->copyFromReals(floor.get(), std::vector<double>(count, -1e3));
  space_->copyFromReals(ceiling.get(), std::vector<double>(count, 1e3));
  space_->enforceBounds(floor.get());
  space_->enforceBounds(ceiling.get());
  for (std::size_t k = 0; k < count; ++k) {
    const Variable& variable = robot_->variables()[group_.variables[k]];
    double least = configuration(floor)[k], most = configuration(ceiling)[k];
    if (variable.cyclic) least = -(most = kPi);
    if (variable.name.find("/rot_") != std::string::npos) least = -(most = 1.0);
    EXPECT_LT(low[k], least + 0.1 * (most - least)) << variable.name;
    EXPECT_GT(high[k], most - 0.1 * (most - least)) << variable.name;
  }
}

/// "Allocate a sampler that actually samples only components that are part of subspace."
TEST_P(Contract, SubspaceSamplersLeaveTheRestAlone) {
  if (!space_->isCompound()) {
    // The space is the only one of its subspaces: all of a state is sampled.
    const auto whole = space_->allocSubspaceStateSampler(space_);
    State state = random();
    const State before(state);
    whole->sampleUniform(state.get());
    EXPECT_TRUE(space_->satisfiesBounds(state.get()));
    const std::vector<double> was = configuration(before), is = configuration(state);
    for (std::size_t k = 0; k < was.size(); ++k) EXPECT_NE(was[k], is[k]) << k;
    return;
  }
  const auto* compound = space_->as<ob::CompoundStateSpace>();
  for (unsigned int part = 0; part < compound->getSubspaceCount(); ++part) {
    const auto sampler = space_->allocSubspaceStateSampler(compound->getSubspace(part));
    State state = random();
    const State before(state);
    sampler->sampleUniform(state.get());
    EXPECT_TRUE(space_->satisfiesBounds(state.get()));
    for (unsigned int k = 0; k < compound->getSubspaceCount(); ++k) {
      const auto& subspace = compound->getSubspace(k);
      const auto components = [&](const State& of) {
        return of.get()->as<ob::CompoundState>()->components[k];
      };
      EXPECT_EQ(subspace->equalStates(components(state), components(before)), k != part);
    }
  }
}

// ------------------------------------------------------------------------ StateValidityChecker

TEST_P(Contract, ValidityAgreesWithItself) {
  const ob::StateValidityChecker& validity = *si_->getStateValidityChecker();
  EXPECT_EQ(validity.getSpecs().clearanceComputationType,
            ob::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE);
  EXPECT_TRUE(validity.getSpecs().hasValidDirectionComputation);
  constexpr int kStates = 150;
  int valid = 0, led = 0;
  for (int i = 0; i < kStates; ++i) {
    const State state = random(), before(state);
    const bool answer = validity.isValid(state.get());
    valid += answer;
    EXPECT_EQ(si_->isValid(state.get()), answer);
    const double clearance = validity.clearance(state.get());
    if (std::abs(clearance) > 1e-6) {
      EXPECT_EQ(clearance > 0.0, answer);
    }
    double told = 7.0;
    EXPECT_EQ(validity.isValid(state.get(), told), answer);
    EXPECT_EQ(told, clearance);

    const State untouched = random();
    State other(untouched);
    bool available = i % 2 == 0;
    EXPECT_EQ(validity.clearance(state.get(), other.get(), available), clearance);
    EXPECT_TRUE(available ? validity.isValid(other.get()) : same(other, untouched));
    EXPECT_FALSE(answer && available);
    led += available;
    State again(untouched);
    bool availableAgain = !available;
    EXPECT_EQ(validity.isValid(state.get(), told, again.get(), availableAgain), answer);
    EXPECT_EQ(told, clearance);
    EXPECT_EQ(availableAgain, available);
    EXPECT_TRUE(same(again, other));
    EXPECT_TRUE(same(state, before)) << "a question changed the state";
  }
  EXPECT_GT(valid, kStates / 50);
  EXPECT_LT(valid, kStates * 49 / 50);
  EXPECT_GT(led, 3);
}

/// "If interpolate() may return states that are outside of bounds, isValid should also call
/// satisfiesBounds()."
TEST_P(Contract, StatesOutsideTheBoundsAreInvalid) {
  const ob::StateValidityChecker& validity = *si_->getStateValidityChecker();
  int outside = 0;
  for (int i = 0; i < 5; ++i) {
    const State inside = randomValid();
    for (unsigned int k = 0; k < group_.variables.size(); ++k) {
      for (const double bad : {100.0, -100.0, kInfinity, std::nan("")}) {
        State state(inside);
        *space_->getValueAddressAtIndex(state.get(), k) = bad;
        ++outside;
        double distance = 0.0;
        bool available = true;
        State other(space_);
        EXPECT_FALSE(validity.isValid(state.get()));
        EXPECT_FALSE(validity.isValid(state.get(), distance));
        EXPECT_FALSE(validity.isValid(state.get(), distance, other.get(), available));
        EXPECT_TRUE(!available || validity.isValid(other.get()));
        EXPECT_FALSE(si_->checkMotion(inside.get(), state.get()));
        EXPECT_FALSE(si_->checkMotion(state.get(), inside.get()));
      }
    }
  }
  EXPECT_GE(outside, 20);
}

// ----------------------------------------------------------------------------- MotionValidator

/// s1 is valid, as the contract assumes.
TEST_P(Contract, MotionsAgreeWithTheirStates) {
  constexpr int kMotions = 400;
  int valid = 0, partly = 0;
  for (int i = 0; i < kMotions; ++i) {
    const State s1 = randomValid(), s2 = i % 2 == 0 ? random() : near(s1, 0.15);
    const State before1(s1), before2(s2), untouched = random();
    State last(untouched);
    std::pair<ob::State*, double> lastValid{last.get(), -7.0};
    const bool answer = si_->checkMotion(s1.get(), s2.get());
    ASSERT_EQ(si_->checkMotion(s1.get(), s2.get(), lastValid), answer);
    ASSERT_EQ(lastValid.first, last.get());
    ASSERT_TRUE(same(s1, before1) && same(s2, before2));
    if (answer) {  // "should not be modified"
      ++valid;
      ASSERT_EQ(lastValid.second, -7.0);
      ASSERT_TRUE(same(last, untouched));
      State at(space_);
      for (int k = 0; k <= 40; ++k) {
        space_->interpolate(s1.get(), s2.get(), k / 40.0, at.get());
        ASSERT_TRUE(si_->isValid(at.get())) << k;
      }
      continue;
    }
    ASSERT_GE(lastValid.second, 0.0);
    ASSERT_LT(lastValid.second, 1.0);
    ASSERT_TRUE(si_->isValid(last.get())) << "t = " << lastValid.second;
    State at(space_);
    space_->interpolate(s1.get(), s2.get(), lastValid.second, at.get());
    ASSERT_LE(distance(last, at), noise());
    partly += lastValid.second > 0.0;
  }
  EXPECT_GT(valid, kMotions / 10);
  EXPECT_LT(valid, kMotions * 97 / 100);
  EXPECT_GT(partly, (kMotions - valid) / 2);
}

/// Planners go to the last valid state and take the way there for valid: asked about as a motion of
/// its own, it has to be, or their paths have segments that are not.
TEST_P(Contract, TheWayToTheLastValidStateIsValid) {
  Workspace workspace(*checker_);
  int asked = 0;
  std::ostringstream refused;
  for (int i = 0; i < 2000 && asked < 300; ++i) {
    const State s1 = randomValid(), s2 = random();
    State last(space_);
    std::pair<ob::State*, double> lastValid{last.get(), 0.0};
    if (si_->checkMotion(s1.get(), s2.get(), lastValid) || lastValid.second == 0.0) continue;
    ++asked;
    if (si_->checkMotion(s1.get(), last.get())) continue;
    const MotionCertificate there =
        checker_->certifyMotion(configuration(s1), configuration(last), workspace);
    refused << "t = " << lastValid.second << ": on the way there " << toString(there.verdict)
            << ", free until " << there.freeUntil << "\n";
  }
  EXPECT_GE(asked, 100);
  EXPECT_EQ(refused.str(), "") << "of " << asked;
}

/// Both overloads, where motions end next to a contact.
TEST_P(Contract, OverloadsAgreeNextToContacts) {
  int asked = 0;
  std::ostringstream differ;
  for (int i = 0; i < 2000 && asked < 300; ++i) {
    const State s1 = randomValid(), s2 = random();
    State last(space_);
    std::pair<ob::State*, double> lastValid{last.get(), 0.0}, again{nullptr, 1.0};
    if (si_->checkMotion(s1.get(), s2.get(), lastValid) || lastValid.second == 0.0) continue;
    ++asked;
    const bool one = si_->checkMotion(s1.get(), last.get());
    const bool other = si_->checkMotion(s1.get(), last.get(), again);
    if (one != other) differ << "valid: " << one << " and " << other << " to " << last << "\n";
  }
  EXPECT_GE(asked, 100);
  EXPECT_EQ(differ.str(), "") << "of " << asked;
}

/// "first: may be nullptr; this need not be different from s1 or s2."
TEST_P(Contract, LastValidMayBeNullOrAnEnd) {
  int invalid = 0;
  for (int i = 0; i < 2000 && invalid < 50; ++i) {
    const State s1 = randomValid(), s2 = random();
    State last(space_);
    std::pair<ob::State*, double> apart{last.get(), 0.0}, none{nullptr, 0.0};
    if (si_->checkMotion(s1.get(), s2.get(), apart)) continue;
    ++invalid;
    EXPECT_FALSE(si_->checkMotion(s1.get(), s2.get(), none));
    EXPECT_EQ(none.first, nullptr);
    EXPECT_EQ(none.second, apart.second);
    for (const bool first : {true, false}) {
      State from(s1), to(s2);
      std::pair<ob::State*, double> end{first ? from.get() : to.get(), 0.0};
      EXPECT_FALSE(si_->checkMotion(from.get(), to.get(), end));
      EXPECT_EQ(end.second, apart.second);
      EXPECT_TRUE(same(first ? from : to, last));
      EXPECT_TRUE(first ? same(to, s2) : same(from, s1));
    }
  }
  EXPECT_EQ(invalid, 50);
}

/// Nothing is promised for a start that is not valid; no motion from it is, and the start is what
/// comes back.
TEST_P(Contract, MotionsFromAnInvalidStateAreInvalid) {
  for (int i = 0; i < 30; ++i) {
    const State s1 = randomThatIs(false), s2 = randomValid();
    State last(s2);
    std::pair<ob::State*, double> lastValid{last.get(), 0.5};
    EXPECT_FALSE(si_->checkMotion(s1.get(), s2.get()));
    EXPECT_FALSE(si_->checkMotion(s1.get(), s2.get(), lastValid));
    EXPECT_EQ(lastValid.second, 0.0);
    EXPECT_TRUE(same(last, s1));
  }
}

TEST_P(Contract, AMotionThatStaysIsAsValidAsItsState) {
  int valid = 0;
  constexpr int kStates = 300;
  for (int i = 0; i < kStates; ++i) {
    const State state = random();
    const bool answer = si_->isValid(state.get());
    valid += answer;
    EXPECT_EQ(si_->checkMotion(state.get(), state.get()), answer);
  }
  EXPECT_GT(valid, kStates / 50);
  EXPECT_LT(valid, kStates);
}

/// Interpolation is symmetric, so planners turn motions round. Only what is undecided one way may
/// be valid the other way.
TEST_P(Contract, MotionsAreAsValidBackwards) {
  Workspace workspace(*checker_);
  constexpr int kMotions = 300;
  int valid = 0, undecided = 0;
  for (int i = 0; i < kMotions; ++i) {
    const State s1 = randomValid(), s2 = i % 2 == 0 ? randomValid() : near(s1, 0.3);
    const bool there = si_->checkMotion(s1.get(), s2.get());
    const bool back = si_->checkMotion(s2.get(), s1.get());
    valid += there;
    if (there == back) continue;
    ++undecided;
    const State& from = there ? s2 : s1;
    const State& to = there ? s1 : s2;
    EXPECT_EQ(checker_->certifyMotion(configuration(from), configuration(to), workspace).verdict,
              Verdict::Undecided);
  }
  EXPECT_LT(undecided, kMotions / 20);
  EXPECT_GT(valid, kMotions / 20);
  EXPECT_LT(valid, kMotions * 98 / 100);
}

/// "This function updates the number of valid and invalid segments", by both overloads.
TEST_P(Contract, MotionsAreCounted) {
  ob::MotionValidator& motions = *si_->getMotionValidator();
  motions.resetMotionCounter();
  EXPECT_EQ(motions.getCheckedMotionCount(), 0u);
  EXPECT_EQ(motions.getValidMotionFraction(), 0.0);
  unsigned int valid = 0, invalid = 0;
  for (int i = 0; i < 100; ++i) {
    const State s1 = randomValid(), s2 = i % 2 == 0 ? random() : s1;
    std::pair<ob::State*, double> lastValid{nullptr, 0.0};
    const bool answer = i % 3 == 0 ? motions.checkMotion(s1.get(), s2.get())
                                   : motions.checkMotion(s1.get(), s2.get(), lastValid);
    (answer ? valid : invalid) += 1;
  }
  EXPECT_EQ(motions.getValidMotionCount(), valid);
  EXPECT_EQ(motions.getInvalidMotionCount(), invalid);
  EXPECT_EQ(motions.getCheckedMotionCount(), 100u);
  EXPECT_EQ(si_->getCheckedMotionCount(), 100u);
  EXPECT_DOUBLE_EQ(motions.getValidMotionFraction(), valid / 100.0);
  EXPECT_GT(invalid, 2u);
  motions.resetMotionCounter();
  EXPECT_EQ(motions.getValidMotionCount() + motions.getInvalidMotionCount(), 0u);
}

// ---------------------------------------------------------------------------- SpaceInformation

class States {
 public:
  States(const ob::SpaceInformation& si, std::size_t count) : si_(si), states_(count) {
    si_.allocStates(states_);
  }
  ~States() { si_.freeStates(states_); }
  States(const States&) = delete;
  States& operator=(const States&) = delete;
  std::vector<ob::State*>& operator*() { return states_; }
  ob::State* operator[](std::size_t i) const { return states_[i]; }

 private:
  const ob::SpaceInformation& si_;
  std::vector<ob::State*> states_;
};

/// "Marks the index of the first invalid state. Unmodified if the function returns true." OMPL asks
/// about the states only; a path asks about its motions.
TEST_P(Contract, ListsOfStatesAndPathsAreChecked) {
  constexpr unsigned int kCount = 5;
  int states = 0, motions = 0, broken = 0;
  for (int i = 0; i < 200; ++i) {
    States list(*si_, kCount);
    State current = randomValid();
    for (unsigned int k = 0; k < kCount; ++k) {
      si_->copyState(list[k], current.get());
      current = k + 2 == kCount && i % 4 == 0 ? randomThatIs(false) : near(current, 0.02);
    }
    unsigned int expected = kCount;
    bool free = true;
    for (unsigned int k = kCount; k-- > 0;) {
      if (!si_->isValid(list[k])) expected = k;
      free = free && (k == 0 || si_->checkMotion(list[k - 1], list[k]));
    }
    unsigned int first = 77;
    const bool answer = si_->checkMotion(*list, kCount, first);
    EXPECT_EQ(answer, expected == kCount);
    EXPECT_EQ(first, answer ? 77 : expected);
    EXPECT_EQ(si_->checkMotion(*list, kCount), answer);
    og::PathGeometric path(si_);
    for (unsigned int k = 0; k < kCount; ++k) path.append(list[k]);
    EXPECT_EQ(path.check(), free);
    EXPECT_TRUE(answer || !free);
    states += answer;
    motions += free;
    broken += !answer;
  }
  EXPECT_GT(motions, 20);
  EXPECT_GE(states, motions);
  EXPECT_GT(broken, 10);
}

TEST_P(Contract, MotionStatesAreOnTheMotion) {
  for (const bool ends : {false, true}) {
    for (int i = 0; i < 20; ++i) {
      const State s1 = randomValid(), s2 = near(s1, 0.2);
      std::vector<ob::State*> states;
      const unsigned int inner = 9, count = inner + (ends ? 2 : 0);
      ASSERT_EQ(si_->getMotionStates(s1.get(), s2.get(), states, inner, ends, true), count);
      const bool valid = si_->checkMotion(s1.get(), s2.get());
      for (unsigned int k = 0; k < count; ++k) {
        State at(space_);
        space_->interpolate(s1.get(), s2.get(), (k + (ends ? 0.0 : 1.0)) / (inner + 1.0), at.get());
        EXPECT_LE(space_->distance(at.get(), states[k]), noise());
        EXPECT_TRUE(!valid || si_->isValid(states[k]));
      }
      si_->freeStates(states);
    }
  }
}

/// "If the given state is valid, it will be returned itself."
TEST_P(Contract, ValidStatesAreFoundNearby) {
  int invalid = 0, found = 0;
  for (int i = 0; i < 100; ++i) {
    State near = random(), state = random();
    const bool valid = si_->isValid(near.get());
    const bool answer = si_->searchValidNearby(state.get(), near.get(), 2.0, 50);
    EXPECT_TRUE(!valid || answer);
    EXPECT_TRUE(!valid || same(state, near));
    EXPECT_EQ(answer, si_->isValid(state.get()));
    invalid += !valid;
    found += answer && !valid;
    *space_->getValueAddressAtIndex(near.get(), 0) += 50.0;  // out of bounds
    if (si_->searchValidNearby(state.get(), near.get(), 2.0, 50)) {
      EXPECT_TRUE(si_->isValid(state.get()));
    }
    // "The two passed state pointers need not point to different memory."
    if (si_->searchValidNearby(near.get(), near.get(), 2.0, 50)) {
      EXPECT_TRUE(si_->isValid(near.get()));
    }
  }
  EXPECT_GT(invalid, 0);
  EXPECT_GT(found, invalid / 3);
}

/// "Produce a valid motion by randomly bouncing off of invalid states."
TEST_P(Contract, BouncesAreValidMotions) {
  int bounces = 0;
  for (int i = 0; i < 30; ++i) {
    constexpr unsigned int kSteps = 10;
    const State start = randomValid();
    std::vector<ob::State*> states;
    const unsigned int count = si_->randomBounceMotion(sampler_, start.get(), kSteps, states, true);
    ASSERT_LE(count, kSteps);
    const ob::State* previous = start.get();
    for (unsigned int k = 0; k < count; ++k) {
      ++bounces;
      EXPECT_TRUE(si_->checkMotion(previous, states[k])) << k;
      EXPECT_TRUE(si_->isValid(states[k]));
      previous = states[k];
    }
    si_->freeStates(states);
  }
  EXPECT_GT(bounces, 100);
}

TEST_P(Contract, SpaceInformationEstimatesAndPrints) {
  int valid = 0;
  for (int i = 0; i < 1000; ++i) valid += si_->isValid(random().get());
  EXPECT_NEAR(si_->probabilityOfValidState(1000), valid / 1000.0, 0.1);
  const double length = si_->averageValidMotionLength(200);
  EXPECT_GT(length, 0.0);
  EXPECT_LE(length, si_->getMaximumExtent());
  EXPECT_EQ(si_->getStateDimension(), space_->getDimension());
  EXPECT_EQ(si_->getSpaceMeasure(), space_->getMeasure());
  EXPECT_TRUE(si_->isSetup());
  EXPECT_NO_THROW(si_->setup());
  std::ostringstream text;
  EXPECT_NO_THROW(si_->printSettings(text));
  EXPECT_NO_THROW(si_->printProperties(text));
  EXPECT_NO_THROW(setup_->print(text));
  EXPECT_THAT(text.str(), HasSubstr(group_.name));
}

// ----------------------------------------------------------------------- OptimizationObjective

TEST_P(Contract, ObjectiveCombinesTheLeastClearances) {
  const auto shared = std::make_shared<CertifiedClearanceObjective>(si_, checker_, 1e-3);
  CertifiedClearanceObjective& objective = *shared;
  const ob::Cost identity = objective.identityCost(), worst = objective.infiniteCost();
  int apart = 0, together = 0;
  for (int i = 0; i < 60; ++i) {
    const State a = i % 2 == 0 ? random() : randomValid(), b = near(a, 0.2);
    const ob::Cost ofA = objective.stateCost(a.get()), ofB = objective.stateCost(b.get());
    const ob::Cost between = objective.motionCost(a.get(), b.get());
    (ofA.value() > 0.0 ? apart : together) += 1;
    if (ofA.value() > 0.0) {
      EXPECT_NEAR(ofA.value(), si_->getStateValidityChecker()->clearance(a.get()), 1e-9);
    }
    // A motion is no better than its states are, and of a motion that stays no worse either.
    EXPECT_FALSE(objective.isCostBetterThan(between, ob::Cost(ofA.value() + 1e-6)));
    EXPECT_FALSE(objective.isCostBetterThan(between, ob::Cost(ofB.value() + 1e-6)));
    EXPECT_NEAR(objective.motionCost(a.get(), a.get()).value(), ofA.value(), 1e-3);
    EXPECT_NEAR(objective.motionCost(b.get(), a.get()).value(), between.value(), 2e-3);
    // "For all costs c, combineCosts(c, c_i) = combineCosts(c_i, c) = c."
    for (const ob::Cost c : {ofA, ofB, between, worst, identity}) {
      EXPECT_EQ(objective.combineCosts(c, identity).value(), c.value());
      EXPECT_EQ(objective.combineCosts(identity, c).value(), c.value());
      EXPECT_EQ(objective.combineCosts(worst, c).value(), worst.value());
      EXPECT_FALSE(objective.isCostBetterThan(c, c));
      EXPECT_FALSE(objective.isCostBetterThan(worst, c));
      EXPECT_TRUE(objective.isCostEquivalentTo(c, c));
    }
    EXPECT_EQ(objective.combineCosts(ofA, between).value(), std::min(ofA.value(), between.value()));
    EXPECT_EQ(objective.betterCost(ofA, ofB).value(), std::max(ofA.value(), ofB.value()));
    // "An admissible estimate always undervalues the true cost": nothing is better.
    EXPECT_FALSE(
        objective.isCostBetterThan(between, objective.motionCostHeuristic(a.get(), b.get())));
    og::PathGeometric path(si_);
    path.append(a.get());
    path.append(b.get());
    path.append(a.get());
    EXPECT_NEAR(path.cost(shared).value(), between.value(), 2e-3);
  }
  EXPECT_GT(apart, 5);
  EXPECT_GT(together, 0);
  EXPECT_TRUE(objective.isSymmetric());
  EXPECT_FALSE(objective.getDescription().empty());
  objective.setCostThreshold(ob::Cost(0.1));
  EXPECT_TRUE(objective.isSatisfied(ob::Cost(0.2)));
  EXPECT_FALSE(objective.isSatisfied(ob::Cost(0.05)));
}

// ------------------------------------------------------------------------ GoalSampleableRegion

class PoseGoalContract : protected Seeded, public testing::Test {
 protected:
  /// Of the ball, which is where its three values say.
  PoseGoal goalAt(double x, double y, double z) const {
    return {si_, checker_, "ball", Eigen::Isometry3d(Eigen::Translation3d(x, y, z)), options_};
  }
  static PoseGoalOptions coarse() {
    PoseGoalOptions options;
    options.positionTolerance = 1.2;
    options.maxSamples = 6;
    return options;
  }
  void awaitSamples(const PoseGoal& goal) const {
    si_->setup();
    while (goal.isSampling()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf(boxes()));
  og::SimpleSetupPtr setup_ = makeSimpleSetup(checker_);
  ob::SpaceInformationPtr si_ = setup_->getSpaceInformation();
  PoseGoalOptions options_ = coarse();
};

TEST_F(PoseGoalContract, TellsWhetherItCanSample) {
  PoseGoal goal = goalAt(0.5, 0.0, -0.2);
  for (const auto type :
       {ob::GOAL_REGION, ob::GOAL_SAMPLEABLE_REGION, ob::GOAL_STATES, ob::GOAL_LAZY_SAMPLES}) {
    EXPECT_TRUE(goal.hasType(type)) << type;
  }
  State state(si_->getStateSpace());
  // Nothing is sampled before the setup, but something may be later.
  EXPECT_FALSE(goal.canSample());
  EXPECT_TRUE(goal.couldSample());
  EXPECT_EQ(goal.maxSampleCount(), 0u);
  EXPECT_THROW(goal.sampleGoal(state.get()), ompl::Exception);
  awaitSamples(goal);
  EXPECT_TRUE(goal.canSample());
  EXPECT_TRUE(goal.couldSample());
  EXPECT_EQ(goal.maxSampleCount(), 6u);
  EXPECT_EQ(goal.getStateCount(), 6u);
  EXPECT_THROW(goal.getState(6), ompl::Exception);
  goal.clear();
  EXPECT_FALSE(goal.canSample());
  EXPECT_THROW(goal.sampleGoal(state.get()), ompl::Exception);
  std::ostringstream text;
  EXPECT_NO_THROW(goal.print(text));

  PoseGoal beyond = goalAt(5.0, 0.0, 0.0);
  awaitSamples(beyond);
  EXPECT_FALSE(beyond.canSample());
  EXPECT_FALSE(beyond.couldSample());
}

/// "The maximum number of samples that can be asked for before repeating."
TEST_F(PoseGoalContract, RepeatsItsSamplesInTurn) {
  const PoseGoal goal = goalAt(0.5, 0.0, -0.2);
  awaitSamples(goal);
  std::vector<State> seen;
  for (unsigned int i = 0; i < 2 * goal.maxSampleCount(); ++i) {
    State state(si_->getStateSpace());
    goal.sampleGoal(state.get());
    EXPECT_TRUE(goal.isSatisfied(state.get()));
    EXPECT_TRUE(si_->isValid(state.get()));
    for (std::size_t k = 0; k < seen.size(); ++k)
      EXPECT_EQ(si_->equalStates(seen[k].get(), state.get()), k + goal.maxSampleCount() == i);
    seen.push_back(state);
  }
  EXPECT_EQ(seen.size(), 12u);
}

TEST_F(PoseGoalContract, IsSatisfiedWithinItsThreshold) {
  PoseGoal goal = goalAt(0.5, 0.0, -0.2);
  int satisfied = 0;
  State state(si_->getStateSpace());
  for (const double threshold : {1.0, 0.5}) {
    goal.setThreshold(threshold);
    EXPECT_EQ(goal.getThreshold(), threshold);
    for (int i = 0; i < 500; ++i) {
      state.random();
      const std::vector<double> at = state.reals();
      const double away = Eigen::Vector3d(at[0] - 0.5, at[1], at[2] + 0.2).norm() / 1.2;
      double told = -1.0;
      EXPECT_NEAR(goal.distanceGoal(state.get()), away, 1e-12);
      EXPECT_EQ(goal.isSatisfied(state.get(), &told), away < threshold);
      EXPECT_EQ(goal.isSatisfied(state.get()), away < threshold);
      EXPECT_NEAR(told, away, 1e-12);
      satisfied += away < threshold;
    }
  }
  EXPECT_GT(satisfied, 50);
  EXPECT_LT(satisfied, 950);
}

// -------------------------------------------------------------- spaces that cannot be certified

/// |q| = 1/2 for the gantry.
class OnABall : public ob::Constraint {
 public:
  OnABall() : Constraint(3, 1) {}
  void function(const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::VectorXd> out) const override {
    out[0] = x.norm() - 0.5;
  }
};

/// Laid out as a gantry's space, and moves along curves.
class CurvedSpace : public ob::RealVectorStateSpace {
 public:
  CurvedSpace() : RealVectorStateSpace(3) { setBounds(-1.0, 1.0); }
  void interpolate(const ob::State* from, const ob::State* to, double t,
                   ob::State* state) const override {
    RealVectorStateSpace::interpolate(from, to, t * t, state);
  }
};

template <typename Space, typename... Arguments>
std::shared_ptr<Space> called(const std::string& name, Arguments&&... arguments) {
  auto space = std::make_shared<Space>(std::forward<Arguments>(arguments)...);
  static_cast<ob::StateSpace&>(*space).setName(name);
  return space;
}

template <typename... Parts>
ob::StateSpacePtr compoundOf(const std::string& name, const Parts&... parts) {
  auto space = called<ob::CompoundStateSpace>(name);
  (space->addSubspace(parts, 1.0), ...);
  return space;
}

/// What the constructors say; empty for one that takes the space.
std::vector<std::string> messages(const ob::StateSpacePtr& space,
                                  const std::shared_ptr<const Checker>& checker) {
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  std::vector<std::string> all;
  const auto attempt = [&](const auto& make) {
    all.emplace_back();
    try {
      make();
    } catch (const std::invalid_argument& error) {
      all.back() = error.what();
    }
  };
  attempt([&] { const ValidityChecker validity(si, checker); });
  attempt([&] { const CertifiedMotionValidator motions(si, checker); });
  attempt([&] { const CertifiedClearanceObjective objective(si, checker); });
  return all;
}

std::shared_ptr<const Checker> checkerIn(const std::string& robot, const std::string& group) {
  return std::make_shared<const Checker>(robotCalled(robot), group,
                                         std::make_shared<const World>());
}

void expectRefused(const ob::StateSpacePtr& space, const std::shared_ptr<const Checker>& checker) {
  // Names are not virtual: that of a wrapper is its own, not that of the space within.
  const std::string name = static_cast<const ob::StateSpace&>(*space).getName();
  for (const std::string& message : messages(space, checker)) {
    EXPECT_THAT(message,
                HasSubstr("state space `" + name + "` is not built as makeStateSpace does"));
    EXPECT_THAT(message, HasSubstr("group `" + checker->group().name + "`"));
  }
}

TEST(Spaces, OfAnotherLayoutAreRefused) {
  const auto arm = checkerIn("gantry", "all");
  for (const unsigned int dimension : {1u, 2u, 4u, 7u})
    expectRefused(called<ob::RealVectorStateSpace>("flat", dimension), arm);
  expectRefused(called<ob::SE2StateSpace>("plane"), arm);
  expectRefused(called<ob::SE3StateSpace>("free"), arm);
  expectRefused(called<ob::SO2StateSpace>("turn"), arm);
  expectRefused(compoundOf("parts", called<ob::RealVectorStateSpace>("flat", 3u)), arm);
  for (const char* name : {"limited", "turn_only", "all"})
    expectRefused(makeStateSpace(*everyJoint(), *everyJoint()->findGroup(name)),
                  name == std::string("limited") ? checkerIn("rook7", "arm") : arm);
  const auto body = checkerIn("drifter", "body");
  expectRefused(compoundOf("plane", called<ob::SE2StateSpace>("se2")), body);
  expectRefused(called<ob::SE3StateSpace>("bare"), body);
  const auto base = checkerIn("rook6_cart", "base");
  expectRefused(compoundOf("free", called<ob::SE3StateSpace>("se3")), base);
  const auto swapped = [](const auto& first, const auto& second) {
    return compoundOf("swapped", first, second);
  };
  expectRefused(swapped(called<ob::SE2StateSpace>("se2"), called<ob::SO2StateSpace>("so2")), base);
}

/// Built by hand as makeStateSpace does, they are taken.
TEST(Spaces, OfTheSameLayoutAreTaken) {
  const std::vector<std::string> taken(3);
  EXPECT_EQ(messages(called<ob::RealVectorStateSpace>("flat", 3u), checkerIn("gantry", "all")),
            taken);
  EXPECT_EQ(messages(compoundOf("plane", called<ob::SE2StateSpace>("se2")),
                     checkerIn("rook6_cart", "base")),
            taken);
  EXPECT_EQ(
      messages(compoundOf("free", called<ob::SE3StateSpace>("se3")), checkerIn("drifter", "body")),
      taken);
}

/// Their motions are other ones than those that are certified.
TEST(Spaces, WithMotionsOfTheirOwnAreRefused) {
  const auto base = checkerIn("rook6_cart", "base");
  expectRefused(called<ob::DubinsStateSpace>("dubins"), base);
  expectRefused(called<ob::ReedsSheppStateSpace>("shepp"), base);
  expectRefused(compoundOf("driving", called<ob::DubinsStateSpace>("dubins")), base);
  expectRefused(compoundOf("parking", called<ob::ReedsSheppStateSpace>("shepp")), base);
  expectRefused(called<CurvedSpace>("curved"), checkerIn("gantry", "all"));
}

/// Their states hold those of the space within, and are no such states themselves.
TEST(Spaces, WithAConstraintAreRefused) {
  const auto arm = checkerIn("gantry", "all");
  const auto within = makeStateSpace(arm->robot(), arm->group());
  const auto constraint = std::make_shared<OnABall>();
  expectRefused(called<ob::ProjectedStateSpace>("projected", within, constraint), arm);
  expectRefused(called<ob::AtlasStateSpace>("atlas", within, constraint), arm);
  expectRefused(called<ob::WrapperStateSpace>("wrapped", within), arm);
}

TEST(Spaces, OfAnotherGroupAreRefusedWhereverTheyCome) {
  const auto checker = checkerIn("gantry", "all");
  const auto space = called<ob::RealVectorStateSpace>("other", 7u);
  space->setBounds(-1.0, 1.0);
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  const std::string wanted =
      "state space `other` is not built as makeStateSpace does for group `all`";
  const auto expectThrow = [&](const auto& act) {
    try {
      act();
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), wanted);
    }
  };
  expectThrow([&] { PoseGoal(si, checker, "ball", Eigen::Isometry3d::Identity()); });
  expectThrow([&] { certifyPath(og::PathGeometric(si), *checker); });
  expectThrow([&] {
    og::PathGeometric path(si);
    simplifyPath(path, *checker, 0.1);
  });
  expectThrow([&] {
    ob::PlannerData data(si);
    certifyEdges(data, *checker);
  });
}

// -------------------------------------------------------------------------------------- corners

/// Half a turn can be made either way: what is certified is the way that the space takes.
class HalfATurn : protected Seeded, public testing::Test {
 protected:
  static constexpr int kTurn = 1, kTheta = 6, kRotation = 10;  // of the group `all`

  /// Largest angle between what is certified and what OMPL interpolates.
  double gap(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> qa(14), qb(14), there(14);
    State from(space_), to(space_), at(space_);
    conversion_.toState(a, from.get());
    conversion_.toState(b, to.get());
    conversion_.toConfiguration(from.get(), qa);
    conversion_.toConfiguration(to.get(), qb);
    double largest = 0.0;
    for (const double t : {0.25, 0.5, 0.8}) {
      space_->interpolate(from.get(), to.get(), t, at.get());
      conversion_.toConfiguration(at.get(), there);
      const Eigen::VectorXd ours = checker_.interpolate(qa, qb, t);
      for (const int angle : {kTurn, kTheta})
        largest =
            std::max(largest, std::abs(std::remainder(ours[angle] - there[angle], 2.0 * kPi)));
      largest = std::max(largest,
                         rotation(&ours[kRotation]).angularDistance(rotation(&there[kRotation])));
    }
    return largest;
  }
  static Eigen::Quaterniond rotation(const double* xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
  }
  std::vector<double> random() const {
    State state(space_);
    state.random();
    std::vector<double> q(14);
    conversion_.toConfiguration(state.get(), q);
    return q;
  }

  std::shared_ptr<const Robot> robot_ = everyJoint();
  Checker checker_{robot_, "all", std::make_shared<const World>()};
  ob::StateSpacePtr space_ = makeStateSpace(*robot_, checker_.group());
  StateConversion conversion_{*robot_, checker_.group()};
};

TEST_F(HalfATurn, OfAnAngle) {
  int exact = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<double> a = random();
    if (i < 8) a[kTurn] = a[kTheta] = -kPi + i * 0.25 * kPi;
    std::vector<double> b = a;
    for (const int angle : {kTurn, kTheta}) b[angle] += b[angle] < 0.0 ? kPi : -kPi;
    exact += std::abs(b[kTurn] - a[kTurn]) == kPi;
    EXPECT_LT(gap(a, b), 1e-9) << i;
  }
  EXPECT_GT(exact, 100);
}

/// Between any two of these the product is exactly zero.
TEST_F(HalfATurn, OfABodyAboutItsAxes) {
  std::vector<double> a = random(), b = a;
  for (int from = 0; from < 4; ++from) {
    for (int to = 0; to < 4; ++to) {
      for (int k = 0; k < 4; ++k) {
        a[kRotation + k] = k == from;
        b[kRotation + k] = k == to;
      }
      EXPECT_LT(gap(a, b), 1e-9) << from << " to " << to;
      b[kRotation + to] = -1.0;
      EXPECT_LT(gap(a, b), 1e-9) << from << " to -" << to;
    }
  }
}

/// Here rounding decides on the sign of the product, and so on the way round.
TEST_F(HalfATurn, OfABodyAboutAnyAxis) {
  std::mt19937 engine(8);
  std::normal_distribution<double> normal;
  int other = 0, zero = 0;
  constexpr int kTurns = 500;
  for (int i = 0; i < kTurns; ++i) {
    std::vector<double> a = random(), b = a;
    const Eigen::Vector3d axis(normal(engine), normal(engine), normal(engine));
    const Eigen::Quaterniond from = rotation(&a[kRotation]);
    const Eigen::Quaterniond to = from * Eigen::AngleAxisd(kPi, axis.normalized());
    std::copy_n(to.coeffs().data(), 4, &b[kRotation]);
    zero += std::abs(from.dot(to)) < 1e-15;
    other += gap(a, b) > 1e-7;
  }
  EXPECT_EQ(zero, kTurns);
  EXPECT_EQ(other, 0) << "go the other way round";
}

}  // namespace
}  // namespace swept::test
