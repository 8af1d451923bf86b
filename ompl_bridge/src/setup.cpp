// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/setup.hpp"

#include <ompl/base/DiscreteMotionValidator.h>

#include <stdexcept>
#include <utility>

#include "preconditions.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "swept/ompl_bridge/validity_checker.hpp"

namespace swept {

ompl::geometric::SimpleSetupPtr makeSimpleSetup(std::shared_ptr<const Checker> checker,
                                                const SetupOptions& options) {
  if (!checker) throw std::invalid_argument("no checker given");
  auto setup = std::make_shared<ompl::geometric::SimpleSetup>(
      makeStateSpace(checker->robot(), checker->group(), options.space));
  const ompl::base::SpaceInformationPtr& si = setup->getSpaceInformation();
  setup->setStateValidityChecker(std::make_shared<ValidityChecker>(si, checker));
  if (options.motions == MotionCheck::Discrete) {
    si->setMotionValidator(std::make_shared<ompl::base::DiscreteMotionValidator>(si));
  } else {
    si->setMotionValidator(std::make_shared<CertifiedMotionValidator>(si, std::move(checker)));
  }
  return setup;
}

void setStartAndGoal(ompl::geometric::SimpleSetup& setup, const Checker& checker,
                     std::span<const double> start, std::span<const double> goal) {
  detail::requireSpaceOf(checker, *setup.getStateSpace());
  const StateConversion conversion(checker.robot(), checker.group());
  ompl::base::ScopedState<> from(setup.getStateSpace()), to(setup.getStateSpace());
  conversion.toState(start, from.get());
  conversion.toState(goal, to.get());
  setup.setStartAndGoalStates(from, to);
}

}  // namespace swept
