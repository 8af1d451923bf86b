// SPDX-License-Identifier: BSD-3-Clause
#include "used_checker.hpp"

#include "swept/ompl_bridge/motion_validator.hpp"
#include "swept/ompl_bridge/validity_checker.hpp"

namespace swept::detail {

std::shared_ptr<const Checker> checkerOf(const ompl::base::SpaceInformation& si) {
  if (const auto* motions = dynamic_cast<CertifiedMotionValidator*>(si.getMotionValidator().get()))
    return motions->checker();
  if (const auto* states = dynamic_cast<ValidityChecker*>(si.getStateValidityChecker().get()))
    return states->checker();
  return nullptr;
}

}  // namespace swept::detail
