// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/ScopedState.h>
#include <ompl/geometric/SimpleSetup.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "report/random_motions.hpp"
#include "report/report.hpp"

namespace swept {

/// A method in one world, ready to be asked by one thread.
class AskedMethod {
 public:
  /// `checker` has the method's tolerance if it is a certified one. Throws UsageError as
  /// fclValidity does.
  AskedMethod(const ReportMethod& method, std::shared_ptr<const Checker> checker);

  const ReportMethod& method() const { return method_; }
  const Checker& checker() const { return *checker_; }
  Workspace& workspace() { return workspace_; }
  const ompl::base::StateSpace& space() const {
    return *setup_->getSpaceInformation()->getStateSpace();
  }
  const ompl::base::MotionValidator& validator() const {
    return *setup_->getSpaceInformation()->getMotionValidator();
  }

 private:
  ReportMethod method_;
  std::shared_ptr<const Checker> checker_;
  std::unique_ptr<std::atomic<std::uint64_t>> statesChecked_;
  ompl::geometric::SimpleSetupPtr setup_;
  Workspace workspace_;
};

std::vector<AskedMethod> askedMethods(const std::vector<ReportMethod>& methods,
                                      const ReportCheckers& checkers);

/// Motions as OMPL has them.
struct OmplMotions {
  OmplMotions(const Checker& checker, const std::vector<ReportMotion>& motions);
  std::vector<ompl::base::ScopedState<>> from, to;
};

}  // namespace swept
