// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "input/task.hpp"

namespace swept {

/// A place to move in, and what to call it.
struct ReportWorld {
  std::string name;
  std::shared_ptr<const World> world;
};

/// The one of --scene and --cloud, or those of the chosen problems. Throws UsageError or
/// InputError.
std::vector<ReportWorld> reportWorlds(const Arguments& args, const Model& model);

/// rad or m. What each joint may be off in the tubes around executed paths.
inline constexpr std::array kTubes{0.01, 0.005};

/// Checkers of one world that differ in their tolerance, or in their tube.
struct ReportCheckers {
  std::shared_ptr<const Checker> truth;                   ///< at the finest tolerance there is
  std::vector<std::shared_ptr<const Checker>> certified;  ///< as --tolerances has them
  std::vector<std::shared_ptr<const Checker>> tubes;      ///< in kTubes, at tolerance::kMotion
};

/// Makes them, for one world after the other.
class CheckerMaker {
 public:
  /// Takes a while: what depends on the robot alone is made here. Throws as makeChecker. `args` and
  /// `model` have to outlive this.
  CheckerMaker(const Arguments& args, const Model& model, const Group& group, Warnings& warnings);
  ReportCheckers in(const std::shared_ptr<const World>& world) const;

 private:
  const Arguments& args_;
  const Model& model_;
  Warnings& warnings_;
  ReportCheckers like_;
};

/// m. The tolerance at which the truth is found.
inline constexpr double kTruthTolerance = 1e-6;

}  // namespace swept
