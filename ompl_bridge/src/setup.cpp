// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <utility>

#include "preconditions.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept {

ompl::geometric::SimpleSetupPtr makeSimpleSetup(std::shared_ptr<const Checker> checker) {
  if (!checker) throw std::invalid_argument("no checker given");
  auto setup = std::make_shared<ompl::geometric::SimpleSetup>(
      makeStateSpace(checker->robot(), checker->group()));
  const ompl::base::SpaceInformationPtr& si = setup->getSpaceInformation();
  setup->setStateValidityChecker(std::make_shared<ValidityChecker>(si, checker));
  si->setMotionValidator(std::make_shared<CertifiedMotionValidator>(si, std::move(checker)));
  return setup;
}

std::vector<MotionCertificate> certifyPath(const ompl::geometric::PathGeometric& path,
                                           const Checker& checker) {
  detail::requireSpaceOf(checker, *path.getSpaceInformation()->getStateSpace());
  std::vector<MotionCertificate> certificates;
  if (path.getStateCount() == 0) return certificates;

  const StateConversion conversion(checker.robot(), checker.group());
  Workspace workspace(checker);
  std::vector<double> from(conversion.dimension()), to(conversion.dimension());
  conversion.toConfiguration(path.getState(0), from);
  for (std::size_t i = 1; i < path.getStateCount(); ++i) {
    conversion.toConfiguration(path.getState(static_cast<unsigned int>(i)), to);
    certificates.push_back(checker.certifyMotion(from, to, workspace));
    from.swap(to);
  }
  return certificates;
}

}  // namespace swept
