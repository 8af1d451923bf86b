// SPDX-License-Identifier: BSD-3-Clause
#include "bench/fcl.hpp"
#include "bench/fcl_validity.hpp"
#include "command_line/exit_code.hpp"

/// For builds without FCL.
namespace swept {

bool builtWithFcl() {
  return false;
}

std::string fclVersion() {
  return {};
}

std::vector<FclResult> measureFcl(const Checker&, const std::vector<BenchMotion>&, int,
                                  const BenchClock&) {
  throw UsageError("this build has no FCL");
}

ompl::base::StateValidityCheckerPtr fclValidity(const ompl::base::SpaceInformationPtr&,
                                                const Checker&) {
  throw UsageError("this build has no FCL");
}

}  // namespace swept
