// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "swept/robot_model/usage_error.hpp"
#include "trajectory/message_columns.hpp"
#include "trajectory/trajectory_text.hpp"

namespace swept::detail {

namespace {

/// A number that YAML 1.1, too, takes for one: PyYAML reads `1e-07` as text, and `1` as an integer.
std::string yamlNumber(double value) {
  std::string text = exactNumber(value);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string numberList(std::span<const double> values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : ", ").append(yamlNumber(value));
  return "[" + text + "]";
}

/// `{x: 0.0, y: 0.0}`
std::string yamlMapping(std::span<const char* const> keys, const double* values) {
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i)
    text.append(text.empty() ? "" : ", ")
        .append(std::string(keys[i]) + ": " + yamlNumber(values[i]));
  return "{" + text + "}";
}

/// A JSON string is a YAML string, too, whatever characters the name has.
std::string nameList(std::span<const std::string> names) {
  std::string text;
  for (const std::string& name : names)
    text.append(text.empty() ? "" : ", ").append(lineOf(Json(name)));
  return "[" + text + "]";
}

/// A time as messages have it.
struct MessageTime {
  std::int64_t seconds = 0;
  std::int64_t nanoseconds = 0;
  bool operator==(const MessageTime&) const = default;
};

MessageTime messageTime(double time) {
  const double whole = std::floor(time);
  // Taking the whole seconds off is exact, so that this is the nearest nanosecond.
  MessageTime result{static_cast<std::int64_t>(whole), std::llround((time - whole) * 1e9)};
  if (result.nanoseconds == 1'000'000'000) result = {result.seconds + 1, 0};
  return result;
}

std::vector<MessageTime> messageTimes(const JointTrajectory& trajectory, const std::string& where) {
  std::vector<MessageTime> times;
  for (const TrajectoryPoint& point : trajectory.points) {
    if (!(point.time < static_cast<double>(INT32_MAX)))
      throw UsageError(where + ": a point is at " + exactNumber(point.time) +
                       " s, and a message holds less than " + std::to_string(INT32_MAX) +
                       " s; use .json or .csv");
    times.push_back(messageTime(point.time));
    if (times.size() > 1 && times[times.size() - 2] == times.back())
      throw UsageError(where + ": the points at " +
                       exactNumber(trajectory.points[times.size() - 2].time) + " and " +
                       exactNumber(point.time) +
                       " s are at the same nanosecond, which is the least that a message tells "
                       "apart; use .json or .csv");
  }
  return times;
}

/// Lines of a message, each below `indent_`.
class MessageText {
 public:
  explicit MessageText(std::vector<MessageTime> times) : times_(std::move(times)) {}
  std::string text;

  void line(const std::string& content) { text.append(indent_).append(content).append("\n"); }
  /// What `lines` adds is that much further in.
  template <typename Lines>
  void inside(const std::string& indent, const Lines& lines) {
    indent_ += indent;
    lines();
    indent_.resize(indent_.size() - indent.size());
  }

  void header(const std::string& frame) {
    line("header:");
    line("  stamp:");
    line("    sec: 0");
    line("    nanosec: 0");
    line("  frame_id: " + lineOf(Json(frame)));
  }
  void timeFromStart(std::size_t point) {
    line("  time_from_start:");
    line("    sec: " + std::to_string(times_[point].seconds));
    line("    nanosec: " + std::to_string(times_[point].nanoseconds));
  }

  /// trajectory_msgs/JointTrajectory of some of the variables.
  void joints(const JointTrajectory& trajectory, const JointColumns& columns) {
    header("");
    line("joint_names: " + nameList(columns.of(trajectory.variables)));
    if (columns.places.empty()) return line("points: []");
    line("points:");
    for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
      const TrajectoryPoint& point = trajectory.points[i];
      line("- positions: " + numberList(columns.of(point.positions)));
      line("  velocities: " + numberList(columns.of(point.velocities)));
      line("  accelerations: " + numberList(columns.of(point.accelerations)));
      line("  effort: []");
      timeFromStart(i);
    }
  }

  /// trajectory_msgs/MultiDOFJointTrajectory.
  void bases(const JointTrajectory& trajectory, const std::vector<BaseColumns>& bases,
             const std::string& frame) {
    header(bases.empty() ? "" : frame);
    line("joint_names: " + nameList(namesOf(bases)));
    if (bases.empty()) return line("points: []");
    line("points:");
    for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
      const TrajectoryPoint& point = trajectory.points[i];
      line("- transforms:");
      inside("  ", [&] { transforms(bases, point.positions); });
      twists("velocities", bases, point.velocities);
      twists("accelerations", bases, point.accelerations);
      timeFromStart(i);
    }
  }

  void transforms(const std::vector<BaseColumns>& bases, const std::vector<double>& positions) {
    for (const BaseColumns& base : bases) {
      const std::array<double, 7> pose = base.pose(positions);
      line("- translation: " + yamlMapping(kVector, pose.data()));
      line("  rotation: " + yamlMapping(kQuaternion, pose.data() + 3));
    }
  }

 private:
  static constexpr std::array<const char*, 3> kVector{"x", "y", "z"};
  static constexpr std::array<const char*, 4> kQuaternion{"x", "y", "z", "w"};

  void twists(const std::string& key, const std::vector<BaseColumns>& bases,
              const std::vector<double>& rates) {
    if (rates.empty()) return line("  " + key + ": []");
    line("  " + key + ":");
    for (const BaseColumns& base : bases) {
      const std::array<double, 6> twist = base.twist(rates);
      line("  - linear: " + yamlMapping(kVector, twist.data()));
      line("    angular: " + yamlMapping(kVector, twist.data() + 3));
    }
  }

  std::vector<MessageTime> times_;
  std::string indent_;
};

/// moveit_msgs/RobotTrajectory.
void addRobotTrajectory(MessageText& out, const JointTrajectory& trajectory,
                        const MessageColumns& columns, const std::string& frame) {
  out.line("joint_trajectory:");
  out.inside("  ", [&] { out.joints(trajectory, columns.joints); });
  out.line("multi_dof_joint_trajectory:");
  out.inside("  ", [&] { out.bases(trajectory, columns.bases, frame); });
}

/// moveit_msgs/RobotState of the first point. It is a difference, since it does not say where the
/// other joints are.
void addStart(MessageText& out, const JointTrajectory& trajectory, const MessageColumns& columns,
              const std::string& frame) {
  const std::vector<double>& positions = trajectory.points.front().positions;
  out.line("joint_state:");
  out.line("  name: " + nameList(columns.joints.of(trajectory.variables)));
  out.line("  position: " + numberList(columns.joints.of(positions)));
  out.line("multi_dof_joint_state:");
  out.inside("  ", [&] {
    out.header(columns.bases.empty() ? "" : frame);
    out.line("joint_names: " + nameList(namesOf(columns.bases)));
    if (columns.bases.empty()) return out.line("transforms: []");
    out.line("transforms:");
    out.transforms(columns.bases, positions);
  });
  out.line("is_diff: true");
}

}  // namespace

std::string yamlTrajectory(const JointTrajectory& trajectory, const std::string& where) {
  MessageText out(messageTimes(trajectory, where));
  out.joints(trajectory, allJoints(trajectory.variables.size()));
  return out.text + "---\n";
}

std::string yamlTrajectory(const JointTrajectory& trajectory, const Robot& robot,
                           TrajectoryMessage message, const std::string& where) {
  const MessageColumns columns = messageColumns(trajectory, robot);
  if (message == TrajectoryMessage::Joint) return yamlTrajectory(trajectory, where);
  requireMessageHolds(trajectory, columns, where);
  requireUtf8({robot.name(), robot.modelFrame()}, where);
  const std::string& frame = robot.modelFrame();
  MessageText out(messageTimes(trajectory, where));
  if (message == TrajectoryMessage::Robot) {
    addRobotTrajectory(out, trajectory, columns, frame);
    return out.text + "---\n";
  }
  out.line("model_id: " + lineOf(Json(robot.name())));
  out.line("trajectory:");
  const std::size_t item = out.text.size();
  out.inside("  ", [&] { addRobotTrajectory(out, trajectory, columns, frame); });
  out.text[item] = '-';
  out.line("trajectory_start:");
  out.inside("  ", [&] { addStart(out, trajectory, columns, frame); });
  return out.text + "---\n";
}

}  // namespace swept::detail
