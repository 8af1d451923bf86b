// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/work_cell.hpp"

#include <utility>

#include "io/input_source.hpp"
#include "io/yaml.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {

namespace {

using detail::YamlPlace;

/// Reads the YAML of a cell; compose() judges what it says.
class CellReader {
 public:
  explicit CellReader(const detail::InputSource& source) : source_(source) {}

  void read(const YamlPlace& root, WorkCell& cell) const {
    if (!root.isMap()) root.fail("a work cell must be a mapping with 'robots'");
    root.allowOnly({"name", "robots", "groups"});
    if (root.at("name").present()) cell.name = root.at("name").text();
    const YamlPlace robots = root.at("robots");
    if (!robots.present()) robots.fail("is missing: a list of robots, each with 'name' and 'urdf'");
    for (const YamlPlace& robot : robots.elements()) cell.robots.push_back(readRobot(robot));
    for (const auto& [name, groups] : root.at("groups").entries()) {
      CellGroup group{.name = name.text(), .groups = {}, .line = name.line()};
      for (const YamlPlace& member : groups.elements()) group.groups.push_back(member.text());
      cell.groups.push_back(std::move(group));
    }
  }

 private:
  CellRobot readRobot(const YamlPlace& place) const {
    place.allowOnly({"name", "urdf", "srdf", "parent", "pose"});
    CellRobot robot;
    robot.line = place.line();
    robot.name = required(place, "name").text();
    const YamlPlace own = place.called("robot '" + robot.name + "'");
    robot.urdf = pathOf(required(own, "urdf"));
    robot.srdf = srdfOf(own.at("srdf"), robot.urdf);
    if (robot.srdf.empty() && !own.at("srdf").present())
      source_.warn(robot.line, "robot '" + robot.name +
                                   "' has no SRDF beside its URDF: all of its "
                                   "links are checked against each other, but those that a joint "
                                   "connects; 'srdf: none' says so without this");
    if (own.at("parent").present()) robot.parent = own.at("parent").text();
    robot.parent_from_robot = own.at("pose").pose("position", "orientation");
    return robot;
  }

  static YamlPlace required(const YamlPlace& place, const char* key) {
    YamlPlace value = place.at(key);
    if (!value.present()) value.fail("is missing");
    return value;
  }

  /// As a user may call it: relative where the cell's is.
  std::filesystem::path pathOf(const YamlPlace& place) const {
    const std::filesystem::path folder = std::filesystem::path(source_.name()).parent_path();
    return (folder / place.text()).lexically_normal();
  }

  std::filesystem::path srdfOf(const YamlPlace& place, const std::filesystem::path& urdf) const {
    if (!place.present()) return Robot::srdfBeside(urdf);
    return place.text() == "none" ? std::filesystem::path() : pathOf(place);
  }

  const detail::InputSource& source_;
};

}  // namespace

WorkCell WorkCell::read(const std::filesystem::path& file, const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return read(file, options); });
  }
  const detail::InputSource source(file.string(), options);
  WorkCell cell;
  cell.name = file.stem().string();
  cell.file = file.string();
  CellReader(source).read(YamlPlace::parse(readTextFile(file), source), cell);
  return cell;
}

}  // namespace swept
