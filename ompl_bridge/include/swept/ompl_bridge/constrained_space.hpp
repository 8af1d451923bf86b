// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/geometric/SimpleSetup.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/configuration.hpp"

/// OMPL's constrained spaces over CheckerOptions::constraints, for any of OMPL's planners. They
/// keep states near a manifold, and say nothing of the motions between them: the validator here
/// proves those.
namespace ompl::base {
class Constraint;
}

namespace swept {

namespace detail {
class ConstraintValues;
}
class WorkspacePool;

/// The constraints of a checker as OMPL takes them: a function that is 0 in the middle of all of
/// them, with exact derivatives. Its values are those of ConstraintProjection::residuals, shares of
/// tolerances, but for those that no motion of the group changes. A state satisfies it if their
/// norm is at most the share given: no constraint then uses more of its tolerance, and the rest is
/// room for the motions between states. Values and derivatives of what is not finite are NaN, and a
/// sliding joint's value is taken to its limits. Any number of threads may call it.
///
/// Keeps no reference to the checker. Throws std::invalid_argument for a share that is not in (0,
/// 1); a checker without constraints, or with as many limited values as variables or more, which
/// leave no manifold; and a group with other joints than such with limits of their own: cyclic,
/// planar and floating ones, of which OMPL's constrained spaces know nothing.
std::shared_ptr<ompl::base::Constraint> makeManifoldConstraint(const Checker& checker,
                                                               double share = 0.5);

/// isValid is true if a state of a constrained space is within its bounds, free, and within all
/// constraints, proven. Any number of threads may call it.
class ConstrainedValidityChecker : public ompl::base::StateValidityChecker {
 public:
  /// Throws std::invalid_argument unless si's space is a constrained one over what makeStateSpace
  /// makes for the checker's group, and for a world with moving obstacles.
  ConstrainedValidityChecker(const ompl::base::SpaceInformationPtr& si,
                             std::shared_ptr<const Checker> checker);
  ~ConstrainedValidityChecker() override;
  /// See the class. Undecided counts as not valid.
  bool isValid(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const Checker> checker_;
  std::unique_ptr<WorkspacePool> pool_;
};

/// checkMotion is true if what provenWayPoints() gives for the two states is proven at every
/// instant: free, and within all constraints. That is the straight motion between them, or several
/// of such. Where one is not proven, its middle is moved into the constraints
/// (ConstraintProjection) and becomes a way point, until all are. So the motion does not depend on
/// charts, and is the same in both directions.
///
/// lastValid, of a motion that is not proven, becomes the first state and 0: nothing of it is
/// claimed. Of an atlas, each motion that is asked about also extends the charts, as OMPL's own
/// validator does; so only one thread at a time may use an atlas. Otherwise any number may.
class CertifiedGeodesicValidator : public ompl::base::MotionValidator {
 public:
  /// Throws std::invalid_argument as ConstrainedValidityChecker does, and for a checker without
  /// constraints.
  CertifiedGeodesicValidator(const ompl::base::SpaceInformationPtr& si,
                             std::shared_ptr<const Checker> checker);
  ~CertifiedGeodesicValidator() override;
  ///@{
  /// See the class.
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;
  ///@}
  /// From one configuration to the other, both included: each straight motion between two of them
  /// is proven. Empty: it is not proven, or there is none. Throws std::invalid_argument for another
  /// number of values than variables of the group.
  std::vector<std::vector<double>> wayPoints(ConfigurationView from, ConfigurationView to) const;

 private:
  std::shared_ptr<const Checker> checker_;
  std::unique_ptr<detail::ConstraintValues> values_;
  std::unique_ptr<WorkspacePool> pool_;
};

/// OMPL's constrained spaces.
enum class ConstrainedSpace : std::uint8_t {
  Projected,  ///< ProjectedStateSpace: projects each state that planners ask for
  Atlas,      ///< AtlasStateSpace: covers the manifold with charts
};

/// Space, makeManifoldConstraint(), ConstrainedValidityChecker and CertifiedGeodesicValidator of a
/// checker's group in one call, ready for start, goal and planner. Throws std::invalid_argument for
/// null, and as these do. `share`: of makeManifoldConstraint().
ompl::geometric::SimpleSetupPtr makeConstrainedSetup(
    std::shared_ptr<const Checker> checker, ConstrainedSpace space = ConstrainedSpace::Projected,
    double share = 0.5);

/// Sets start and goal of makeConstrainedSetup(), and anchors the atlas at both. Throws
/// std::invalid_argument for another setup, for a configuration with another number of values, and
/// for one that uses more of the tolerances than the setup's share: ConstraintProjection::project
/// finds one nearby that does not.
void setConstrainedStartAndGoal(ompl::geometric::SimpleSetup& setup, ConfigurationView start,
                                ConfigurationView goal);

/// The way points of a path over a space of makeConstrainedSetup(), with those that the validator
/// puts between its states: straight motions, all of them proven. Execute these, not the states
/// that PathGeometric::interpolate() adds. Empty: a motion of the path is not proven. Throws
/// std::invalid_argument if the space information's validator is another one.
std::vector<std::vector<double>> provenWayPoints(const ompl::geometric::PathGeometric& path);

}  // namespace swept
