// SPDX-License-Identifier: BSD-3-Clause
#include "report/asked_method.hpp"

#include <utility>

#include "swept/ompl_bridge/state_space.hpp"

namespace swept {

AskedMethod::AskedMethod(const ReportMethod& method, std::shared_ptr<const Checker> checker)
    : method_(method),
      checker_(std::move(checker)),
      statesChecked_(std::make_unique<std::atomic<std::uint64_t>>(0)),
      workspace_(*checker_) {
  const Validator validator{.kind = method.kind, .resolution = method.setting};
  setup_ = setupMaker(validator, *statesChecked_)(checker_, {});
  setup_->getSpaceInformation()->setup();
}

std::vector<AskedMethod> askedMethods(const std::vector<ReportMethod>& methods,
                                      const ReportCheckers& checkers) {
  std::vector<AskedMethod> asked;
  auto certified = checkers.certified.begin();
  for (const ReportMethod& method : methods) {
    const bool proves = method.kind == Validator::Kind::Certified;
    asked.emplace_back(method, proves ? *certified++ : checkers.truth);
  }
  return asked;
}

OmplMotions::OmplMotions(const Checker& checker, const std::vector<ReportMotion>& motions) {
  const StateConversion conversion(checker.robot(), checker.group());
  const ompl::base::StateSpacePtr space = makeStateSpace(checker.robot(), checker.group());
  for (const ReportMotion& motion : motions) {
    from.emplace_back(space);
    to.emplace_back(space);
    conversion.toState(motion.from, from.back().get());
    conversion.toState(motion.to, to.back().get());
  }
}

}  // namespace swept
