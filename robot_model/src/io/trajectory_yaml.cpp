// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "io/message_rates.hpp"
#include "io/trajectory_formats.hpp"
#include "io/trajectory_message.hpp"
#include "io/yaml.hpp"
#include "output/text_output.hpp"
#include "robot/joint_types.hpp"
#include "swept/robot_model/foreign_text.hpp"

namespace swept::detail {

namespace {

/// An orientation has two quaternions, and an angle many values. What transforms give becomes the
/// nearest to the point before, which is the way that a base turns; half a turn stays as it is.
class BaseTurns {
 public:
  BaseTurns(const Robot& robot, const std::vector<std::string>& names, std::size_t firstBase) {
    for (std::size_t i = firstBase; i < names.size(); ++i) {
      const Variable& variable = robot.variables()[*robot.findVariable(names[i])];
      const Joint& joint = robot.joints()[variable.joint];
      const std::optional<int> place = quaternionPlace(joint.type);
      if (variable.cyclic) angles_.push_back(i);
      if (place && names[i] == robot.variables()[joint.firstVariable + *place].name)
        quaternions_.push_back(i);
    }
  }

  void goOn(std::vector<double>& row) {
    if (!before_.empty()) {
      for (const std::size_t i : angles_)
        row[i] += 2.0 * std::numbers::pi *
                  std::nearbyint((before_[i] - row[i]) / (2.0 * std::numbers::pi));
      for (const std::size_t i : quaternions_)
        if (product(i, row) < 0.0)
          for (std::size_t k = i; k < i + 4; ++k) row[k] = -row[k];
    }
    before_ = row;
  }

 private:
  double product(std::size_t first, const std::vector<double>& row) const {
    double sum = 0.0;
    for (std::size_t k = first; k < first + 4; ++k) sum += before_[k] * row[k];
    return sum;
  }

  std::vector<std::size_t> angles_, quaternions_;  ///< their columns; of the first component
  std::vector<double> before_;
};

class TrajectoryReader {
 public:
  TrajectoryReader(const InputSource& source, const Robot& robot, TrajectoryRows& rows)
      : robot_(robot), messages_(source, robot, "readTrajectories"), rows_(rows) {}

  void read(const YamlPlace& root) {
    const MessageParts message = messages_.message(root);
    if (message.parts.empty()) failWithoutPoint(message.displayed.value_or(root));
    const std::size_t first = rows_.trajectories().size();
    for (const MessagePart& part : message.parts) {
      readPart(part);
      const std::vector<JointTrajectory>& all = rows_.trajectories();
      if (all.size() > first + 1)
        MessageReader::requireGoesOn(part, rows_.columns(),
                                     all[all.size() - 2].points.back().positions,
                                     all.back().points.front().positions);
    }
    if (message.start)
      messages_.requireStart(*message.start, rows_.columns(),
                             rows_.trajectories()[first].points.front().positions);
  }

 private:
  void readPart(const MessagePart& part) {
    if (part.size() == 0) failWithoutPoint(part.whole);
    const std::vector<std::string> names = messages_.columnNames(part);
    rows_.begin(names, MessageReader::failAtColumn(part),
                [&](const std::string& text) { part.whole.fail(text); });
    const std::size_t joints = part.points.empty() ? 0 : part.names.size();
    const MessageRates rates(robot_, part, rows_.columns(), names.size());
    BaseTurns turns(robot_, names, joints);
    for (std::size_t i = 0; i < part.size(); ++i) {
      std::vector<double> positions = messages_.positions(part, i);
      turns.goOn(positions);
      const TrajectoryPoint row{.time = timeOf(part, i),
                                .positions = std::move(positions),
                                .velocities = rates.at(i, "velocities"),
                                .accelerations = rates.at(i, "accelerations")};
      rows_.add(row, part.point(i).line(), part.failAtPoint(i));
    }
  }

  static double timeOf(const MessagePart& part, std::size_t i) {
    const double time = timeFromStart(part.point(i));
    if (part.points.empty() || part.poses.empty()) return time;
    if (const double other = timeFromStart(part.poses[i]); other != time)
      part.poses[i]
          .at("time_from_start")
          .fail("is " + exactNumber(other) + " s, and that of " + part.points[i].name() + " is " +
                exactNumber(time) + " s; both must be the same");
    return time;
  }

  const Robot& robot_;
  MessageReader messages_;
  TrajectoryRows& rows_;
};

}  // namespace

void readYamlTrajectories(const std::string& text, const InputSource& source, const Robot& robot,
                          TrajectoryRows& rows) {
  const std::vector<YamlPlace> documents = YamlPlace::parseAll(text, source);
  if (documents.empty()) source.fail(0, "it is empty; it must have a trajectory");
  try {
    TrajectoryReader reader(source, robot, rows);
    for (const YamlPlace& document : documents) reader.read(document);
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + foreignText(error.msg));
  }
}

}  // namespace swept::detail
