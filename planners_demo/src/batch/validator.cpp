// SPDX-License-Identifier: BSD-3-Clause
#include "batch/validator.hpp"

#include <ompl/base/DiscreteMotionValidator.h>

#include <charconv>
#include <mutex>
#include <utility>

#include "bench/fcl.hpp"
#include "bench/fcl_validity.hpp"
#include "output/text_output.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;

/// Wraps another validity checker and counts its calls.
class CountedValidity : public ob::StateValidityChecker {
 public:
  CountedValidity(const ob::SpaceInformationPtr& si, ob::StateValidityCheckerPtr inner,
                  std::atomic<std::uint64_t>& count)
      : ob::StateValidityChecker(si), inner_(std::move(inner)), count_(count) {
    specs_ = inner_->getSpecs();
  }
  using ob::StateValidityChecker::isValid;
  bool isValid(const ob::State* state) const override {
    count_.fetch_add(1, std::memory_order_relaxed);
    return inner_->isValid(state);
  }
  double clearance(const ob::State* state) const override { return inner_->clearance(state); }
  double clearance(const ob::State* state, ob::State* validState,
                   bool& validStateAvailable) const override {
    return inner_->clearance(state, validState, validStateAvailable);
  }

 private:
  ob::StateValidityCheckerPtr inner_;
  std::atomic<std::uint64_t>& count_;
};

/// For planners with threads: each query moves FCL's objects.
class OneAtATime : public ob::StateValidityChecker {
 public:
  OneAtATime(const ob::SpaceInformationPtr& si, ob::StateValidityCheckerPtr inner)
      : ob::StateValidityChecker(si), inner_(std::move(inner)) {}
  using ob::StateValidityChecker::isValid;
  bool isValid(const ob::State* state) const override {
    const std::lock_guard lock(mutex_);
    return inner_->isValid(state);
  }

 private:
  ob::StateValidityCheckerPtr inner_;
  mutable std::mutex mutex_;  // OMPL's interface is const
};

[[noreturn]] void refuse(const std::string& text) {
  throw UsageError(
      "no validator '" + text +
      "'; there are certified, discrete:R and fcl:R, with R between 1e-6 and 0.5, such "
      "as discrete:0.01");
}

}  // namespace

std::string Validator::name() const {
  switch (kind) {
    case Kind::Certified:
      return "certified";
    case Kind::Discrete:
      return "discrete:" + exactNumber(resolution);
    case Kind::Fcl:
      break;
  }
  return "fcl:" + exactNumber(resolution);
}

Validator readValidator(const std::string& text, double margin) {
  if (text == "certified") return {};
  Validator validator;
  const auto colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  if (colon == std::string::npos || (kind != "discrete" && kind != "fcl")) refuse(text);
  validator.kind = kind == "fcl" ? Validator::Kind::Fcl : Validator::Kind::Discrete;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + colon + 1, end, validator.resolution);
  const bool readable = read.ec == std::errc() && read.ptr == end;
  if (!readable || !(validator.resolution >= 1e-6 && validator.resolution <= 0.5)) refuse(text);
  if (validator.kind != Validator::Kind::Fcl) return validator;
  if (!builtWithFcl())
    throw UsageError("validator '" + text +
                     "': this build has no FCL; install it and configure again");
  if (margin > 0.0)
    throw UsageError("validator '" + text +
                     "' needs a margin of 0: whether FCL finds a collision is not a matter of "
                     "distance");
  return validator;
}

SetupMaker setupMaker(const Validator& validator, std::atomic<std::uint64_t>& statesChecked) {
  return [validator, &statesChecked](const std::shared_ptr<const Checker>& checker,
                                     const StateSpaceOptions& space) {
    SetupOptions options{.space = space};
    const bool certified = validator.kind == Validator::Kind::Certified;
    options.motions = certified ? MotionCheck::Certified : MotionCheck::Discrete;
    auto setup = makeSimpleSetup(checker, options);
    const ob::SpaceInformationPtr& si = setup->getSpaceInformation();
    ob::StateValidityCheckerPtr states = si->getStateValidityChecker();
    if (validator.kind == Validator::Kind::Fcl)
      states = std::make_shared<OneAtATime>(si, fclValidity(si, *checker));
    setup->setStateValidityChecker(std::make_shared<CountedValidity>(si, states, statesChecked));
    if (!certified) si->getStateSpace()->setLongestValidSegmentFraction(validator.resolution);
    return setup;
  };
}

}  // namespace swept
