// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/planning_request.hpp"

#include <algorithm>
#include <set>

#include "io/attached_objects.hpp"
#include "io/input_source.hpp"
#include "io/request_constraints.hpp"
#include "io/robot_state_yaml.hpp"
#include "io/scene_frames.hpp"
#include "io/yaml.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

using detail::YamlPlace;

constexpr double kPositionTolerance = 1e-3;     // m, where the request has none
constexpr double kOrientationTolerance = 1e-2;  // rad, likewise

/// Checks a joint's name, which must not be among the `known`, and adds it to them.
std::string newName(const YamlPlace& place, std::set<std::string>& known) {
  std::string name = place.text();
  if (!known.insert(name).second) place.fail("is '" + name + "' a second time");
  return name;
}

/// What the file's names are looked up in.
struct Context {
  const detail::InputSource& source;
  const Robot* robot;                 ///< null: unknown
  const detail::SceneFrames& frames;  ///< of goals, and of bases
};

/// A frame other than the link's would depend on joints that the request does not mention.
void requireFrameOfLink(const YamlPlace& attached) {
  const YamlPlace object = attached.at("object");
  if (!object.present()) object.fail("is missing");
  const std::string link = attached.at("link_name").text();
  if (detail::frameName(object.at("header")) != link)
    object.at("header").fail("has to name the frame_id '" + link + "', the link's, in a request");
}

void readAttached(const YamlPlace& list, const Context& context, PlanningRequest& request) {
  const std::vector<YamlPlace> attached = list.elements();
  if (attached.empty()) return;
  if (context.robot == nullptr)
    attached[0].fail("is read with a robot alone; PlanningRequest::load takes one");
  for (const YamlPlace& entry : attached) requireFrameOfLink(entry);
  detail::SceneFrames frames(context.source, "");
  frames.addLinks(*context.robot, context.robot->defaultState());
  detail::SceneObjects objects(context.source);
  detail::AttachedObjects reader(*context.robot, frames, objects);
  reader.read(list);
  World nothing;
  reader.takeFrom(nothing);
  objects.flushWarnings();
  request.attached = reader.bodies();
  for (const auto& [a, b] : reader.touchingBodies())
    request.rules.allow(a, b, "touch link of " + a);
}

void readStart(const YamlPlace& state, const Context& context, PlanningRequest& request) {
  detail::allowRobotState(state);
  if (context.robot != nullptr) detail::checkRobotState(state, *context.robot);
  const YamlPlace bases = state.at("multi_dof_joint_state");
  for (const detail::BasePose& base : detail::readBasePoses(bases))
    request.bases.push_back({base.joint, base.parent_from_child});
  detail::requireBasesInModelFrame(bases, context.frames);
  readAttached(state.at("attached_collision_objects"), context, request);
  const YamlPlace joints = state.at("joint_state");
  if (!joints.present() && !request.bases.empty()) return;
  const std::vector<YamlPlace> names = joints.at("name").elements();
  const std::vector<YamlPlace> positions = joints.at("position").elements();
  if (names.empty() && request.bases.empty()) joints.fail("it names no joint");
  if (names.size() != positions.size())
    joints.fail("it has " + std::to_string(names.size()) + " names and " +
                std::to_string(positions.size()) + " positions");
  std::set<std::string> known;
  for (std::size_t i = 0; i < names.size(); ++i)
    request.start.emplace_back(newName(names[i], known), positions[i].number());
}

PlanningRequest::JointValues readJointGoal(const std::vector<YamlPlace>& constraints) {
  PlanningRequest::JointValues values;
  std::set<std::string> known;
  for (const YamlPlace& constraint : constraints) {
    constraint.allowOnly(
        {"joint_name", "position", "tolerance_above", "tolerance_below", "weight"});
    values.emplace_back(newName(constraint.at("joint_name"), known),
                        constraint.at("position").number());
  }
  return values;
}

/// The centre and size of the region that must contain a link's origin.
struct Region {
  Eigen::Vector3d middle;
  double tolerance;  ///< m
};

/// By name, or by the codes of shape_msgs/SolidPrimitive. A ball of half the least size is in each;
/// it would not be in a cone.
void requireRegionType(const YamlPlace& type) {
  if (!type.present()) return;
  for (const char* known :
       {"box", "BOX", "1", "sphere", "SPHERE", "2", "cylinder", "CYLINDER", "3"})
    if (type.text() == known) return;
  type.fail("is '" + type.text() + "'; a region is a box (1), a sphere (2) or a cylinder (3)");
}

Region readRegion(const YamlPlace& constraint) {
  const YamlPlace region = constraint.at("constraint_region");
  region.allowOnly({"primitives", "primitive_poses", "meshes", "mesh_poses"});
  if (const auto meshes = region.at("meshes").elements(); !meshes.empty())
    meshes[0].fail("is not supported; a region is a primitive");
  const std::vector<YamlPlace> primitives = region.at("primitives").elements();
  const std::vector<YamlPlace> poses = region.at("primitive_poses").elements();
  if (primitives.size() != 1 || poses.size() != 1)
    region.fail("it has to have one primitive and its pose");
  if (const YamlPlace offset = constraint.at("target_point_offset");
      offset.present() && !offset.vector().isZero())
    offset.fail("is not 0: only a link's own origin can be placed");
  primitives[0].allowOnly({"type", "dimensions", "polygon"});
  requireRegionType(primitives[0].at("type"));
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

/// The angle that satisfies tolerances about axes, which are Euler angles (0) or a rotation vector
/// (1). A rotation by no more than the least of them satisfies either.
void requireParameterization(const YamlPlace& place) {
  if (!place.present() || place.integer() == 0 || place.integer() == 1) return;
  place.fail("is " + place.text() + "; allowed are 0 (Euler angles) and 1 (a rotation vector)");
}

PlanningRequest::PoseGoal readPoseGoal(const YamlPlace& position, const YamlPlace& orientation,
                                       const Context& context) {
  position.allowOnly({"header", "link_name", "target_point_offset", "constraint_region", "weight"});
  orientation.allowOnly({"header", "orientation", "link_name", "absolute_x_axis_tolerance",
                         "absolute_y_axis_tolerance", "absolute_z_axis_tolerance",
                         "parameterization", "weight"});
  requireParameterization(orientation.at("parameterization"));
  const std::string link = position.at("link_name").text();
  if (context.robot != nullptr && !context.robot->findLink(link))
    position.at("link_name")
        .fail("is '" + link + "', which is no link of robot '" + context.robot->name() + "'");
  if (const YamlPlace other = orientation.at("link_name"); other.text() != link)
    other.fail("is '" + other.text() + "'; the goal's position is of link '" + link + "'");
  const Region region = readRegion(position);
  PlanningRequest::PoseGoal pose{.link = link,
                                 .model_from_link = Eigen::Isometry3d::Identity(),
                                 .positionTolerance = region.tolerance,
                                 .orientationTolerance = kOrientationTolerance};
  pose.model_from_link.translation() =
      context.frames.model_from(position.at("header")) * region.middle;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (const YamlPlace given = orientation.at("orientation"); given.present())
    turn = given.rotation();
  pose.model_from_link.linear() =
      context.frames.model_from(orientation.at("header")).linear() * turn;
  double least = 4.0;  // more than any angle
  for (const char* axis : {"x", "y", "z"}) {
    const YamlPlace tolerance = orientation.at(std::string("absolute_") + axis + "_axis_tolerance");
    if (tolerance.present()) least = std::min(least, tolerance.number());
  }
  if (least < 4.0) pose.orientationTolerance = least;
  if (!(pose.orientationTolerance > 0.0)) orientation.fail("has a tolerance that is not above 0");
  return pose;
}

void readGoal(const YamlPlace& goal, const Context& context, PlanningRequest& request) {
  detail::allowConstraints(goal);
  if (const auto views = goal.at("visibility_constraints").elements(); !views.empty())
    views[0].fail("is not supported");
  const std::vector<YamlPlace> joints = goal.at("joint_constraints").elements();
  const std::vector<YamlPlace> positions = goal.at("position_constraints").elements();
  const std::vector<YamlPlace> orientations = goal.at("orientation_constraints").elements();
  if (!joints.empty() && positions.empty() && orientations.empty())
    request.goals.push_back(readJointGoal(joints));
  else if (joints.empty() && positions.size() == 1 && orientations.size() == 1)
    request.poseGoals.push_back(readPoseGoal(positions[0], orientations[0], context));
  else
    goal.fail(
        "a goal is either joint_constraints, or one of position_constraints and one of "
        "orientation_constraints");
}

/// What the whole path has to keep. The attached objects are known.
void readAlongPath(const YamlPlace& root, const Context& context, PlanningRequest& request) {
  if (const YamlPlace path = root.at("path_constraints"); path.present()) {
    detail::allowConstraints(path);
    if (context.robot != nullptr)
      request.pathConstraints =
          detail::readConstraints(path, *context.robot, context.frames, request.attached);
    else if (detail::constrainsAnything(path))
      path.fail("is read with a robot alone; PlanningRequest::load takes one");
  }
  if (const YamlPlace trajectory = root.at("trajectory_constraints"); trajectory.present()) {
    trajectory.allowOnly({"constraints"});
    if (const auto given = trajectory.at("constraints").elements(); !given.empty())
      given[0].fail("cannot be kept: a path is constrained as a whole, by path_constraints");
  }
}

/// Two corners at the origin mean that no box is given.
void readWorkspace(const YamlPlace& workspace, const Context& context, PlanningRequest& request) {
  if (!workspace.present()) return;
  workspace.allowOnly({"header", "min_corner", "max_corner"});
  Eigen::AlignedBox3d box(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
  if (const YamlPlace least = workspace.at("min_corner"); least.present())
    box.min() = least.vector();
  if (const YamlPlace most = workspace.at("max_corner"); most.present()) box.max() = most.vector();
  if (box.min().isZero(0.0) && box.max().isZero(0.0)) return;
  if ((box.max() - box.min()).minCoeff() < 0.0)
    workspace.fail("has a min_corner beyond its max_corner");
  if (!context.frames.isModelFrame(workspace.at("header")))
    workspace.at("header")
        .at("frame_id")
        .fail("is '" + detail::frameName(workspace.at("header")) +
              "'; it has to be the robot's model frame");
  request.workspace = box;
}

void allowRequest(const YamlPlace& root) {
  root.allowOnly({"workspace_parameters", "start_state", "goal_constraints", "path_constraints",
                  "trajectory_constraints", "reference_trajectories", "pipeline_id", "planner_id",
                  "group_name", "num_planning_attempts", "allowed_planning_time",
                  "max_velocity_scaling_factor", "max_acceleration_scaling_factor",
                  "cartesian_speed_end_effector_link", "cartesian_speed_limited_link",
                  "max_cartesian_speed"});
}

PlanningRequest readRequest(const YamlPlace& root, const Context& context) {
  PlanningRequest request;
  if (!root.isMap()) root.fail("a planning request must be a mapping");
  allowRequest(root);
  if (const YamlPlace group = root.at("group_name"); group.present()) request.group = group.text();
  readWorkspace(root.at("workspace_parameters"), context, request);
  readStart(root.at("start_state"), context, request);
  readAlongPath(root, context, request);
  const YamlPlace goals = root.at("goal_constraints");
  for (const YamlPlace& goal : goals.elements()) readGoal(goal, context, request);
  if (request.goals.empty() && request.poseGoals.empty()) goals.fail("there is no goal");
  return request;
}

PlanningRequest readFile(const std::filesystem::path& yaml, const Robot* robot,
                         const LoadOptions& options) {
  const detail::InputSource source(yaml.string(), options);
  detail::SceneFrames frames(source, "PlanningRequest::load with a robot");
  if (robot != nullptr) frames.addStillLinks(*robot);
  const YamlPlace root = YamlPlace::parse(readTextFile(yaml), source);
  try {
    return readRequest(root, {source, robot, frames});
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + foreignText(error.msg));
  }
}

}  // namespace

PlanningRequest PlanningRequest::load(const std::filesystem::path& yaml,
                                      const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return load(yaml, options); });
  }
  return readFile(yaml, nullptr, options);
}

PlanningRequest PlanningRequest::load(const std::filesystem::path& yaml, const Robot& robot,
                                      const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return load(yaml, robot, options); });
  }
  LoadOptions own = options;
  if (own.modelFrame.empty()) own.modelFrame = robot.modelFrame();
  return readFile(yaml, &robot, own);
}

}  // namespace swept
