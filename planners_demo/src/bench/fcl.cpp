// SPDX-License-Identifier: BSD-3-Clause
#include "bench/fcl.hpp"

#include <ompl/base/DiscreteMotionValidator.h>

#include <algorithm>
#include <limits>

#include "bench/fcl_robot.hpp"
#include "bench/fcl_validity.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;

class FclValidity : public ob::StateValidityChecker {
 public:
  FclValidity(const ob::SpaceInformationPtr& si, const Checker& checker)
      : ob::StateValidityChecker(si),
        robot_(std::make_unique<FclRobot>(checker)),
        conversion_(checker.robot(), checker.group()),
        q_(static_cast<std::size_t>(checker.dimension())) {}

  bool isValid(const ob::State* state) const override {
    conversion_.toConfiguration(state, q_);
    return !robot_->collides(q_);
  }

 private:
  std::unique_ptr<FclRobot> robot_;
  StateConversion conversion_;
  mutable std::vector<double> q_;  // OMPL's interface is const; one thread uses this
};

}  // namespace

bool builtWithFcl() {
  return true;
}

std::string fclVersion() {
  return FCL_VERSION;
}

ob::StateValidityCheckerPtr fclValidity(const ob::SpaceInformationPtr& si, const Checker& checker) {
  return std::make_shared<FclValidity>(si, checker);
}

std::vector<FclResult> measureFcl(const Checker& checker, const std::vector<BenchMotion>& motions,
                                  int passes, const BenchClock& clock) {
  const auto si =
      std::make_shared<ob::SpaceInformation>(makeStateSpace(checker.robot(), checker.group()));
  si->setStateValidityChecker(fclValidity(si, checker));
  si->setMotionValidator(std::make_shared<ob::DiscreteMotionValidator>(si));
  si->setup();
  const StateConversion conversion(checker.robot(), checker.group());
  ob::ScopedState<> from(si), to(si);
  std::vector<FclResult> results(motions.size());
  for (FclResult& result : results) result.nanoseconds = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      FclResult& result = results[i];
      conversion.toState(motions[i].from, from.get());
      conversion.toState(motions[i].to, to.get());
      const double taken = clock.time([&] {
        result.motionValid = si->getMotionValidator()->checkMotion(from.get(), to.get());
      });
      result.nanoseconds = std::min(result.nanoseconds, taken);
      if (pass == 0) result.startValid = si->isValid(from.get());
    }
  }
  return results;
}

}  // namespace swept
