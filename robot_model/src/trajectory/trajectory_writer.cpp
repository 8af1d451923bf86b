// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <set>
#include <stdexcept>

#include "output/text_output.hpp"
#include "output/whole_file.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/trajectory_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "trajectory/trajectory_text.hpp"
#include "trajectory/valid_trajectory.hpp"

namespace swept {

namespace {

void requireNames(const std::vector<std::string>& variables) {
  if (variables.empty()) throw std::invalid_argument("writeTrajectory: there is no variable");
  std::set<std::string> known;
  for (const std::string& name : variables)
    if (!known.insert(name).second)
      throw std::invalid_argument("writeTrajectory: '" + name + "' is there twice");
}

void write(const std::filesystem::path& file, const JointTrajectory& trajectory,
           const std::function<std::string(const std::string& where)>& yamlText) {
  detail::requireValid(trajectory, "writeTrajectory");
  requireNames(trajectory.variables);
  const std::string where = "'" + file.string() + "'";
  const std::filesystem::path ending = file.extension();
  if (ending != ".csv") requireUtf8(trajectory.variables, where);
  std::string text;
  if (ending == ".csv")
    text = detail::csvTrajectory(trajectory, where);
  else if (ending == ".json")
    text = detail::jsonTrajectory(trajectory);
  else if (ending == ".yaml" || ending == ".yml")
    text = yamlText(where);
  else
    throw UsageError(where + ": a trajectory file ends in .csv, .yaml, .yml or .json");
  if (text.size() > kMaxTextBytes)
    throw UsageError(where + ": the trajectory takes " + std::to_string(text.size()) +
                     " bytes, and files of more than " + std::to_string(kMaxTextBytes) +
                     " are not read");
  writeWholeFile(file, text);
}

}  // namespace

void writeTrajectory(const std::filesystem::path& file, const JointTrajectory& trajectory) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { writeTrajectory(file, trajectory); });
  }
  write(file, trajectory,
        [&](const std::string& where) { return detail::yamlTrajectory(trajectory, where); });
}

void writeTrajectory(const std::filesystem::path& file, const JointTrajectory& trajectory,
                     const Robot& robot, TrajectoryMessage message) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { writeTrajectory(file, trajectory, robot, message); });
  }
  write(file, trajectory, [&](const std::string& where) {
    return detail::yamlTrajectory(trajectory, robot, message, where);
  });
}

}  // namespace swept
