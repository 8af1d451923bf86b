// SPDX-License-Identifier: BSD-3-Clause
#include <atomic>
#include <utility>

#include "preconditions.hpp"
#include "swept/ompl_bridge/motion_validator.hpp"
#include "workspace_pool.hpp"

namespace swept {

CertifiedMotionValidator::CertifiedMotionValidator(const ompl::base::SpaceInformationPtr& si,
                                                   std::shared_ptr<const Checker> checker)
    : MotionValidator(si),
      checker_(detail::requireChecker(std::move(checker), *si->getStateSpace())),
      conversion_(checker_->robot(), checker_->group()),
      pool_(std::make_unique<WorkspacePool>(*checker_)) {}

CertifiedMotionValidator::~CertifiedMotionValidator() = default;

// The counters are plain integers of OMPL's base class, which other threads may be raising too.
bool CertifiedMotionValidator::count(bool free) const {
  std::atomic_ref<unsigned int>(free ? valid_ : invalid_).fetch_add(1, std::memory_order_relaxed);
  return free;
}

// The bounds are convex under the space's interpolation, so two ends inside keep the motion inside.
bool CertifiedMotionValidator::checkMotion(const ompl::base::State* s1,
                                           const ompl::base::State* s2) const {
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
  if (!si_->satisfiesBounds(s1) || !si_->satisfiesBounds(s2)) {
    if (lastValid.first != nullptr) si_->copyState(lastValid.first, s1);
    lastValid.second = 0.0;
    return count(false);
  }
  const WorkspacePool::Lease scratch = pool_->lease();
  conversion_.toConfiguration(s1, scratch->from);
  conversion_.toConfiguration(s2, scratch->to);
  const MotionCertificate certificate = checker_->certifyMotion(
      scratch->from, scratch->to, scratch->workspace, MotionQuery::FirstContact);
  if (certificate.verdict == Verdict::Free) return count(true);

  if (lastValid.first != nullptr && certificate.freeUntil > 0.0) {
    // Not the space's interpolate: it takes orientations closer than 1e-4 rad for equal and would
    // leave the certified motion by that much.
    const Eigen::VectorXd q =
        checker_->interpolate(scratch->from, scratch->to, certificate.freeUntil);
    conversion_.toState({q.data(), static_cast<std::size_t>(q.size())}, lastValid.first);
  } else if (lastValid.first != nullptr) {
    si_->copyState(lastValid.first, s1);  // s2 may be NaN, and 0 * NaN would spoil the start
  }
  lastValid.second = certificate.freeUntil;
  return count(false);
}

}  // namespace swept
