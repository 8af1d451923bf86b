// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "io/path_formats.hpp"
#include "io/robot_state_yaml.hpp"
#include "io/scene_frames.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/planning_request.hpp"

namespace swept::detail {

namespace {

/// Values by the names of variables.
using Values = PlanningRequest::JointValues;

class Reader {
 public:
  Reader(const InputSource& source, const Robot& robot, PathRows& rows)
      : source_(source), robot_(robot), rows_(rows), frames_(source, "readPath") {
    frames_.addStillLinks(robot);
  }

  void read(const YamlPlace& root) {
    if (!root.isMap()) root.fail("a trajectory must be a mapping");
    if (root.at("trajectory").present() || root.at("trajectory_start").present())
      readDisplay(root);
    else if (root.at("points").present() || root.at("joint_names").present())
      readTrajectory(root, root, root.at("multi_dof_joint_trajectory"));
    else
      readRobotTrajectory(root);
    if (rows_.states().empty()) root.fail("there is no point; one is needed");
    if (curve_)
      source_.warnOfUnchecked(*curve_,
                              "points have velocities or accelerations: what is looked at is the "
                              "straight motion between the points, not the curve of a controller");
  }

 private:
  void readDisplay(const YamlPlace& root) {
    root.allowOnly({"model_id", "trajectory", "trajectory_start"});
    const std::vector<YamlPlace> parts = root.at("trajectory").elements();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::size_t begin = rows_.states().size();
      readRobotTrajectory(parts[i]);
      if (begin > 0 && rows_.states().size() > begin) requireGoesOn(parts[i], begin);
    }
    if (rows_.states().empty()) root.at("trajectory").fail("has no point; one is needed");
    if (const YamlPlace start = root.at("trajectory_start"); start.present()) requireStart(start);
  }

  /// No planner has planned the gap between the end of one trajectory and the start of the next.
  void requireGoesOn(const YamlPlace& part, std::size_t begin) const {
    if (!rows_.areAlike(begin - 1, begin))
      part.fail("begins elsewhere than the one before it ends; a path goes on where it is");
  }

  void requireStart(const YamlPlace& start) {
    allowRobotState(start);
    if (const auto held = start.at("attached_collision_objects").elements(); !held.empty())
      held[0].fail("is not taken from a path; attached objects are those of the scene");
    const YamlPlace joints = start.at("joint_state");
    std::vector<YamlPlace> given, positions;
    if (joints.present()) {
      given = joints.at("name").elements();
      positions = joints.at("position").elements();
      requireAsMany(joints, given.size(), "names", positions.size(), "positions");
    }
    std::vector<std::string> names;
    std::vector<double> values;
    for (const YamlPlace& name : given) names.push_back(name.text());
    for (const YamlPlace& position : positions) values.push_back(position.number());
    const YamlPlace bases = start.at("multi_dof_joint_state");
    requireBasesInModelFrame(bases, frames_);
    for (const auto& [name, value] : valuesOf(readBasePoses(bases), bases)) {
      names.push_back(name);
      values.push_back(value);
    }
    rows_.setSomeColumns(names, [&](std::size_t i, const std::string& message) {
      (i < given.size() ? given[i] : bases).fail(message);
    });
    rows_.requireLike(
        values, rows_.states().front(), "the first point has it",
        [&](const std::string& message) { start.called("trajectory_start:").fail(message); });
  }

  void readRobotTrajectory(const YamlPlace& robot) {
    if (!robot.isMap()) robot.fail("must be a mapping");
    robot.allowOnly({"joint_trajectory", "multi_dof_joint_trajectory"});
    readTrajectory(robot, robot.at("joint_trajectory"), robot.at("multi_dof_joint_trajectory"));
  }

  /// `whole`: what both are in, for messages.
  void readTrajectory(const YamlPlace& whole, const YamlPlace& joints, const YamlPlace& bases) {
    const std::vector<YamlPlace> names = namesOf(joints, {"header", "joint_names", "points"});
    const std::vector<YamlPlace> points = pointsOf(joints);
    const std::vector<YamlPlace> poses = posesOf(bases);
    if (!points.empty() && !poses.empty())
      requireAsMany(bases, poses.size(), "points", points.size(), "are those of joint_trajectory");
    for (std::size_t k = 0; k < std::max(points.size(), poses.size()); ++k) {
      const YamlPlace& point = points.empty() ? poses[k] : points[k];
      std::vector<double> values;
      if (!points.empty()) values = positionsOf(point, names.size());
      Values moved;
      if (!poses.empty()) moved = valuesOf(basesOf(poses[k], bases), poses[k]);
      if (k == 0) setColumns(whole, names, moved);
      for (const auto& [name, value] : moved) values.push_back(value);
      rows_.add(
          values, point.line(),
          [&](const std::string& message) { point.called(point.name() + ":").fail(message); },
          false);
    }
  }

  static std::vector<YamlPlace> namesOf(const YamlPlace& trajectory, YamlPlace::Keys keys) {
    if (!trajectory.present()) return {};
    if (!trajectory.isMap()) trajectory.fail("must be a mapping");
    trajectory.allowOnly(keys);
    return trajectory.at("joint_names").elements();
  }

  static std::vector<YamlPlace> pointsOf(const YamlPlace& trajectory) {
    if (!trajectory.present()) return {};
    return trajectory.at("points").elements();
  }

  void setColumns(const YamlPlace& whole, const std::vector<YamlPlace>& names,
                  const Values& moved) {
    std::vector<std::string> columns;
    for (const YamlPlace& name : names) columns.push_back(name.text());
    for (const auto& [name, value] : moved) columns.push_back(name);
    rows_.setColumns(
        columns,
        [&](std::size_t i, const std::string& message) {
          (i < names.size() ? names[i] : whole.at("multi_dof_joint_trajectory")).fail(message);
        },
        [&](const std::string& message) { whole.fail(message); });
  }

  std::vector<double> positionsOf(const YamlPlace& point, std::size_t count) {
    if (!point.isMap()) point.fail("must be a mapping");
    point.allowOnly({"positions", "velocities", "accelerations", "effort", "time_from_start"});
    const std::vector<YamlPlace> positions = point.at("positions").elements();
    requireAsMany(point, positions.size(), "positions", count, "joint_names");
    std::vector<double> values;
    for (const YamlPlace& position : positions) values.push_back(position.number());
    noteCurve(point);
    return values;
  }

  void noteCurve(const YamlPlace& point) {
    for (const char* key : {"velocities", "accelerations"})
      if (const YamlPlace given = point.at(key); !curve_ && !given.elements().empty())
        curve_ = given.line();
  }

  std::vector<YamlPlace> posesOf(const YamlPlace& bases) const {
    if (namesOf(bases, {"header", "joint_names", "points"}).empty()) return {};
    requireBasesInModelFrame(bases, frames_);
    return pointsOf(bases);
  }

  std::vector<BasePose> basesOf(const YamlPlace& point, const YamlPlace& bases) {
    if (!point.isMap()) point.fail("must be a mapping");
    point.allowOnly({"transforms", "velocities", "accelerations", "time_from_start"});
    const std::vector<YamlPlace> names = bases.at("joint_names").elements();
    const std::vector<YamlPlace> transforms = point.at("transforms").elements();
    requireAsMany(point, transforms.size(), "transforms", names.size(), "joint_names");
    std::vector<BasePose> poses;
    for (std::size_t i = 0; i < names.size(); ++i)
      poses.push_back({names[i].text(), transforms[i].pose("translation", "rotation")});
    noteCurve(point);
    return poses;
  }

  Values valuesOf(const std::vector<BasePose>& poses, const YamlPlace& place) const {
    PlanningRequest request;
    for (const BasePose& base : poses)
      request.bases.push_back({base.joint, base.parent_from_child});
    try {
      return request.startOf(robot_);
    } catch (const std::invalid_argument& error) {
      place.called(place.name() + ":").fail(error.what());
    }
  }

  static void requireAsMany(const YamlPlace& place, std::size_t count, const std::string& what,
                            std::size_t wanted, const std::string& of) {
    if (count != wanted)
      place.fail("has " + std::to_string(count) + " " + what + " and " + std::to_string(wanted) +
                 " " + of);
  }

  const InputSource& source_;
  const Robot& robot_;
  PathRows& rows_;
  SceneFrames frames_;
  std::optional<int> curve_;  ///< the first line that has one
};

}  // namespace

void readYamlPath(const std::string& text, const InputSource& source, const Robot& robot,
                  PathRows& rows) {
  const YamlPlace root = YamlPlace::parse(text, source);
  try {
    Reader(source, robot, rows).read(root);
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + foreignText(error.msg));
  }
}

}  // namespace swept::detail
