// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/path_file.hpp"

#include "io/path_formats.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {

bool isPathFile(const std::filesystem::path& file) {
  const std::filesystem::path ending = file.extension();
  return ending == ".csv" || ending == ".json" || ending == ".yaml" || ending == ".yml";
}

std::vector<std::vector<double>> readPath(const std::filesystem::path& file, const Robot& robot,
                                          const Group& group,
                                          const std::optional<Eigen::VectorXd>& reference,
                                          const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return readPath(file, robot, group, reference, options); });
  }
  const Eigen::VectorXd still = detail::referenceOf(robot, reference);
  LoadOptions own = options;
  if (own.modelFrame.empty()) own.modelFrame = robot.modelFrame();
  const detail::InputSource source(file.string(), own);
  if (!isPathFile(file)) source.fail(0, "a path file ends in .csv, .yaml, .yml or .json");
  detail::PathRows rows(source, robot, group, still);
  const std::string text = readTextFile(file);
  if (file.extension() == ".csv")
    detail::readCsvPath(text, source, rows);
  else if (file.extension() == ".json")
    detail::readJsonPath(text, source, rows);
  else
    detail::readYamlPath(text, source, robot, rows);
  rows.tellRemarks();
  return rows.take();
}

}  // namespace swept
