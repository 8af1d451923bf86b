// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>

#include <memory>
#include <utility>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

class WorkspacePool;

/// checkMotion is true if both ends are within the bounds of the space and the whole motion is
/// proven free.
///
/// lastValid (contract of ompl::base::MotionValidator): if the motion is invalid, `second` becomes
/// the largest proven t, and `first`, unless null, the state there. If it is valid, both stay
/// unchanged. The motion to that state is proven too. If it is not proven on its own, which happens
/// right before a contact, t is slightly less (by 1/1024, 2/1024, 4/1024, ... of the way). `second`
/// is 0 if an end is out of bounds; the part inside is not examined. Any number of threads may call
/// it.
class CertifiedMotionValidator : public ompl::base::MotionValidator {
 public:
  /// Throws std::invalid_argument unless si's space is built as makeStateSpace does for the
  /// checker's group, and for a world with moving obstacles.
  CertifiedMotionValidator(const ompl::base::SpaceInformationPtr& si,
                           std::shared_ptr<const Checker> checker);
  ~CertifiedMotionValidator() override;
  /// Uses this checker from now on; see swept::setChecker. No other call may be running. Throws as
  /// the constructor does, and then keeps the old checker.
  void setChecker(std::shared_ptr<const Checker> checker);
  /// The checker in use; never null.
  const std::shared_ptr<const Checker>& checker() const { return checker_; }
  ///@{
  /// See the class. Undecided counts as not valid. Never throws on states of the space.
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2) const override;
  bool checkMotion(const ompl::base::State* s1, const ompl::base::State* s2,
                   std::pair<ompl::base::State*, double>& lastValid) const override;
  ///@}

 private:
  bool count(bool free) const;

  std::shared_ptr<const Checker> checker_;
  StateConversion conversion_;
  std::unique_ptr<WorkspacePool> pool_;
};

}  // namespace swept
