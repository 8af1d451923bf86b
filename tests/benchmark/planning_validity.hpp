// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "bench/clock.hpp"
#include "bench/fcl_robot.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "timing.hpp"

/// What planners ask of a validity checker and a motion validator, counted and timed.
namespace swept::benchmark {

/// A state is valid when FCL finds none of the checker's pairs in collision. For one thread.
class FclStates : public ompl::base::StateValidityChecker {
 public:
  /// The checker must outlive this.
  FclStates(const ompl::base::SpaceInformationPtr& si, const Checker& checker)
      : StateValidityChecker(si),
        robot_(std::make_unique<FclRobot>(checker)),
        conversion_(checker.robot(), checker.group()),
        q_(static_cast<std::size_t>(checker.dimension())) {}

  bool isValid(const ompl::base::State* state) const override {
    conversion_.toConfiguration(state, q_);
    return !robot_->collides(q_);
  }

 private:
  std::unique_ptr<FclRobot> robot_;
  StateConversion conversion_;
  mutable std::vector<double> q_;  // OMPL's interface is const; one thread uses this
};

/// What one planner asked, on one thread. A state that is checked within a motion is counted, and
/// its time is the motion's.
class ValidityMeter {
 public:
  explicit ValidityMeter(const BenchClock& clock) : clock_(clock) {}

  template <typename Work>
  bool state(const Work& work) {
    ++states_;
    return withinMotion_ ? work() : timed(work);
  }
  template <typename Work>
  bool motion(const Work& work) {
    ++motions_;
    withinMotion_ = true;
    const bool valid = timed(work);
    withinMotion_ = false;
    return valid;
  }

  std::uint64_t states() const { return states_; }
  std::uint64_t motions() const { return motions_; }
  std::uint64_t timedCalls() const { return calls_; }
  double nanoseconds() const { return nanoseconds_; }  ///< within the timed calls

 private:
  template <typename Work>
  bool timed(const Work& work) {
    ++calls_;
    bool valid = false;
    nanoseconds_ += clock_.time([&] { valid = work(); });
    return valid;
  }

  const BenchClock& clock_;
  bool withinMotion_ = false;
  std::uint64_t states_ = 0, motions_ = 0, calls_ = 0;
  double nanoseconds_ = 0.0;
};

class MeteredStates : public ompl::base::StateValidityChecker {
 public:
  MeteredStates(const ompl::base::SpaceInformationPtr& si,
                ompl::base::StateValidityCheckerPtr inner, ValidityMeter& meter)
      : StateValidityChecker(si), inner_(std::move(inner)), meter_(meter) {}

  bool isValid(const ompl::base::State* state) const override {
    return meter_.state([&] { return inner_->isValid(state); });
  }

 private:
  ompl::base::StateValidityCheckerPtr inner_;
  ValidityMeter& meter_;
};

class MeteredMotions : public ompl::base::MotionValidator {
 public:
  MeteredMotions(const ompl::base::SpaceInformationPtr& si, ompl::base::MotionValidatorPtr inner,
                 ValidityMeter& meter)
      : MotionValidator(si), inner_(std::move(inner)), meter_(meter) {}

  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override {
    return meter_.motion([&] { return inner_->checkMotion(from, to); });
  }
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& lastValid) const override {
    return meter_.motion([&] { return inner_->checkMotion(from, to, lastValid); });
  }

 private:
  ompl::base::MotionValidatorPtr inner_;
  ValidityMeter& meter_;
};

/// Puts a meter, which must outlive both, before the checker and the validator of `si`.
inline void meterValidity(const ompl::base::SpaceInformationPtr& si, ValidityMeter& meter) {
  si->setStateValidityChecker(
      std::make_shared<MeteredStates>(si, si->getStateValidityChecker(), meter));
  si->setMotionValidator(std::make_shared<MeteredMotions>(si, si->getMotionValidator(), meter));
}

/// s of CPU time that the meter adds to a planner for each timed call: more than the clock leaves
/// out of its readings, since each reading begins before and ends after what it measures.
inline double meterSeconds(const BenchClock& clock) {
  constexpr int kCalls = 200'000;
  ValidityMeter meter(clock);
  const double begin = cpuSeconds();
  for (int i = 0; i < kCalls; ++i) meter.state([&] { return meter.motions() == 0; });
  return (cpuSeconds() - begin) / kCalls;
}

}  // namespace swept::benchmark
