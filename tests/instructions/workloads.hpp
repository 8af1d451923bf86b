// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "swept/robot_model/checker.hpp"

namespace swept::instructions {

/// The straight motion between two configurations of a checker's group.
struct Motion {
  std::vector<double> from;
  std::vector<double> to;
};

/// A robot in one world, with the motions and states to ask about there.
struct Site {
  explicit Site(Checker made) : checker(std::move(made)), workspace(checker) {}
  Checker checker;
  Workspace workspace;
  std::vector<Motion> motions;
  std::vector<double> states;     ///< follow each other
  std::vector<Verdict> verdicts;  ///< room for one of each state
};

/// What is counted: `run` puts each of `items` queries to a checker, and makes nothing else.
struct Workload {
  std::string name;
  std::size_t items = 0;  ///< motions or states
  std::vector<std::unique_ptr<Site>> sites;
  std::function<void(Site&)> run;
};

class Models;

std::vector<std::string> workloadNames();

/// Loads the robot and its worlds. Which motions a workload has follows
/// from the files, from fixed seeds and from which states are in contact: from nothing that a
/// faster search changes. Throws InputError; std::invalid_argument for a name that is not in
/// workloadNames().
Workload makeWorkload(std::string_view name, Models& models);

}  // namespace swept::instructions
