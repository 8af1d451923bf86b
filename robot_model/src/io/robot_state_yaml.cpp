// SPDX-License-Identifier: BSD-3-Clause
#include "io/robot_state_yaml.hpp"

#include <cstddef>
#include <set>
#include <stdexcept>

#include "io/judged_state.hpp"
#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/planning_request.hpp"

namespace swept::detail {

namespace {

class StateReader {
 public:
  StateReader(const Robot& robot, bool warns)
      : robot_(robot), warns_(warns), state_(robot.defaultState()) {}

  std::optional<Eigen::VectorXd> read(const YamlPlace& state) {
    readJoints(state.at("joint_state"));
    readBases(state.at("multi_dof_joint_state"));
    for (const Follower& follower : followers_) requireFollows(follower);
    return named_ ? std::optional(state_) : std::nullopt;
  }

 private:
  struct Follower {
    const Joint& joint;
    YamlPlace value;
  };

  void readJoints(const YamlPlace& joints) {
    if (!joints.present()) return;
    const std::vector<YamlPlace> names = joints.at("name").elements();
    const std::vector<YamlPlace> positions = joints.at("position").elements();
    if (names.size() != positions.size())
      joints.fail("has " + std::to_string(names.size()) + " names and " +
                  std::to_string(positions.size()) + " positions");
    std::set<std::string> known;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!known.insert(names[i].text()).second)
        names[i].fail("is '" + names[i].text() + "' a second time");
      readJoint(names[i], positions[i]);
    }
    named_ = named_ || !names.empty();
  }

  void readJoint(const YamlPlace& name, const YamlPlace& position) {
    if (const auto variable = robot_.findVariable(name.text())) {
      set(*variable, position.number(), position);
      return;
    }
    const auto index = robot_.findJoint(name.text());
    if (!index)
      name.fail("is '" + name.text() + "', which is no joint of robot '" + robot_.name() + "'");
    const Joint& joint = robot_.joints()[static_cast<std::size_t>(*index)];
    if (joint.firstVariable >= 0)
      name.fail("is '" + name.text() +
                "', a joint of several values; multi_dof_joint_state has those");
    followers_.push_back({joint, position});
  }

  void set(int index, double value, const YamlPlace& place) {
    const Variable& variable = robot_.variables()[static_cast<std::size_t>(index)];
    state_[index] = value;
    const auto limit = limitNear(variable, value);
    if (!limit || isOrientation(robot_, variable)) return;
    if (warns_)
      place.warn("is beyond: " +
                 limitRemark({variable.name, value, *limit, unitOf(robot_, variable)}));
    state_[index] = *limit;
  }

  void readBases(const YamlPlace& bases) {
    PlanningRequest request;
    for (const BasePose& base : readBasePoses(bases))
      request.bases.push_back({base.joint, base.parent_from_child});
    try {
      for (const auto& [name, value] : request.startOf(robot_)) {
        state_[*robot_.findVariable(name)] = value;
        named_ = true;
      }
    } catch (const std::invalid_argument& error) {
      bases.called("the state:").fail(error.what());
    }
  }

  /// A mimic joint goes where its master takes it, and a fixed joint stays at 0.
  void requireFollows(const Follower& follower) const {
    const std::string why = whyElsewhere(robot_, follower.joint, follower.value.number(),
                                         [this](int variable) { return state_[variable]; });
    if (why.empty()) return;
    follower.value.fail("of '" + follower.joint.name + "' is " + follower.value.text() +
                        ", but the joint " + why);
  }

  const Robot& robot_;
  bool warns_;
  Eigen::VectorXd state_;
  bool named_ = false;
  std::vector<Follower> followers_;
};

}  // namespace

void allowRobotState(const YamlPlace& state) {
  state.allowOnly(
      {"joint_state", "multi_dof_joint_state", "attached_collision_objects", "is_diff"});
  if (!state.isMap()) state.fail("must be a mapping");
  state.at("joint_state").allowOnly({"header", "name", "position", "velocity", "effort"});
}

std::vector<BasePose> readBasePoses(const YamlPlace& joints) {
  if (!joints.present()) return {};
  joints.allowOnly({"header", "joint_names", "transforms", "twist", "wrench"});
  const std::vector<YamlPlace> names = joints.at("joint_names").elements();
  const std::vector<YamlPlace> transforms = joints.at("transforms").elements();
  if (names.size() != transforms.size()) {
    joints.fail("has " + std::to_string(names.size()) + " names and " +
                std::to_string(transforms.size()) + " transforms");
  }
  std::vector<BasePose> poses;
  std::set<std::string> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!known.insert(names[i].text()).second)
      names[i].fail("is '" + names[i].text() + "' a second time");
    poses.push_back({names[i].text(), transforms[i].pose("translation", "rotation")});
  }
  return poses;
}

void requireBasesInModelFrame(const YamlPlace& joints, const SceneFrames& frames) {
  if (!joints.present() || joints.at("joint_names").elements().empty()) return;
  const YamlPlace header = joints.at("header");
  if (frames.isModelFrame(header)) return;
  header.at("frame_id")
      .fail("is '" + frameName(header) + "'; poses of bases have to be in the robot's model frame");
}

std::optional<Eigen::VectorXd> readRobotState(const YamlPlace& state, const Robot& robot) {
  if (!state.present()) return std::nullopt;
  allowRobotState(state);
  return StateReader(robot, true).read(state);
}

void checkRobotState(const YamlPlace& state, const Robot& robot) {
  (void)StateReader(robot, false).read(state);
}

}  // namespace swept::detail
