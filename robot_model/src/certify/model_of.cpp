// SPDX-License-Identifier: BSD-3-Clause
#include "certify/model_of.hpp"

#include "swept/robot_model/checker.hpp"

namespace swept::detail {

const CheckerModel& modelOf(const Checker& checker) {
  return *checker.model_;
}

}  // namespace swept::detail
