// SPDX-License-Identifier: BSD-3-Clause
#include "preconditions.hpp"

#include <stdexcept>
#include <vector>

#include "swept/ompl_bridge/state_space.hpp"

namespace swept::detail {

void requireSpaceOf(const Checker& checker, const ompl::base::StateSpace& space) {
  std::vector<int> wanted, given;
  makeStateSpace(checker.robot(), checker.group())->computeSignature(wanted);
  space.computeSignature(given);
  if (given != wanted) {
    throw std::invalid_argument("state space `" + space.getName() +
                                "` is not built as makeStateSpace does for group `" +
                                checker.group().name + "`");
  }
}

std::shared_ptr<const Checker> requireChecker(std::shared_ptr<const Checker> checker,
                                              const ompl::base::StateSpace& space) {
  if (!checker) throw std::invalid_argument("no checker given");
  if (!checker->world().obstacles().empty()) {
    throw std::invalid_argument("the checker's world has a moving obstacle, `" +
                                checker->world().obstacles().front().name +
                                "`, and states of the space have no time");
  }
  requireSpaceOf(*checker, space);
  return checker;
}

}  // namespace swept::detail
