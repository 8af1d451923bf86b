// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"

namespace swept::detail {

/// Makes checkers of the robot and a single body of the world: with the margins and rules of a
/// checker, without pairs of two links and without constraints. What such a checker proves, the
/// whole one may take as proven of these pairs.
class LoneChecker {
 public:
  /// `checker` must outlive this.
  explicit LoneChecker(const Checker& checker);

  Checker with(const WorldBody& body) const;
  /// m. The most that a link or an attached body has to keep from the body.
  double margin(const WorldBody& body) const;

 private:
  CollisionRules rulesFor(const std::string& body) const;

  const Checker& checker_;
  std::vector<std::string> carriers_;  ///< links and attached bodies with geometry
};

}  // namespace swept::detail
