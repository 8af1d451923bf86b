// SPDX-License-Identifier: BSD-3-Clause
#include <atomic>
#include <cstddef>
#include <span>
#include <utility>

#include "preconditions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "swept/ompl_bridge/paths.hpp"
#include "swept/robot_model/limits.hpp"
#include "workspace_pool.hpp"

namespace swept {
namespace {

// The largest t up to which the motion to the state `q` there is proven; all before freeUntil is.
// Planners assume without a check that the way to the last valid state is valid. As a separate
// motion it is examined at other times than the whole was, and right before a contact that may
// change the answer.
double lastProven(const Checker& checker, WorkspacePool::Scratch& scratch, double freeUntil,
                  std::span<double> q) {
  constexpr double kLeastStep = 1.0 / 1024.0;  // of the way, doubled each time
  double share = 1.0;
  for (double step = kLeastStep; share > 0.0; share = 1.0 - step, step *= 2.0) {
    const double t = share * freeUntil;
    if (!(t > 0.0)) return 0.0;
    // Not the space's interpolate: it takes orientations closer than 1e-4 rad for equal and would
    // leave the certified motion by that much.
    checker.interpolate(scratch.from, scratch.to, t, q);
    // As the state's conversion will do: it is certified in the converted form.
    takeToLimits(checker.robot(), checker.group(), q);
    const MotionCertificate certificate =
        checker.certifyMotion(scratch.from, q, scratch.workspace, MotionQuery::VerdictOnly);
    if (certificate.verdict == Verdict::Free) return t;
  }
  return 0.0;
}

}  // namespace

CertifiedMotionValidator::CertifiedMotionValidator(const ompl::base::SpaceInformationPtr& si,
                                                   std::shared_ptr<const Checker> checker)
    : MotionValidator(si),
      checker_(detail::requireChecker(std::move(checker), *si->getStateSpace())),
      conversion_(checker_->robot(), checker_->group()),
      pool_(std::make_unique<WorkspacePool>(*checker_)) {}

CertifiedMotionValidator::~CertifiedMotionValidator() = default;

void CertifiedMotionValidator::setChecker(std::shared_ptr<const Checker> checker) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { setChecker(std::move(checker)); });
  }
  checker = detail::requireChecker(std::move(checker), *si_->getStateSpace());
  auto pool = std::make_unique<WorkspacePool>(*checker);
  conversion_ = StateConversion(checker->robot(), checker->group());
  pool_ = std::move(pool);
  checker_ = std::move(checker);
}

// The counters are plain integers of OMPL's base class, and other threads may increment them, too.
bool CertifiedMotionValidator::count(bool free) const {
  std::atomic_ref<unsigned int>(free ? valid_ : invalid_).fetch_add(1, std::memory_order_relaxed);
  return free;
}

// The bounds are convex under the space's interpolation, so two ends inside keep the motion inside.
bool CertifiedMotionValidator::checkMotion(const ompl::base::State* s1,
                                           const ompl::base::State* s2) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, s1, s2] { return CertifiedMotionValidator::checkMotion(s1, s2); });
  }
  if (!si_->satisfiesBounds(s1) || !si_->satisfiesBounds(s2)) return count(false);
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(s1, scratch->from);
  conversion_.toConfiguration(s2, scratch->to);
  const MotionCertificate certificate = checker_->certifyMotion(
      scratch->from, scratch->to, scratch->workspace, MotionQuery::VerdictOnly);
  return count(certificate.verdict == Verdict::Free);
}

bool CertifiedMotionValidator::checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                                           std::pair<ompl::base::State*, double>& lastValid) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, s1, s2] { return CertifiedMotionValidator::checkMotion(s1, s2, lastValid); });
  }
  if (!si_->satisfiesBounds(s1) || !si_->satisfiesBounds(s2)) {
    if (lastValid.first != nullptr) si_->copyState(lastValid.first, s1);
    lastValid.second = 0.0;
    return count(false);
  }
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(s1, scratch->from);
  conversion_.toConfiguration(s2, scratch->to);
  const MotionCertificate certificate =
      checker_->certifyMotion(scratch->from, scratch->to, scratch->workspace);
  if (certificate.verdict == Verdict::Free) return count(true);

  lastValid.second = lastProven(*checker_, *scratch, certificate.freeUntil, scratch->proven);
  if (lastValid.first != nullptr && lastValid.second > 0.0) {
    conversion_.toState(scratch->proven, lastValid.first);
  } else if (lastValid.first != nullptr) {
    si_->copyState(lastValid.first, s1);  // s2 may be NaN, and 0 * NaN would spoil the start
  }
  return count(false);
}

}  // namespace swept
