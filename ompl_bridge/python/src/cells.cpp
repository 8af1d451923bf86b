// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/work_cell.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "handles.hpp"
#include "loading.hpp"
#include "robots.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Groups = std::map<std::string, std::vector<std::string>>;

CellRobot makeRobot(const std::string& name, const std::filesystem::path& urdf,
                    const py::object& srdf, const std::string& parent, const py::object& pose) {
  const std::filesystem::path file = std::filesystem::absolute(urdf);
  return {
      .name = name,
      .urdf = file,
      .srdf = srdf.is_none() ? Robot::srdfBeside(file) : std::filesystem::absolute(pathOf(srdf)),
      .parent = parent,
      .parent_from_robot = readPose(pose, "pose")};
}

WorkCell makeCell(std::vector<CellRobot> robots, const Groups& groups, const std::string& name) {
  WorkCell cell{.name = name, .robots = std::move(robots)};
  for (const auto& [group, parts] : groups) cell.groups.push_back({group, parts});
  return cell;
}

WorkCell loadCell(const std::filesystem::path& file) {
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor({});
  WorkCell cell;
  {
    const py::gil_scoped_release others;
    cell = WorkCell::read(file, options);
  }
  for (CellRobot& robot : cell.robots) {
    robot.urdf = std::filesystem::absolute(robot.urdf);
    if (!robot.srdf.empty()) robot.srdf = std::filesystem::absolute(robot.srdf);
  }
  remarks.warn();
  return cell;
}

RobotHandle robotOf(const WorkCell& self, const py::object& packages, const py::object& cache,
                    bool childProcess) {
  Source source = sourceOf({}, py::none(), packages, cache, {}, childProcess);
  source.cell = std::make_shared<const WorkCell>(self);
  return loadRobot(source);
}

std::vector<double> numbersOf(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix4d& matrix = pose.matrix();
  return {matrix.data(), matrix.data() + matrix.size()};
}

void bindRobotOfCell(py::module_& module) {
  py::class_<CellRobot> type(module, "CellRobot", "A robot of a work cell.");
  type.def(
          py::init(&makeRobot), py::arg("name"), py::arg("urdf"), py::kw_only(),
          py::arg("srdf") = py::none(), py::arg("parent") = "", py::arg("pose") = py::none(),
          "`name`: of letters, digits, `_`, `-` and `.`, in front of each of its names: "
          "`NAME/link`. `urdf`, `srdf`: files; without an SRDF, that beside\nthe URDF. `parent`: a "
          "link, `NAME/link`, of a robot before this one that carries it; empty: the cell. `pose`: "
          "(4, 4) of its model frame there.")
      .def_readonly("name", &CellRobot::name, "In front of each of its names.")
      .def_property_readonly(
          "urdf", [](const CellRobot& self) { return toPython(self.urdf); }, "Its file.")
      .def_property_readonly(
          "srdf", [](const CellRobot& self) { return toPython(self.srdf); },
          "Its file; None without one.")
      .def_readonly("parent", &CellRobot::parent, "The link that carries it; empty: the cell.")
      .def_property_readonly(
          "pose", [](const CellRobot& self) { return makeArray(self.parent_from_robot); },
          "(4, 4) parent_from_robot.");
  addRepr(type, {"name", "urdf", "srdf", "parent"});
  addImmutableCopies(type);
}

}  // namespace

py::tuple stateOfCell(const WorkCell& cell) {
  py::list robots, groups;
  for (const CellRobot& robot : cell.robots)
    robots.append(py::make_tuple(robot.name, toPython(robot.urdf), toPython(robot.srdf),
                                 robot.parent, numbersOf(robot.parent_from_robot), robot.line));
  for (const CellGroup& group : cell.groups)
    groups.append(py::make_tuple(group.name, group.groups, group.line));
  return py::make_tuple(cell.name, cell.file, robots, groups);
}

WorkCell cellOf(const py::tuple& state) {
  WorkCell cell;
  cell.name = state[0].cast<std::string>();
  cell.file = state[1].cast<std::string>();
  for (const py::handle item : py::list(state[2])) {
    const auto parts = py::reinterpret_borrow<py::tuple>(item);
    CellRobot robot{.name = parts[0].cast<std::string>(),
                    .urdf = pathOf(parts[1]),
                    .srdf = pathOf(parts[2]),
                    .parent = parts[3].cast<std::string>()};
    const auto numbers = parts[4].cast<std::vector<double>>();
    robot.parent_from_robot.matrix() = Eigen::Map<const Eigen::Matrix4d>(numbers.data());
    robot.line = parts[5].cast<int>();
    cell.robots.push_back(std::move(robot));
  }
  for (const py::handle item : py::list(state[3])) {
    const auto parts = py::reinterpret_borrow<py::tuple>(item);
    cell.groups.push_back({parts[0].cast<std::string>(), parts[1].cast<std::vector<std::string>>(),
                           parts[2].cast<int>()});
  }
  return cell;
}

void bindCells(py::module_& module) {
  bindRobotOfCell(module);
  py::class_<WorkCell> type(
      module, "WorkCell",
      "Several robots at places of their own in one world, whose model frame is called `world`. "
      "They become one Robot, whose names say whose\nthey are (`left/elbow`): one may be planned "
      "for while others stand (Robot.standing), or all at once.");
  type.def(py::init(&makeCell), py::arg("robots"), py::arg("groups") = Groups(), py::kw_only(),
           py::arg("name") = "cell",
           "`robots`: CellRobot, each after its parent. `groups`: lists of groups, `NAME/group` or "
           "NAME for all of a robot, by the name of the group\nof all their joints; without any "
           "there is one, `all`. `name`: of the robot.")
      .def_static("load", &loadCell, py::arg("file"),
                  "Reads a YAML file; robot_model/FORMATS.md has its keys. Raises InputError.")
      .def("robot", &robotOf, py::kw_only(), py::arg("packages") = py::none(),
           py::arg("cache") = py::none(), py::arg("child_process") = true,
           "The Robot; arguments as Robot.load. Raises InputError for what is wrong with the cell "
           "and its files.")
      .def_readonly("name", &WorkCell::name, "Of the robot that it becomes.")
      .def_property_readonly(
          "robots", [](const WorkCell& self) { return py::tuple(py::cast(self.robots)); },
          "A CellRobot each.")
      .def_property_readonly(
          "groups",
          [](const WorkCell& self) {
            py::dict groups;
            for (const CellGroup& group : self.groups)
              groups[py::str(group.name)] = py::tuple(py::cast(group.groups));
            return groups;
          },
          "Names of the groups that each group unites, by its name.")
      .def(py::pickle([](const WorkCell& self) { return stateOfCell(self); }, &cellOf));
  addRepr(type, {"name", "robots", "groups"});
  addImmutableCopies(type);
}

}  // namespace swept::python
