// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <optional>
#include <vector>

#include "io/path_formats.hpp"
#include "io/trajectory_message.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/foreign_text.hpp"

namespace swept::detail {

namespace {

class PathReader {
 public:
  PathReader(const InputSource& source, const Robot& robot, PathRows& rows)
      : source_(source), messages_(source, robot, "readPath"), rows_(rows) {}

  void read(const YamlPlace& root) {
    const MessageParts message = messages_.message(root);
    for (const MessagePart& part : message.parts) readPart(part);
    if (rows_.states().empty()) failWithoutPoint(message.displayed.value_or(root));
    if (message.start)
      messages_.requireStart(*message.start, rows_.columns(), rows_.states().front());
    if (curve_)
      source_.warnOfUnchecked(*curve_,
                              "points have velocities or accelerations: what is looked at is the "
                              "straight motion between the points, not the curve of a controller");
  }

 private:
  void readPart(const MessagePart& part) {
    const std::size_t begin = rows_.states().size();
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::vector<double> values = messages_.positions(part, i);
      if (!part.points.empty()) noteCurve(part.points[i]);
      if (!part.poses.empty()) noteCurve(part.poses[i]);
      if (i == 0)
        rows_.setColumns(messages_.columnNames(part), MessageReader::failAtColumn(part),
                         [&](const std::string& text) { part.whole.fail(text); });
      rows_.add(values, part.point(i).line(), part.failAtPoint(i), false);
    }
    if (begin > 0 && rows_.states().size() > begin)
      MessageReader::requireGoesOn(part, rows_.columns(), rows_.states()[begin - 1],
                                   rows_.states()[begin]);
  }

  void noteCurve(const YamlPlace& point) {
    for (const char* key : {"velocities", "accelerations"})
      if (const YamlPlace given = point.at(key); !curve_ && !given.elements().empty())
        curve_ = given.line();
  }

  const InputSource& source_;
  MessageReader messages_;
  PathRows& rows_;
  std::optional<int> curve_;  ///< the first line that has one
};

}  // namespace

void readYamlPath(const std::string& text, const InputSource& source, const Robot& robot,
                  PathRows& rows) {
  const YamlPlace root = YamlPlace::parse(text, source);
  try {
    PathReader(source, robot, rows).read(root);
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + foreignText(error.msg));
  }
}

}  // namespace swept::detail
