// SPDX-License-Identifier: BSD-3-Clause
#include "contract.hpp"

#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

#include "models_dir.hpp"

namespace swept::test {
namespace {

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

}  // namespace

std::ostream& operator<<(std::ostream& out, const Subject& subject) {
  return out << subject.robot << "_" << subject.group << (subject.weighted ? "_weighted" : "");
}

std::string nameOf(const testing::TestParamInfo<Subject>& info) {
  std::ostringstream out;
  out << info.param;
  return out.str();
}

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> all = {
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
  return all;
}

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

Seeded::Seeded() {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(42);
}

Contract::Contract()
    : robot_(robotCalled(GetParam().robot)),
      checker_(checkerFor(GetParam())),
      group_(checker_->group()),
      setup_(makeSimpleSetup(
          checker_, {.space = optionsOf(*robot_, group_, GetParam().weighted), .motions = {}})) {
  si_->setup();
}

bool Contract::turnsInSpace() const {
  for (const int j : group_.joints)
    if (robot_->joints()[j].type == JointType::Floating) return true;
  return false;
}

Contract::State Contract::random() const {
  State state(space_);
  sampler_->sampleUniform(state.get());
  return state;
}

Contract::State Contract::near(const State& other, double distance) const {
  State state(space_);
  sampler_->sampleUniformNear(state.get(), other.get(), distance);
  return state;
}

Contract::State Contract::randomThatIs(bool valid) const {
  constexpr int kTries = 100'000;
  State state(space_);
  for (int i = 0; i < kTries; ++i) {
    sampler_->sampleUniform(state.get());
    if (si_->isValid(state.get()) == valid) return state;
  }
  throw std::runtime_error("the world of the test leaves no such state");
}

std::vector<double> Contract::configuration(const State& state) const {
  std::vector<double> q(conversion_.dimension());
  conversion_.toConfiguration(state.get(), q);
  return q;
}

}  // namespace swept::test
