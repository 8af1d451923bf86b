// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "robot_worlds.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/problems.hpp"

/// A robot's planning problems, read from the data folder.
namespace swept::benchmark {

constexpr std::size_t kAllProblems = std::numeric_limits<std::size_t>::max();

/// Ends in the order of the group's variables.
struct PlanningCase {
  std::string set;
  int index = 0;
  std::shared_ptr<const World> world;
  std::vector<double> start, goal;
};

/// Throws std::runtime_error when a variable of the group has no value in the problem.
inline std::vector<double> inGroupOrder(const Robot& robot, const Group& group,
                                        const PlanningProblem& problem,
                                        const std::vector<double>& values) {
  std::vector<double> q;
  for (const int variable : group.variables) {
    const std::string& name = robot.variables()[static_cast<std::size_t>(variable)].name;
    const auto found = std::ranges::find(problem.jointNames, name);
    if (found == problem.jointNames.end())
      throw std::runtime_error(problem.set + " " + std::to_string(problem.index) +
                               ": no value for joint " + name);
    q.push_back(values.at(static_cast<std::size_t>(found - problem.jointNames.begin())));
  }
  return q;
}

/// A robot by its name in robotCases(), its group, and the first `perSet` problems of each set.
class PlanningProblems {
 public:
  /// Throws InputError, and std::runtime_error for a problem without a goal or without a joint of
  /// the group.
  PlanningProblems(const std::filesystem::path& data, const std::string& name, std::size_t perSet) {
    const std::vector<RobotCase> robots = robotCases(data);
    const RobotCase& which = *std::ranges::find(robots, name, &RobotCase::name);
    robot_ = loadRobot(which);
    group_ = which.group;
    const ProblemFile file = ProblemFile::load(which.worlds);
    for (const std::string& set : file.sets()) {
      const std::vector<int> indices = file.indices(set);
      for (std::size_t i = 0; i < std::min(perSet, indices.size()); ++i)
        add(file.problem(set, indices[i]));
    }
  }

  const std::shared_ptr<const Robot>& robot() const { return robot_; }
  const std::string& group() const { return group_; }
  const std::vector<PlanningCase>& cases() const { return cases_; }

 private:
  void add(const PlanningProblem& problem) {
    const Group& group = *robot_->findGroup(group_);
    if (problem.goals.empty())
      throw std::runtime_error(problem.set + " " + std::to_string(problem.index) + ": no goal");
    cases_.push_back({problem.set, problem.index, std::make_shared<const World>(problem.world),
                      inGroupOrder(*robot_, group, problem, problem.start),
                      inGroupOrder(*robot_, group, problem, problem.goals.front())});
  }

  std::shared_ptr<const Robot> robot_;
  std::string group_;
  std::vector<PlanningCase> cases_;
};

}  // namespace swept::benchmark
