// SPDX-License-Identifier: BSD-3-Clause
/// Motions through 1 mm plates and 2 mm rods that sampling at OMPL's default resolution calls
/// valid: both neighbouring samples lie beside the thin body, the contact between them. Mechanism:
/// a sample every 1 % of the space's extent moves the tip of the arm by centimetres.

#include <gtest/gtest.h>
#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/util/Console.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "first_hit.hpp"
#include "models_dir.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace {

namespace ob = ompl::base;
using swept::Verdict;

const std::filesystem::path kModels = modelsDir();

struct Motion {
  std::string robot;
  std::string group;
  std::vector<double> from;
  std::vector<double> to;
};

/// One robot in the trap, with OMPL's own discrete validator over the same state checks.
class Arm {
 public:
  Arm(const std::string& robot, const std::string& group) {
    const auto folder = kModels / "robots" / robot;
    auto world =
        std::make_shared<swept::World>(swept::World::load(kModels / "scenes" / "tunnel_trap.yaml"));
    checker_ = std::make_shared<swept::Checker>(
        swept::Robot::load(folder / (robot + ".urdf"), folder / (robot + ".srdf")), group, world);
    setup_ = swept::makeSimpleSetup(checker_);
    setup_->getSpaceInformation()->setup();
    conversion_ = std::make_unique<swept::StateConversion>(checker_->robot(), checker_->group());
    workspace_ = std::make_unique<swept::Workspace>(*checker_);
  }

  bool discretelyValid(const Motion& motion) const {
    ob::ScopedState<> from(setup_->getSpaceInformation());
    ob::ScopedState<> to(setup_->getSpaceInformation());
    conversion_->toState(motion.from, from.get());
    conversion_->toState(motion.to, to.get());
    if (!setup_->getSpaceInformation()->isValid(from.get())) return false;
    ob::DiscreteMotionValidator discrete(setup_->getSpaceInformation());
    return discrete.checkMotion(from.get(), to.get());
  }

  double firstHit(const Motion& motion) {
    return ::firstHit(*checker_, motion.from, motion.to, 1e-4, *workspace_);
  }

  swept::MotionCertificate certify(const Motion& motion) {
    return checker_->certifyMotion(motion.from, motion.to, *workspace_);
  }

 private:
  std::shared_ptr<swept::Checker> checker_;
  ompl::geometric::SimpleSetupPtr setup_;
  std::unique_ptr<swept::StateConversion> conversion_;
  std::unique_ptr<swept::Workspace> workspace_;
};

std::vector<double> numbers(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> values;
  for (double value; stream >> value;) values.push_back(value);
  return values;
}

/// Lines `robot,group,from,to,...` after one header line; values are separated by spaces.
std::vector<Motion> readMotions() {
  std::ifstream file(kModels / "scenes" / "tunnel_motions.csv");
  std::vector<Motion> motions;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    Motion motion;
    std::getline(fields, motion.robot, ',');
    std::getline(fields, motion.group, ',');
    std::string values;
    std::getline(fields, values, ',');
    motion.from = numbers(values);
    std::getline(fields, values, ',');
    motion.to = numbers(values);
    motions.push_back(std::move(motion));
  }
  return motions;
}

std::string joined(const std::vector<double>& q) {
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < q.size(); ++i) text << (i ? "," : "") << q[i];
  return text.str();
}

int exitCodeOfProgram(const Motion& motion) {
  const auto folder = kModels / "robots" / motion.robot;
  std::ostringstream command;
  command << SWEPT_PROGRAM << " motion " << folder / (motion.robot + ".urdf") << " --group "
          << motion.group << " --scene " << kModels / "scenes" / "tunnel_trap.yaml"
          << " --quiet >/dev/null -- " << joined(motion.from) << ' ' << joined(motion.to);
  const int status = std::system(command.str().c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(TunnelTrap, WhatSamplingCallsValidAndIsNotIsNeverCalledFree) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  std::map<std::string, Arm> arms;
  int traps = 0;
  for (const Motion& motion : readMotions()) {
    const std::string key = motion.robot + "/" + motion.group;
    auto arm = arms.find(key);
    if (arm == arms.end()) arm = arms.try_emplace(key, motion.robot, motion.group).first;
    SCOPED_TRACE(key + " " + joined(motion.from) + " " + joined(motion.to));
    if (!arm->second.discretelyValid(motion)) continue;
    const double hit = arm->second.firstHit(motion);
    if (hit > 1.0) continue;
    ++traps;
    const swept::MotionCertificate certificate = arm->second.certify(motion);
    EXPECT_NE(certificate.verdict, Verdict::Free);
    EXPECT_LE(certificate.freeUntil, hit);
    const int code = exitCodeOfProgram(motion);
    EXPECT_TRUE(code == 1 || code == 2) << code;
  }
  EXPECT_GE(traps, 20) << "motions of which discrete checking misses the collision";
}

}  // namespace
