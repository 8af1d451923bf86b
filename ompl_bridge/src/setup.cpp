// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/setup.hpp"

#include <ompl/base/DiscreteMotionValidator.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "limit_warning.hpp"
#include "preconditions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "swept/ompl_bridge/validity_checker.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

/// Plans in the default environment, so that OMPL's own arithmetic also gives the same path.
class Setup final : public ompl::geometric::SimpleSetup {
 public:
  using SimpleSetup::SimpleSetup;
  void setup() override {
    inDefaultEnvironment([this] { SimpleSetup::setup(); });
  }
  ompl::base::PlannerStatus solve(double time) override {
    // OMPL's own starts a thread to look at the clock, which takes as long as a quick plan.
    return inDefaultEnvironment(
        [&] { return SimpleSetup::solve(ompl::base::timedPlannerTerminationCondition(time)); });
  }
  ompl::base::PlannerStatus solve(
      const ompl::base::PlannerTerminationCondition& condition) override {
    return inDefaultEnvironment([&] { return SimpleSetup::solve(condition); });
  }
};

}  // namespace

ompl::geometric::SimpleSetupPtr makeSimpleSetup(std::shared_ptr<const Checker> checker,
                                                const SetupOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return makeSimpleSetup(std::move(checker), options); });
  }
  if (!checker) throw std::invalid_argument("no checker given");
  auto setup =
      std::make_shared<Setup>(makeStateSpace(checker->robot(), checker->group(), options.space));
  const ompl::base::SpaceInformationPtr& si = setup->getSpaceInformation();
  setup->setStateValidityChecker(std::make_shared<ValidityChecker>(si, checker));
  if (options.motions == MotionCheck::Discrete) {
    si->setMotionValidator(std::make_shared<ompl::base::DiscreteMotionValidator>(si));
  } else {
    si->setMotionValidator(std::make_shared<CertifiedMotionValidator>(si, std::move(checker)));
  }
  return setup;
}

void setChecker(const ompl::base::SpaceInformation& si, std::shared_ptr<const Checker> checker) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { setChecker(si, std::move(checker)); });
  }
  auto* states = dynamic_cast<ValidityChecker*>(si.getStateValidityChecker().get());
  auto* motions = dynamic_cast<CertifiedMotionValidator*>(si.getMotionValidator().get());
  if (states == nullptr && motions == nullptr) {
    throw std::invalid_argument(
        "setChecker: the space information has neither a swept::ValidityChecker nor a "
        "swept::CertifiedMotionValidator");
  }
  // If one refuses, the other does, too: the first call throws, or none.
  if (states != nullptr) states->setChecker(checker);
  if (motions != nullptr) motions->setChecker(std::move(checker));
}

namespace {

/// A configuration as a state of the space. Values slightly beyond the space's bounds, which may be
/// narrower than the robot's limits, are moved to them.
ompl::base::ScopedState<> stateOf(const ompl::base::StateSpacePtr& space, const Checker& checker,
                                  std::span<const double> configuration, const char* of) {
  const Robot& robot = checker.robot();
  const StateConversion conversion(robot, checker.group());
  ompl::base::ScopedState<> state(space);
  conversion.toState(configuration, state.get());
  ompl::base::ScopedState<> bounded = state;
  space->enforceBounds(bounded.get());
  std::vector<double> q(configuration.begin(), configuration.end());
  std::vector<double> inside(q.size());
  conversion.toConfiguration(bounded.get(), inside);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Variable& variable = robot.variables()[checker.group().variables[i]];
    const std::string unit = unitOf(robot, variable);
    const bool turns = variable.cyclic || unit.empty();
    if (turns || inside[i] == q[i] || !isWithin(q[i], inside[i], inside[i])) continue;
    detail::warnOfLimit({variable.name, q[i], inside[i], unit}, of);
    q[i] = inside[i];
  }
  conversion.toState(q, state.get());
  return state;
}

}  // namespace

void setStartAndGoal(ompl::geometric::SimpleSetup& setup, const Checker& checker,
                     ConfigurationView start, ConfigurationView goal) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, start, goal] { return setStartAndGoal(setup, checker, start, goal); });
  }
  detail::requireSpaceOf(checker, *setup.getStateSpace());
  const ompl::base::ScopedState<> from = stateOf(setup.getStateSpace(), checker, start, "start");
  const ompl::base::ScopedState<> to = stateOf(setup.getStateSpace(), checker, goal, "goal");
  setup.setStartAndGoalStates(from, to);
}

}  // namespace swept
