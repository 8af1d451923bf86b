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

/// checkMotion: both ends are within the bounds of the space and the whole motion is proven free.
/// lastValid (contract of ompl::base::MotionValidator): when the motion is invalid, `second` is the
/// largest proven t and `first`, unless null, the state there; when it is valid both are left
/// alone. The motion to that state is proven too: where it is not proven on its own, which happens
/// right before a contact, t is a little less (of the way 1/1024, 2/1024, 4/1024, ...). `second` is
/// 0 when an end is out of bounds: nothing is asked about the part inside. Any number of threads
/// may call it.
class CertifiedMotionValidator : public ompl::base::MotionValidator {
 public:
  /// Throws std::invalid_argument unless si's space is built as makeStateSpace does for the
  /// checker's group, and for a world with moving obstacles.
  CertifiedMotionValidator(const ompl::base::SpaceInformationPtr& si,
                           std::shared_ptr<const Checker> checker);
  ~CertifiedMotionValidator() override;
  /// Asks this checker from now on; see swept::setChecker. No other call may be in flight. Throws
  /// as the constructor, and goes on with the checker that it had then.
  void setChecker(std::shared_ptr<const Checker> checker);
  /// Who is asked; never null.
  const std::shared_ptr<const Checker>& checker() const { return checker_; }
  ///@{
  /// See the class. Undecided is not valid. Never throws on states of the space.
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
