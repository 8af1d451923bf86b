// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"

/// Several robots in one world. They become one Robot, whose names say whose they are
/// (`left/elbow`), so all that takes a robot takes a cell: one robot may be planned for while
/// another one stands, or both at once, and the pairs between them are checked as all others.
namespace swept {

/// A robot of a cell.
struct CellRobot {
  /// Of letters, digits, `_`, `-` and `.`; not `world`. In front of each of its names: `NAME/link`.
  std::string name;
  std::filesystem::path urdf;  ///< file
  /// Empty: it has none. In files: by default the one beside the URDF (Robot::srdfBeside()).
  std::filesystem::path srdf = {};
  /// A link, `NAME/link`, of a robot before this one that carries it; empty: the cell.
  std::string parent = {};
  Eigen::Isometry3d parent_from_robot = Eigen::Isometry3d::Identity();  ///< to its model frame
  int line = 0;  ///< of WorkCell::file, for messages; 0: none
};

/// A group of a cell: all joints of some groups. It has the named states that all of these have.
struct CellGroup {
  std::string name;  ///< unique among all groups
  /// `NAME/group` of a robot, or NAME for all its joints with values of their own.
  std::vector<std::string> groups;
  int line = 0;  ///< as CellRobot::line
};

/// Robots at places of their own. Its model frame is `world`.
struct WorkCell {
  std::string name = "cell";      ///< of the robot that it becomes
  std::vector<CellRobot> robots;  ///< one at least; each after its parent
  /// Without any there is one, `all`, of all robots.
  std::vector<CellGroup> groups = {};
  std::string file = {};  ///< for messages

  /// Reads a cell from YAML; robot_model/FORMATS.md has its keys. Paths are relative to the file.
  /// Throws InputError for anything that it does not know.
  static WorkCell read(const std::filesystem::path& file, const LoadOptions& options = {});
};

/// A line of a file, of which a line of a ComposedRobot was made.
struct LineOrigin {
  std::string file;  ///< as messages name it
  int line = 0;      ///< from 1; 0: the file as a whole
};

/// The URDF and the SRDF of the one robot that a cell becomes. Meshes have absolute paths. It has
/// no elements for simulators and controllers.
struct ComposedRobot {
  std::string name;  ///< what messages call both, where they do not name one of the cell's files
  ///@{
  /// The texts, and for each of their lines where it comes from.
  std::string urdf, srdf;
  std::vector<LineOrigin> urdfLines, srdfLines;
  ///@}
};

/// Composes the robots of a cell. A virtual joint of an SRDF becomes a joint of the URDF, between
/// the robot's place, a link called NAME, and its root: one robot may drive while others stand.
/// Throws InputError for files and elements as Robot::load does, an empty cell, a name that is
/// taken or not allowed, a parent or a group that is unknown, and a pose that is not rigid.
ComposedRobot compose(const WorkCell& cell, const LoadOptions& options = {});

/// The robot. Messages name the cell's files and their lines. Throws as Robot::parse.
std::shared_ptr<const Robot> loadComposed(const ComposedRobot& composed,
                                          const LoadOptions& options = {});
/// compose() and loadComposed().
std::shared_ptr<const Robot> loadWorkCell(const WorkCell& cell, const LoadOptions& options = {});

}  // namespace swept
