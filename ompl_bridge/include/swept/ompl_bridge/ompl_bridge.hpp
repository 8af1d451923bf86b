// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSpace.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"

/// OMPL over a swept::Checker: `isValid` and `checkMotion` mean *proven free*. Holds no geometry.
namespace swept {

namespace detail {
enum class SubspaceKind : std::uint8_t { RealVector, SO2, SE2, SE3 };
}

/// State space of a group: joints with limits become RealVector dimensions, continuous joints
/// SO(2), planar joints SE(2), floating joints SE(3). A group of joints with limits only is one
/// RealVectorStateSpace; any other is a compound in which consecutive limited joints share a
/// RealVector. Its `interpolate` is the motion that Checker::certifyMotion certifies.
///
/// The space has the group's name, a dimension its variable's, a subspace its joint's
/// (`first..last` where joints share one). Subspaces weigh 1 each. Unbounded prismatic, planar or
/// floating translations need bounds: pass them to `setBounds` of the returned subspace before use;
/// they are +-10 m here. Throws std::invalid_argument for a group without variables.
ompl::base::StateSpacePtr makeStateSpace(const Robot& robot, const Group& group);

/// Copies between a state of makeStateSpace(robot, group) and the group's configuration.
/// Both throw std::invalid_argument unless q has `dimension()` values.
class StateConversion {
 public:
  StateConversion(const Robot& robot, const Group& group);
  int dimension() const { return dimension_; }
  void toConfiguration(const ompl::base::State* state, std::span<double> q) const;
  /// Puts angles of cyclic variables into [-pi, pi) and scales quaternions to unit length, as OMPL
  /// wants them. A zero or non-finite quaternion is copied as it is; such a state is never valid.
  void toState(std::span<const double> q, ompl::base::State* state) const;

 private:
  struct Block {
    detail::SubspaceKind kind;
    int first;  ///< into the configuration
    int size;   ///< numbers in the configuration
  };
  std::vector<Block> blocks_;  ///< one per subspace, in order
  bool compound_ = false;
  int dimension_ = 0;
};

/// Hands workspaces to threads: one is leased for the duration of a call.
class WorkspacePool;

/// isValid: within the bounds of the space and proven free. clearance: proven lower bound (m) of
/// the least distance, whatever the bounds and the margin; 0 in contact and for a state that is not
/// finite. Any number of threads may call it.
class ValidityChecker : public ompl::base::StateValidityChecker {
 public:
  /// Throws std::invalid_argument unless si's space is built as makeStateSpace does for the
  /// checker's group, and for a world with moving obstacles.
  ValidityChecker(const ompl::base::SpaceInformationPtr& si,
                  std::shared_ptr<const Checker> checker);
  ~ValidityChecker() override;
  using ompl::base::StateValidityChecker::clearance;
  using ompl::base::StateValidityChecker::isValid;
  bool isValid(const ompl::base::State* state) const override;
  double clearance(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const Checker> checker_;
  StateConversion conversion_;
  std::unique_ptr<WorkspacePool> pool_;
};

/// checkMotion: both ends are within the bounds of the space and the whole motion is proven free.
/// lastValid (contract of ompl::base::MotionValidator): when the motion is invalid, `second` is the
/// largest proven t and `first`, unless null, the state there; when it is valid both are left
/// alone. `second` is 0 when an end is out of bounds: nothing is asked about the part inside. Any
/// number of threads may call it.
class CertifiedMotionValidator : public ompl::base::MotionValidator {
 public:
  /// Throws std::invalid_argument unless si's space is built as makeStateSpace does for the
  /// checker's group, and for a world with moving obstacles.
  CertifiedMotionValidator(const ompl::base::SpaceInformationPtr& si,
                           std::shared_ptr<const Checker> checker);
  ~CertifiedMotionValidator() override;
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;

 private:
  bool count(bool free) const;

  std::shared_ptr<const Checker> checker_;
  StateConversion conversion_;
  std::unique_ptr<WorkspacePool> pool_;
};

/// One call: space, checker and validator of a group, ready for start, goal and planner.
/// Throws std::invalid_argument without a checker.
ompl::geometric::SimpleSetupPtr makeSimpleSetup(std::shared_ptr<const Checker> checker);

/// Certificates of all segments of a path, in order: one fewer than it has states. They say nothing
/// about bounds. Throws std::invalid_argument when the path is not one of the checker's group.
std::vector<MotionCertificate> certifyPath(const ompl::geometric::PathGeometric& path,
                                           const Checker& checker);

}  // namespace swept
