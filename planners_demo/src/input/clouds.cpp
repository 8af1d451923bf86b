// SPDX-License-Identifier: BSD-3-Clause
#include "input/clouds.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "command_line/exit_code.hpp"
#include "input/poses.hpp"
#include "input/state_lists.hpp"
#include "input/task.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "swept/core/sensed_space.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/self_filter.hpp"
#include "swept/robot_model/sensed_world.hpp"

namespace swept {
namespace {

/// What --self-filter leaves of what was seen (m, world).
class SelfFilter {
 public:
  SelfFilter(const Arguments& args, const Robot& robot,
             const std::optional<Eigen::VectorXd>& reference, const LoadOptions& options)
      : robot_(robot), margin_(args.selfFilter), warn_(options.warn) {
    if (!margin_) return;
    if (args.states.empty() && args.path.empty())
      throw UsageError("--self-filter needs a state: that in which the robot was seen");
    const Group& group = chooseGroup(robot, args);
    const std::vector<double> q = firstState(args, robot, group, reference, options);
    const Eigen::VectorXd others = reference.value_or(robot.defaultState());
    state_.assign(others.begin(), others.end());
    for (std::size_t i = 0; i < q.size(); ++i)
      state_[static_cast<std::size_t>(group.variables[i])] = q[i];
  }

  bool isOn() const { return margin_.has_value(); }

  std::vector<Eigen::Vector3d> left(const std::vector<Eigen::Vector3d>& points,
                                    const std::string& file) const {
    std::vector<Eigen::Vector3d> kept = withoutRobot(points, robot_, state_, *margin_);
    say(file, points.size(), kept.size(), "points");
    return kept;
  }
  OccupancyMap left(const OccupancyMap& map, const Eigen::Isometry3d& pose,
                    const std::string& file) const {
    OccupancyMap kept = mapWithoutRobot(map, pose, robot_, state_, *margin_);
    say(file, smallestCubes(map), smallestCubes(kept), "smallest cubes");
    return kept;
  }
  /// What the robot hides begins in the robot.
  Balls leftOfShadow(const Balls& balls, const std::string& file) const {
    Balls kept = ballsWithoutRobot(balls, robot_, state_, *margin_);
    say(file, balls.centers.size(), kept.centers.size(), "balls of what the robot hides");
    return kept;
  }

 private:
  /// As many as the map's cubes are made of.
  static std::size_t smallestCubes(const OccupancyMap& map) {
    double count = 0.0;
    for (const OccupancyMap::Cube& cube : map.occupied)
      count += std::pow(std::round(cube.side / map.resolution), 3);
    return static_cast<std::size_t>(count);
  }
  void say(const std::string& file, std::size_t all, std::size_t kept, const char* what) const {
    warn_(file + ": warning: " + std::to_string(all - kept) + " of " + std::to_string(all) + " " +
          what + " are within " + shortNumber(*margin_) + " m of the robot and left out");
  }

  const Robot& robot_;
  std::optional<double> margin_;
  std::function<void(const std::string&)> warn_;
  std::vector<double> state_;
};

bool isOctomap(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".bt" || ending == ".ot";
}

void requireSomething(const std::string& file, bool something) {
  if (!something) throw InputError(file, 0, "--self-filter leaves nothing of it");
}

WorldBody mapBody(const Arguments& args, const std::string& file, const std::string& name,
                  const Eigen::Isometry3d& pose, const SelfFilter& filter,
                  const LoadOptions& options) {
  if (args.occluded)
    throw UsageError("--occluded is for points; an OctoMap says itself what is occupied: " + file);
  OccupancyMap map = loadOctomap(file, options);
  if (filter.isOn()) {
    map = filter.left(map, pose, file);
    requireSomething(file, !map.occupied.empty());
  }
  return occupiedBody(name, map, pose);
}

/// Of `all` those that are not in `kept`, which is in the same order.
std::vector<Eigen::Vector3d> leftOut(const std::vector<Eigen::Vector3d>& all,
                                     const std::vector<Eigen::Vector3d>& kept) {
  std::vector<Eigen::Vector3d> rest;
  auto next = kept.begin();
  for (const Eigen::Vector3d& point : all) {
    if (next != kept.end() && *next == point)
      ++next;
    else
      rest.push_back(point);
  }
  return rest;
}

void append(const Balls& more, Balls& balls) {
  balls.centers.insert(balls.centers.end(), more.centers.begin(), more.centers.end());
  balls.radii.insert(balls.radii.end(), more.radii.begin(), more.radii.end());
}

WorldBody cloudBody(const Arguments& args, const std::string& file, const std::string& name,
                    const Eigen::Isometry3d& pose, const SelfFilter& filter,
                    const LoadOptions& options) {
  if (!args.pointRadius)
    throw UsageError("--cloud " + file +
                     " needs --point-radius: how many metres the surface may be from a point");
  SensedPoints sensed = loadSensedPoints(file, options);
  std::vector<Eigen::Vector3d>& seen = sensed.points;
  for (Eigen::Vector3d& point : seen) point = pose * point;
  const Eigen::Vector3d sensor = pose * sensed.sensor;
  Balls balls{.centers = filter.isOn() ? filter.left(seen, file) : seen, .radii = {}};
  requireSomething(file, !balls.centers.empty());
  balls.radii.assign(balls.centers.size(), *args.pointRadius);
  if (args.occluded) {
    const auto hiddenBy = [&](const std::vector<Eigen::Vector3d>& points) {
      return occludedBalls(points, *args.pointRadius, sensor, *args.occluded);
    };
    const std::vector<Eigen::Vector3d> robot = leftOut(seen, balls.centers);
    append(hiddenBy(balls.centers), balls);
    if (!robot.empty()) append(filter.leftOfShadow(hiddenBy(robot), file), balls);
  }
  return {
      .name = name,
      .parts = {{PointCloud::build(balls.centers, balls.radii), Eigen::Isometry3d::Identity()}}};
}

}  // namespace

void addClouds(const Arguments& args, const Robot& robot,
               const std::optional<Eigen::VectorXd>& reference, const LoadOptions& options,
               World& world) {
  if (args.clouds.empty()) {
    if (args.pointRadius) throw UsageError("--point-radius needs --cloud");
    if (!args.cloudPose.empty()) throw UsageError("--cloud-pose needs --cloud");
    if (args.selfFilter) throw UsageError("--self-filter needs --cloud");
    if (args.occluded) throw UsageError("--occluded needs --cloud");
    return;
  }
  const Eigen::Isometry3d pose = args.cloudPose.empty() ? Eigen::Isometry3d::Identity()
                                                        : readPose(args.cloudPose, "--cloud-pose");
  if (args.pointRadius && std::ranges::all_of(args.clouds, isOctomap))
    throw UsageError(
        "--point-radius is for points; the cubes of an OctoMap are as large as it says: " +
        args.clouds.front());
  const SelfFilter filter(args, robot, reference, options);
  for (const std::string& file : args.clouds) {
    const std::string name = std::filesystem::path(file).stem().string();
    try {
      world.add(isOctomap(file) ? mapBody(args, file, name, pose, filter, options)
                                : cloudBody(args, file, name, pose, filter, options));
    } catch (const std::invalid_argument& error) {
      throw InputError(file, 0, error.what());
    }
  }
}

}  // namespace swept
