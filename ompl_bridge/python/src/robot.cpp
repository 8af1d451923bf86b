// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "arrays.hpp"
#include "binding.hpp"
#include "errors.hpp"
#include "handles.hpp"
#include "loading.hpp"
#include "robots.hpp"
#include "spheres.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/sphere_model.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// swept.Group: a group of a robot.
struct GroupHandle {
  std::shared_ptr<const Robot> robot;
  const Group* group;  ///< of that robot

  const Variable& variable(std::size_t i) const {
    return robot->variables()[static_cast<std::size_t>(group->variables[i])];
  }
  py::object values(double Variable::*member) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < group->variables.size(); ++i) result.push_back(variable(i).*member);
    return makeArray(result);
  }
};

/// The names of some of the robot's parts.
template <typename Part>
py::tuple namesOf(const std::vector<Part>& parts) {
  py::tuple names(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) names[i] = parts[i].name;
  return names;
}

RobotHandle loadFiles(const std::filesystem::path& urdf, const py::object& srdf,
                      const py::object& packages, const py::object& cache, bool childProcess) {
  Source source = sourceOf(urdf, srdf, packages, cache, {}, childProcess);
  if (srdf.is_none()) source.srdf = Robot::srdfBeside(source.file);
  return loadRobot(source);
}

RobotHandle withGroup(const RobotHandle& self, const std::string& name,
                      const std::vector<std::string>& joints) {
  RobotHandle result = self;
  result.robot = self.robot->withGroup(name, joints);
  result.groups.emplace_back(name, joints);
  return result;
}

RobotHandle withChain(const RobotHandle& self, const std::string& name, const std::string& base,
                      const std::string& tip) {
  RobotHandle result = self;
  result.robot = self.robot->withChain(name, base, tip);
  std::vector<std::string> joints;
  for (const int joint : groupOf(*result.robot, name).joints)
    joints.push_back(result.robot->joints()[static_cast<std::size_t>(joint)].name);
  result.groups.emplace_back(name, std::move(joints));
  return result;
}

py::dict namedStates(const RobotHandle& self, const std::string& group) {
  const Group& found = groupOf(*self.robot, group);
  py::dict states;
  for (const NamedState& state : self.robot->namedStates())
    if (state.group == group)
      states[py::str(state.name)] = makeArray(namedConfiguration(*self.robot, found, state.name));
  return states;
}

/// Centres and radii of balls that contain a link's geometry, in the link's frame.
py::object sphereCover(const RobotHandle& self, const std::string& name, std::optional<int> level) {
  const std::optional<int> index = self.robot->findLink(name);
  if (!index) throw std::invalid_argument("the robot has no link '" + name + "'");
  if (level && *level < 0) throw std::invalid_argument("level: expected a number of at least 0");
  // The roundings of a pose are less than these shares of what they are about.
  constexpr double kRounding = 1e-12;
  std::vector<std::vector<double>> balls;
  for (const CollisionGeometry& piece :
       self.robot->links()[static_cast<std::size_t>(*index)].collision) {
    if (!piece.cover) throw std::invalid_argument("link '" + name + "' has a piece without end");
    const int finest = static_cast<int>(piece.cover->levels.size()) - 1;
    for (const int node : piece.cover->cut(std::min(level.value_or(finest), finest))) {
      const CoverBall& ball = piece.cover->nodes[static_cast<std::size_t>(node)].ball;
      const Eigen::Vector3d center = piece.link_from_shape * ball.center.cast<double>();
      const double reach = piece.link_from_shape.translation().norm() + ball.center.norm();
      balls.push_back(
          {center.x(), center.y(), center.z(), ball.radius + kRounding * (reach + ball.radius)});
    }
  }
  return makeArray(balls, 4);
}

/// Pairs of a Shape and its pose: a body, as functions take it.
py::list linkShapes(const RobotHandle& self, const std::string& name) {
  const std::optional<int> index = self.robot->findLink(name);
  if (!index) throw std::invalid_argument("the robot has no link '" + name + "'");
  return listOf(bodyOf(self.robot->links()[static_cast<std::size_t>(*index)]));
}

/// All variables, where some groups have postures: the name of a state, or values.
py::object standing(const RobotHandle& self, const py::dict& postures) {
  const Robot& robot = *self.robot;
  Eigen::VectorXd all = robot.defaultState();
  for (const auto& [key, posture] : postures) {
    const auto name = valueOf<std::string>(key, "postures", "names of groups");
    const Group& group = groupOf(robot, name);
    std::vector<double> q;
    if (py::isinstance<py::str>(posture)) {
      q = namedConfiguration(robot, group, posture.cast<std::string>());
    } else {
      const Table values =
          readVector(posture, ("posture of '" + name + "'").c_str(), group.variables.size());
      q.assign(values.numbers().begin(), values.numbers().end());
    }
    for (std::size_t i = 0; i < q.size(); ++i) all[group.variables[i]] = q[i];
  }
  return makeArray(ConfigurationView(all));
}

py::tuple stateOf(const RobotHandle& self) {
  const Source& source = self.source;
  return py::make_tuple(
      toPython(source.file), toPython(source.srdf), source.packages, toPython(source.cache),
      source.childProcess, self.groups,
      source.cell != nullptr ? py::object(stateOfCell(*source.cell)) : py::none());
}

RobotHandle fromState(const py::tuple& state) {
  Source source{.file = pathOf(state[0]),
                .srdf = pathOf(state[1]),
                .packages = state[2].cast<decltype(Source::packages)>(),
                .cache = pathOf(state[3]),
                .childProcess = state[4].cast<bool>()};
  if (!state[6].is_none()) source.cell = std::make_shared<const WorkCell>(cellOf(state[6]));
  RobotHandle result = loadRobot(source);
  for (const auto& [name, joints] : state[5].cast<decltype(RobotHandle::groups)>())
    result = withGroup(result, name, joints);
  return result;
}

void bindGroup(py::module_& module) {
  py::class_<GroupHandle> group(module, "Group",
                                "Joints that are planned together, and the variables of a "
                                "configuration: rad or m, in this order.");
  group
      .def_property_readonly(
          "name", [](const GroupHandle& self) { return self.group->name; },
          "From the SRDF, or `all`.")
      .def_property_readonly(
          "joint_names",
          [](const GroupHandle& self) {
            py::tuple names(self.group->joints.size());
            for (std::size_t i = 0; i < self.group->joints.size(); ++i)
              names[i] = self.robot->joints()[static_cast<std::size_t>(self.group->joints[i])].name;
            return names;
          },
          "Joints with values of their own, parents before children.")
      .def_property_readonly(
          "variable_names",
          [](const GroupHandle& self) {
            py::tuple names(self.group->variables.size());
            for (std::size_t i = 0; i < names.size(); ++i) names[i] = self.variable(i).name;
            return names;
          },
          "The joint's name, or `joint/x`, `joint/theta`, `joint/rot_w` and so on.")
      .def_property_readonly(
          "tip_link",
          [](const GroupHandle& self) -> py::object {
            if (self.group->tipLink < 0) return py::none();
            return py::str(self.robot->links()[static_cast<std::size_t>(self.group->tipLink)].name);
          },
          "End of the chain, or the last link; None if there is none.")
      .def_property_readonly(
          "lower", [](const GroupHandle& self) { return self.values(&Variable::lower); },
          "(n,) rad or m; -inf where there is no limit.")
      .def_property_readonly(
          "upper", [](const GroupHandle& self) { return self.values(&Variable::upper); },
          "(n,) rad or m; inf where there is no limit.")
      .def_property_readonly(
          "velocity", [](const GroupHandle& self) { return self.values(&Variable::velocity); },
          "(n,) rad/s or m/s, of the URDF; inf where there is no limit.")
      .def_property_readonly(
          "cyclic",
          [](const GroupHandle& self) {
            py::tuple cyclic(self.group->variables.size());
            for (std::size_t i = 0; i < cyclic.size(); ++i)
              cyclic[i] = py::bool_(self.variable(i).cyclic);
            return cyclic;
          },
          "For each variable, whether it is an angle modulo 2 pi, which goes the shorter way.")
      .def("__len__", [](const GroupHandle& self) { return self.group->variables.size(); })
      .def("__repr__", [](const GroupHandle& self) {
        return "<swept.Group '" + self.group->name + "' of " +
               std::to_string(self.group->variables.size()) + " variables>";
      });
}

}  // namespace

RobotHandle loadRobot(const Source& source) {
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor(source);
  RobotHandle handle{.robot = nullptr, .source = source};
  {
    const py::gil_scoped_release others;
    handle.robot = source.cell != nullptr ? loadWorkCell(*source.cell, options)
                                          : Robot::load(source.file, source.srdf, options);
  }
  remarks.warn();
  return handle;
}

const Group& groupOf(const Robot& robot, const std::string& name) {
  if (const Group* group = robot.findGroup(name)) return *group;
  std::string names;
  for (const Group& group : robot.groups()) names += (names.empty() ? "" : ", ") + group.name;
  throw std::invalid_argument("robot '" + robot.name() + "' has no group '" + name +
                              "'; it has: " + names);
}

py::object makeGroup(std::shared_ptr<const Robot> robot, const Group& group) {
  // That of the robot, which the handle keeps alive.
  const Group* own = robot->findGroup(group.name);
  return py::cast(GroupHandle{std::move(robot), own});
}

void bindRobot(py::module_& module) {
  bindGroup(module);
  py::class_<RobotHandle> robot(
      module, "Robot",
      "A kinematic tree with collision geometry, from URDF and SRDF. It never changes. Lengths are "
      "in m, angles in rad.");
  robot
      .def_static(
          "load", &loadFiles, py::arg("urdf"), py::arg("srdf") = py::none(), py::kw_only(),
          py::arg("packages") = py::none(), py::arg("cache") = py::none(),
          py::arg("child_process") = true,
          "Reads a URDF, and an SRDF: without one, that beside the URDF with the same stem.\n"
          "`packages`: folders of `package://NAME` paths, by name. `cache`: folder that "
          "keeps the balls around meshes\nfor the next time. `child_process`: whether glTF "
          "meshes are read in a process of their own.\nRaises InputError; remarks are "
          "warnings (InputWarning).")
      .def_property_readonly(
          "name", [](const RobotHandle& self) { return self.robot->name(); },
          "The name in the URDF.")
      .def_property_readonly(
          "model_frame", [](const RobotHandle& self) { return self.robot->modelFrame(); },
          "Name of the frame that all poses are in.")
      .def_property_readonly(
          "link_names", [](const RobotHandle& self) { return namesOf(self.robot->links()); },
          "Parents first.")
      .def_property_readonly(
          "joint_names", [](const RobotHandle& self) { return namesOf(self.robot->joints()); },
          "Parents first, fixed ones too.")
      .def_property_readonly(
          "variable_names",
          [](const RobotHandle& self) { return namesOf(self.robot->variables()); },
          "Of all variables, in the order of `default_state()`.")
      .def_property_readonly(
          "group_names", [](const RobotHandle& self) { return namesOf(self.robot->groups()); },
          "The SRDF's groups; a robot without any has one, `all`.")
      .def(
          "group",
          [](const RobotHandle& self, const std::string& name) {
            return makeGroup(self.robot, groupOf(*self.robot, name));
          },
          py::arg("name"), "A group. Raises ArgumentError for an unknown name.")
      .def("with_group", &withGroup, py::arg("name"), py::arg("joints"),
           "This robot with one more group, of the movable joints among these.\nRaises "
           "ArgumentError for a name that is taken, an unknown joint and one without own values.")
      .def("with_chain", &withChain, py::arg("name"), py::arg("base_link"), py::arg("tip_link"),
           "This robot with one more group: the joints between two links.")
      .def("named_states", &namedStates, py::arg("group"),
           "States that the SRDF names for a group: (n,) arrays by name.")
      .def(
          "named_state",
          [](const RobotHandle& self, const std::string& group, const std::string& name) {
            return makeArray(namedConfiguration(*self.robot, groupOf(*self.robot, group), name));
          },
          py::arg("group"), py::arg("name"),
          "(n,) values of the group's variables in a state of the SRDF, or in `default`.\nRaises "
          "ArgumentError, which lists the names that there are.")
      .def(
          "default_state",
          [](const RobotHandle& self) {
            const Eigen::VectorXd state = self.robot->defaultState();
            return makeArray(ConfigurationView(state));
          },
          "(all variables,) zero where the limits allow it, else the middle of the limits.")
      .def(
          "link_pose",
          [](const RobotHandle& self, const std::string& group, const std::string& link,
             const py::object& q) {
            const std::size_t size = groupOf(*self.robot, group).variables.size();
            return makeArray(linkPose(*self.robot, group, link, readVector(q, "q", size).row(0)));
          },
          py::arg("group"), py::arg("link"), py::arg("q"),
          "(4, 4) pose of a link in the model frame, at a configuration (n,) of a group.")
      .def("sphere_cover", &sphereCover, py::arg("link"), py::arg("level") = py::none(),
           "(k, 4): x, y, z (m, link's frame) and radius (m) of balls that together contain the "
           "link's "
           "geometry, proven; for planners and\noptimisers that take spheres. `level`: from 0, one "
           "ball "
           "for each piece, to the finest, the default.")
      .def("link_shapes", &linkShapes, py::arg("link"),
           "The collision geometry of a link: a list of pairs of a Shape and its pose (4, 4) in "
           "the link's frame.")
      .def("standing", &standing, py::arg("postures"),
           "(all variables,) where groups stand as a dict says: by the name of the group that of a "
           "state, or values (n,); all others have their\ndefault. For Checker's `reference`: "
           "joints outside its group keep these values.")
      .def_property_readonly(
          "links_without_geometry",
          [](const RobotHandle& self) {
            return py::tuple(py::cast(self.robot->linksWithoutGeometry()));
          },
          "Links with a <visual> but no <collision>: no answer is about them.")
      .def("__repr__",
           [](const RobotHandle& self) {
             return "<swept.Robot '" + self.robot->name() + "' of " +
                    std::to_string(self.robot->links().size()) + " links>";
           })
      .def(py::pickle(&stateOf, &fromState));
  addImmutableCopies(robot);
}

}  // namespace swept::python
