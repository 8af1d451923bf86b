// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/planning_request.hpp"

#include <algorithm>

#include "io/input_source.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

using detail::YamlPlace;

constexpr double kPositionTolerance = 1e-3;     // m, where the request has none
constexpr double kOrientationTolerance = 1e-2;  // rad, likewise

PlanningRequest::JointValues readStart(const YamlPlace& state) {
  const YamlPlace joints = state.at("joint_state");
  const std::vector<YamlPlace> names = joints.at("name").elements();
  const std::vector<YamlPlace> positions = joints.at("position").elements();
  if (names.empty()) joints.fail("it names no joint");
  if (names.size() != positions.size())
    joints.fail("it has " + std::to_string(names.size()) + " names and " +
                std::to_string(positions.size()) + " positions");
  PlanningRequest::JointValues values;
  for (std::size_t i = 0; i < names.size(); ++i)
    values.emplace_back(names[i].text(), positions[i].number());
  return values;
}

PlanningRequest::JointValues readJointGoal(const std::vector<YamlPlace>& constraints) {
  PlanningRequest::JointValues values;
  for (const YamlPlace& constraint : constraints)
    values.emplace_back(constraint.at("joint_name").text(), constraint.at("position").number());
  return values;
}

/// Middle and size of the region that a link's origin is to be in.
struct Region {
  Eigen::Vector3d middle;
  double tolerance;  ///< m
};

Region readRegion(const YamlPlace& constraint) {
  const YamlPlace region = constraint.at("constraint_region");
  const std::vector<YamlPlace> primitives = region.at("primitives").elements();
  const std::vector<YamlPlace> poses = region.at("primitive_poses").elements();
  if (primitives.size() != 1 || poses.size() != 1)
    region.fail("it has to have one primitive and its pose");
  if (const YamlPlace offset = constraint.at("target_point_offset");
      offset.present() && !offset.vector().isZero())
    offset.fail("is not 0: only a link's own origin can be placed");
  double least = kPositionTolerance;
  const std::vector<YamlPlace> sizes = primitives[0].at("dimensions").elements();
  if (!sizes.empty()) {
    // A box has full sides; a ball its radius.
    least = sizes.size() == 1 ? sizes[0].number() : 0.5 * sizes[0].number();
    for (std::size_t i = 1; i < sizes.size(); ++i) least = std::min(least, 0.5 * sizes[i].number());
  }
  if (!(least > 0.0)) primitives[0].fail("has a size that is not above 0");
  return {.middle = poses[0].pose("position", "orientation").translation(), .tolerance = least};
}

void warnOfFrame(const YamlPlace& constraint, const LoadOptions& options) {
  const YamlPlace header = constraint.at("header");
  if (!header.present() || !header.at("frame_id").present()) return;
  const std::string frame = header.at("frame_id").text();
  if (!frame.empty() && frame != "world" && frame != options.modelFrame)
    header.at("frame_id").warn("'" + frame + "' is taken for the robot's model frame");
}

PlanningRequest::PoseGoal readPoseGoal(const YamlPlace& goal, const YamlPlace& position,
                                       const YamlPlace& orientation, const LoadOptions& options) {
  warnOfFrame(position, options);
  warnOfFrame(orientation, options);
  const std::string link = position.at("link_name").text();
  if (link != orientation.at("link_name").text())
    goal.fail("its position is of link '" + link + "', its orientation of another");
  const Region region = readRegion(position);
  PlanningRequest::PoseGoal pose{.link = link,
                                 .model_from_link = Eigen::Isometry3d::Identity(),
                                 .positionTolerance = region.tolerance,
                                 .orientationTolerance = kOrientationTolerance};
  pose.model_from_link.translation() = region.middle;
  if (const YamlPlace given = orientation.at("orientation"); given.present())
    pose.model_from_link.linear() = given.rotation();
  double least = 4.0;  // more than any angle
  for (const char* axis : {"x", "y", "z"}) {
    const YamlPlace tolerance = orientation.at(std::string("absolute_") + axis + "_axis_tolerance");
    if (tolerance.present()) least = std::min(least, tolerance.number());
  }
  if (least < 4.0) pose.orientationTolerance = least;
  if (!(pose.orientationTolerance > 0.0)) orientation.fail("has a tolerance that is not above 0");
  return pose;
}

void readGoal(const YamlPlace& goal, const LoadOptions& options, PlanningRequest& request) {
  const std::vector<YamlPlace> joints = goal.at("joint_constraints").elements();
  const std::vector<YamlPlace> positions = goal.at("position_constraints").elements();
  const std::vector<YamlPlace> orientations = goal.at("orientation_constraints").elements();
  if (!joints.empty() && positions.empty() && orientations.empty())
    request.goals.push_back(readJointGoal(joints));
  else if (joints.empty() && positions.size() == 1 && orientations.size() == 1)
    request.poseGoals.push_back(readPoseGoal(goal, positions[0], orientations[0], options));
  else
    goal.fail(
        "a goal is either joint_constraints, or one of position_constraints and one of "
        "orientation_constraints");
}

}  // namespace

PlanningRequest PlanningRequest::load(const std::filesystem::path& yaml,
                                      const LoadOptions& options) {
  const detail::InputSource source(yaml.string(), options);
  const YamlPlace root = YamlPlace::parse(readTextFile(yaml), source);
  PlanningRequest request;
  if (const YamlPlace group = root.at("group_name"); group.present()) request.group = group.text();
  request.start = readStart(root.at("start_state"));
  const YamlPlace goals = root.at("goal_constraints");
  for (const YamlPlace& goal : goals.elements()) readGoal(goal, options, request);
  if (request.goals.empty() && request.poseGoals.empty()) goals.fail("there is no goal");
  return request;
}

}  // namespace swept
