// SPDX-License-Identifier: BSD-3-Clause
#include "input/clouds.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include "command_line/exit_code.hpp"
#include "input/poses.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "output/text_output.hpp"
#include "swept/core/sensed_space.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/self_filter.hpp"
#include "swept/robot_model/sensed_world.hpp"

namespace swept {
namespace {

/// What --self-filter leaves of the points (m, world).
class SelfFilter {
 public:
  SelfFilter(const Arguments& args, const Robot& robot, const LoadOptions& options)
      : robot_(robot), margin_(args.selfFilter), warn_(options.warn) {
    if (!margin_) return;
    if (args.states.empty())
      throw UsageError("--self-filter needs a state: that in which the robot was seen");
    const Group& group = chooseGroup(robot, args.group);
    const std::vector<double> q = readState(robot, group, args.states.front(), "--self-filter");
    const Eigen::VectorXd others = robot.defaultState();
    state_.assign(others.begin(), others.end());
    for (std::size_t i = 0; i < q.size(); ++i)
      state_[static_cast<std::size_t>(group.variables[i])] = q[i];
  }

  bool isOn() const { return margin_.has_value(); }

  std::vector<Eigen::Vector3d> left(const std::vector<Eigen::Vector3d>& points,
                                    const std::string& file) const {
    std::vector<Eigen::Vector3d> kept = withoutRobot(points, robot_, state_, *margin_);
    warn_(file + ": warning: " + std::to_string(points.size() - kept.size()) + " of " +
          std::to_string(points.size()) + " points are within " + shortNumber(*margin_) +
          " m of the robot and left out");
    return kept;
  }

 private:
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
    std::vector<Eigen::Vector3d> middles;
    for (const OccupancyMap::Cube& cube : map.occupied) middles.push_back(pose * cube.center);
    const std::vector<Eigen::Vector3d> kept = filter.left(middles, file);
    // Both are in the same order.
    std::size_t next = 0;
    std::vector<OccupancyMap::Cube> cubes;
    for (std::size_t i = 0; i < middles.size() && next < kept.size(); ++i) {
      if (middles[i] != kept[next]) continue;
      cubes.push_back(map.occupied[i]);
      ++next;
    }
    map.occupied = std::move(cubes);
    requireSomething(file, !map.occupied.empty());
  }
  return occupiedBody(name, map, pose);
}

WorldBody cloudBody(const Arguments& args, const std::string& file, const std::string& name,
                    const Eigen::Isometry3d& pose, const SelfFilter& filter,
                    const LoadOptions& options) {
  if (!args.pointRadius)
    throw UsageError("--cloud " + file +
                     " needs --point-radius: how many metres the surface may be from a point");
  std::vector<Eigen::Vector3d> points = loadPoints(file, options);
  for (Eigen::Vector3d& point : points) point = pose * point;
  if (filter.isOn()) {
    points = filter.left(points, file);
    requireSomething(file, !points.empty());
  }
  std::vector<double> radii(points.size(), *args.pointRadius);
  if (args.occluded) {
    const Balls hidden =
        occludedBalls(points, *args.pointRadius, pose.translation(), *args.occluded);
    points.insert(points.end(), hidden.centers.begin(), hidden.centers.end());
    radii.insert(radii.end(), hidden.radii.begin(), hidden.radii.end());
  }
  return {.name = name,
          .parts = {{PointCloud::build(points, radii), Eigen::Isometry3d::Identity()}}};
}

/// Calls `visit` with each body of the world that has a cloud, and the cloud.
template <typename Visit>
void forEachCloud(const World& world, const Visit& visit) {
  for (const WorldBody& body : world.bodies()) {
    const auto boxes = std::ranges::count_if(body.parts, [](const WorldBody::Part& part) {
      return std::holds_alternative<Box>(part.shape);
    });
    for (const WorldBody::Part& part : body.parts) {
      if (const auto* cloud = std::get_if<PointCloud>(&part.shape)) visit(body, *cloud, boxes);
    }
  }
}

}  // namespace

void addClouds(const Arguments& args, const Robot& robot, const LoadOptions& options,
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
  const SelfFilter filter(args, robot, options);
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

std::string cloudsText(const World& world) {
  std::string text;
  forEachCloud(world, [&](const WorldBody& body, const PointCloud& cloud, auto boxes) {
    text += "body " + body.name + " is " + std::to_string(cloud.points().size()) +
            " balls of radius " + shortNumber(cloud.leastRadius());
    if (cloud.largestRadius() > cloud.leastRadius())
      text += " to " + shortNumber(cloud.largestRadius());
    text += " m";
    if (boxes > 0) text += " and " + std::to_string(boxes) + " boxes";
    text += "\n";
  });
  return text;
}

Json cloudsJson(const World& world) {
  Json clouds = Json::array();
  forEachCloud(world, [&](const WorldBody& body, const PointCloud& cloud, auto boxes) {
    clouds.push_back({{"body", body.name},
                      {"balls", cloud.points().size()},
                      {"least_radius", cloud.leastRadius()},
                      {"largest_radius", cloud.largestRadius()},
                      {"boxes", boxes}});
  });
  return clouds;
}

}  // namespace swept
