// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "path_robot.hpp"
#include "swept/robot_model/trajectory_file.hpp"
#include "text/numbers.hpp"

namespace swept::test {

/// What readTrajectories() makes of a text.
class TrajectoryReading {
 public:
  TrajectoryReading(const std::string& name, const std::string& text,
                    const std::string& group = "arm",
                    const std::shared_ptr<const Robot>& robot = pathRobot(),
                    const std::optional<Eigen::VectorXd>& reference = {}) {
    const std::filesystem::path file = folder_.write(name, text);
    LoadOptions options;
    options.warn = [&](const std::string& line) { warnings.push_back(shortened(line)); };
    try {
      trajectories = readTrajectories(file, *robot, *robot->findGroup(group), reference, options);
    } catch (const InputError& error) {
      message = shortened(error.what());
    }
  }

  std::vector<JointTrajectory> trajectories;
  std::string message;  ///< of the InputError
  std::vector<std::string> warnings;

 private:
  /// Without the folder.
  std::string shortened(const std::string& line) const {
    return line.substr(
        line.starts_with(folder_.path().string()) ? folder_.path().string().size() + 1 : 0);
  }
  TemporaryFolder folder_;
};

/// `[1 -0.5]`, in the fewest digits that read back to the same numbers.
inline std::string shown(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values)
    text += (text.size() > 1 ? " " : "") + detail::formatNumber(value);
  return text + "]";
}

/// A line for each trajectory and each of its points.
inline std::string shown(const std::vector<JointTrajectory>& trajectories) {
  std::string text;
  for (const JointTrajectory& trajectory : trajectories) {
    for (const std::string& name : trajectory.variables)
      text += (text.empty() || text.back() == '\n' ? "" : " ") + name;
    text += "\n";
    for (const TrajectoryPoint& point : trajectory.points)
      text += detail::formatNumber(point.time) + " " + shown(point.positions) +
              (point.velocities.empty() ? "" : " v " + shown(point.velocities)) +
              (point.accelerations.empty() ? "" : " a " + shown(point.accelerations)) + "\n";
  }
  return text;
}

}  // namespace swept::test
