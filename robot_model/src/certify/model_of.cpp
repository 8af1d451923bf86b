// SPDX-License-Identifier: BSD-3-Clause
#include "certify/model_of.hpp"

namespace swept::detail {

namespace {

using Model = std::shared_ptr<const CheckerModel> Checker::*;

/// An explicit instantiation may name a private member ([temp.spec.general]), so the public header
/// does not list who reads it.
template <Model kMember>
struct Reader {
  friend const CheckerModel& readModel(const Checker& checker) { return *(checker.*kMember); }
};
const CheckerModel& readModel(const Checker& checker);
template struct Reader<&Checker::model_>;

}  // namespace

const CheckerModel& modelOf(const Checker& checker) {
  return readModel(checker);
}

}  // namespace swept::detail
