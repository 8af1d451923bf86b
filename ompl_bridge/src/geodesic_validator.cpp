// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/base/spaces/constraint/AtlasStateSpace.h>
#include <ompl/base/spaces/constraint/ConstrainedStateSpace.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>

#include "constraint_values.hpp"
#include "preconditions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/constrained_space.hpp"
#include "workspace_pool.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;
using WayPoints = std::vector<std::vector<double>>;

/// rad or m. A chord so short that is not proven ends the search.
constexpr double kLeastChord = 1e-4;
/// Of a chord, how far its middle may be from either end once it is moved into the constraints.
constexpr double kMostOfChord = 0.75;
constexpr std::size_t kMostWayPoints = 10'000;

double lengthOf(ConfigurationView a, ConfigurationView b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(b[i] - a[i]));
  return most;
}

class ChordSearch {
 public:
  ChordSearch(const Checker& checker, detail::ConstraintValues& values, Workspace& workspace)
      : checker_(checker), values_(values), workspace_(workspace) {}

  WayPoints run(ConfigurationView from, ConfigurationView to) {
    found_.emplace_back(from.begin(), from.end());
    if (!prove(from, to)) found_.clear();
    return std::move(found_);
  }

 private:
  /// Adds what follows `from`, which is the last one.
  bool prove(ConfigurationView from, ConfigurationView to) {
    const MotionCertificate certificate =
        checker_.certifyMotion(from, to, workspace_, MotionQuery::VerdictOnly);
    if (certificate.verdict == Verdict::Free) {
      found_.emplace_back(to.begin(), to.end());
      return true;
    }
    const double length = lengthOf(from, to);
    if (!(length > kLeastChord) || found_.size() >= kMostWayPoints) return false;
    std::vector<double> middle(from.size());
    // The same in both directions.
    for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = 0.5 * (from[i] + to[i]);
    if (!values_.project(middle)) return false;
    const double most = kMostOfChord * length;
    if (!(lengthOf(from, middle) <= most && lengthOf(middle, to) <= most)) return false;
    if (checker_.checkState(middle, workspace_) != Verdict::Free) return false;
    return prove(from, middle) && prove(middle, to);
  }

  const Checker& checker_;
  detail::ConstraintValues& values_;
  Workspace& workspace_;
  WayPoints found_;
};

const ob::ConstrainedStateSpace& spaceOf(const ob::SpaceInformation& si) {
  const auto* space = dynamic_cast<const ob::ConstrainedStateSpace*>(si.getStateSpace().get());
  if (space == nullptr)
    throw std::invalid_argument("constrained space: '" + si.getStateSpace()->getName() +
                                "' is none of OMPL's constrained spaces");
  return *space;
}

}  // namespace

CertifiedGeodesicValidator::CertifiedGeodesicValidator(const ob::SpaceInformationPtr& si,
                                                       std::shared_ptr<const Checker> checker)
    : MotionValidator(si),
      checker_(detail::requireChecker(std::move(checker), *spaceOf(*si).getSpace())),
      values_(std::make_unique<detail::ConstraintValues>(*checker_)),
      pool_(std::make_unique<WorkspacePool>(*checker_)) {
  if (values_->rows() == 0)
    throw std::invalid_argument("constrained space: the checker has no constraint");
}

CertifiedGeodesicValidator::~CertifiedGeodesicValidator() = default;

std::vector<std::vector<double>> CertifiedGeodesicValidator::wayPoints(ConfigurationView from,
                                                                       ConfigurationView to) const {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&, from, to] { return wayPoints(from, to); });
  const auto expected = static_cast<std::size_t>(checker_->dimension());
  if (from.size() != expected || to.size() != expected)
    throw std::invalid_argument("constrained space: " + std::to_string(from.size()) + " and " +
                                std::to_string(to.size()) + " values; there are " +
                                std::to_string(expected) + " variables");
  const WorkspacePool::Lease scratch = pool_->lease();
  return ChordSearch(*checker_, *values_, scratch->workspace).run(from, to);
}

bool CertifiedGeodesicValidator::checkMotion(const ob::State* s1, const ob::State* s2) const {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment(
        [&, s1, s2] { return CertifiedGeodesicValidator::checkMotion(s1, s2); });
  const auto valuesOf = [](const ob::State* state) -> ConfigurationView {
    const auto& x = *state->as<ob::ConstrainedStateSpace::StateType>();
    return {x.data(), static_cast<std::size_t>(x.size())};
  };
  // An atlas learns of the manifold from where OMPL's own validator goes: samples are of its
  // charts.
  if (const auto* atlas = dynamic_cast<const ob::AtlasStateSpace*>(si_->getStateSpace().get()))
    atlas->discreteGeodesic(s1, s2, false);
  const bool valid = si_->satisfiesBounds(s1) && si_->satisfiesBounds(s2) &&
                     !wayPoints(valuesOf(s1), valuesOf(s2)).empty();
  // Plain integers of OMPL's base class, which other threads may increment, too.
  std::atomic_ref<unsigned int>(valid ? valid_ : invalid_).fetch_add(1, std::memory_order_relaxed);
  return valid;
}

bool CertifiedGeodesicValidator::checkMotion(const ob::State* s1, const ob::State* s2,
                                             std::pair<ob::State*, double>& lastValid) const {
  if (checkMotion(s1, s2)) return true;
  if (lastValid.first != nullptr) si_->copyState(lastValid.first, s1);
  lastValid.second = 0.0;
  return false;
}

}  // namespace swept
