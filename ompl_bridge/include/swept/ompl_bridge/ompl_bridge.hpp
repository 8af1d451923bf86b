// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSpace.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>

#include <Eigen/Core>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"

/// OMPL over a swept::Checker: `isValid` and `checkMotion` mean *proven free*. Holds no geometry.
namespace swept {

/// State space of a group: joints with limits become RealVector dimensions, continuous joints SO(2),
/// planar joints SE(2), floating joints SE(3). A group of joints with limits only is one
/// RealVectorStateSpace; any other is a compound in which consecutive limited joints share a RealVector.
/// Unbounded prismatic, planar or floating translations need bounds: pass them to `setBounds` of the
/// returned subspace before use; they are +-10 m here.
ompl::base::StateSpacePtr makeStateSpace(const Robot& robot, const Group& group);

/// Copies between a state of makeStateSpace(robot, group) and the group's configuration.
class StateConversion {
 public:
  StateConversion(const Robot& robot, const Group& group);
  int dimension() const { return dimension_; }
  void toConfiguration(const ompl::base::State* state, std::span<double> q) const;
  void toState(std::span<const double> q, ompl::base::State* state) const;

 private:
  struct Block;
  std::vector<Block> blocks_;  ///< one per subspace, in order
  bool compound_ = false;
  int dimension_ = 0;
};

/// Hands workspaces to threads: one is leased for the duration of a call.
class WorkspacePool;

/// isValid: within the bounds of the space and proven free. clearance: proven lower bound (m), 0 in contact.
/// Any number of threads may call it.
class ValidityChecker : public ompl::base::StateValidityChecker {
 public:
  ValidityChecker(const ompl::base::SpaceInformationPtr& si, std::shared_ptr<const Checker> checker);
  ~ValidityChecker() override;
  bool isValid(const ompl::base::State* state) const override;
  bool isValid(const ompl::base::State* state, double& dist) const override;
  double clearance(const ompl::base::State* state) const override;

 private:
  std::shared_ptr<const Checker> checker_;
  StateConversion conversion_;
  std::unique_ptr<WorkspacePool> pool_;
};

/// checkMotion: the whole motion is proven free. lastValid (contract of ompl::base::MotionValidator):
/// when the motion is invalid, `second` is the largest proven t and `first`, unless null, the state there.
/// Any number of threads may call it.
class CertifiedMotionValidator : public ompl::base::MotionValidator {
 public:
  CertifiedMotionValidator(const ompl::base::SpaceInformationPtr& si,
                           std::shared_ptr<const Checker> checker);
  ~CertifiedMotionValidator() override;
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;

 private:
  std::shared_ptr<const Checker> checker_;
  StateConversion conversion_;
  std::unique_ptr<WorkspacePool> pool_;
};

/// One call: space, checker and validator of a group, ready for start, goal and planner.
ompl::geometric::SimpleSetupPtr makeSimpleSetup(std::shared_ptr<const Checker> checker);

/// Certificates of all segments of a path, in order.
std::vector<MotionCertificate> certifyPath(const ompl::geometric::PathGeometric& path,
                                           const Checker& checker);

}  // namespace swept
