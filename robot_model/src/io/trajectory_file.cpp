// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/trajectory_file.hpp"

#include "io/group_columns.hpp"
#include "io/trajectory_formats.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/path_file.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {

std::vector<JointTrajectory> readTrajectories(const std::filesystem::path& file, const Robot& robot,
                                              const Group& group,
                                              const std::optional<Eigen::VectorXd>& reference,
                                              const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return readTrajectories(file, robot, group, reference, options); });
  }
  const Eigen::VectorXd still = detail::referenceOf(robot, reference);
  LoadOptions own = options;
  if (own.modelFrame.empty()) own.modelFrame = robot.modelFrame();
  const detail::InputSource source(file.string(), own);
  if (!isPathFile(file)) source.fail(0, "a trajectory file ends in .csv, .yaml, .yml or .json");
  detail::TrajectoryRows rows(source, robot, group, still);
  const std::string text = readTextFile(file);
  if (file.extension() == ".csv")
    detail::readCsvTrajectory(text, source, rows);
  else if (file.extension() == ".json")
    detail::readJsonTrajectory(text, source, rows);
  else
    detail::readYamlTrajectories(text, source, robot, rows);
  rows.tellRemarks();
  return rows.take();
}

}  // namespace swept
