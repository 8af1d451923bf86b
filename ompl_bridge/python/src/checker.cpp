// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/checker.hpp"

#include <pybind11/stl.h>

#include <map>
#include <optional>
#include <utility>

#include "arrays.hpp"
#include "binding.hpp"
#include "bodies.hpp"
#include "checker_queries.hpp"
#include "errors.hpp"
#include "handles.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/named_values.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// A group by its name or by its joints, with which the robot then has one more group.
std::string groupOf(RobotHandle& robot, const py::object& group) {
  if (py::isinstance<py::str>(group)) return group.cast<std::string>();
  if (!py::isinstance<py::sequence>(group))
    throw ArgumentTypeError("group: expected the name of a group, or a list of joints; got " +
                            std::string(py::repr(group)));
  const auto joints = valueOf<std::vector<std::string>>(group, "group", "a list of joints");
  std::string name;
  for (const std::string& joint : joints) name += (name.empty() ? "" : ",") + joint;
  if (robot.robot->findGroup(name) == nullptr) {
    robot.robot = robot.robot->withGroup(name, joints);
    robot.groups.emplace_back(name, joints);
  }
  return name;
}

/// Values of all variables: an array, or a dict of some, where the others have their default.
std::optional<Eigen::VectorXd> referenceOf(const Robot& robot, const py::object& reference) {
  if (reference.is_none()) return std::nullopt;
  if (py::isinstance<py::dict>(reference))
    return wholeStateOf(robot, valueOf<NamedValues>(reference, "reference", "values by name"));
  const Table table = readVector(reference, "reference", robot.variables().size());
  return Eigen::Map<const Eigen::VectorXd>(table.numbers().data(),
                                           static_cast<Eigen::Index>(table.columns()));
}

std::shared_ptr<const World> worldOf(const WorldHandle* world) {
  return std::make_shared<const World>(world != nullptr ? world->world : World());
}

CheckerHandle make(RobotHandle robot, const py::object& group, const WorldHandle* world,
                   double margin, std::optional<double> selfMargin,
                   std::optional<double> worldMargin, double tolerance, const py::object& reference,
                   int maxIntervals, std::size_t maxPairs, const CollisionRules& rules,
                   const std::vector<AttachedBody>& attached, const TrackingTolerance& tracking,
                   const TaskConstraint& constraints) {
  const std::string name = groupOf(robot, group);
  const CheckerOptions options{.margin = margin,
                               .tolerance = tolerance,
                               .reference = referenceOf(*robot.robot, reference),
                               .maxIntervals = maxIntervals,
                               .maxPairs = maxPairs,
                               .rules = rules,
                               .attached = attached,
                               .selfMargin = selfMargin,
                               .worldMargin = worldMargin,
                               .tracking = tracking,
                               .constraints = constraints};
  const std::shared_ptr<const World> obstacles = worldOf(world);
  const py::gil_scoped_release others;
  return {robot, Checker(robot.robot, name, obstacles, options)};
}

/// A version of the checker, made without the GIL.
template <typename Make>
CheckerHandle version(const CheckerHandle& self, Make&& makeVersion) {
  const py::gil_scoped_release others;
  return self.version(makeVersion(self.checker()));
}

void addVersions(py::class_<CheckerHandle>& type) {
  using Handle = CheckerHandle;
  type.def(
          "with_world",
          [](const Handle& self, const WorldHandle& world) {
            const auto obstacles = worldOf(&world);
            return version(self, [&](const Checker& old) { return old.withWorld(obstacles); });
          },
          py::arg("world"), "This checker in another world; rules about bodies that it lacks go.")
      .def(
          "with_body",
          [](const Handle& self, const std::string& name, const py::object& shape,
             const py::object& pose) {
            WorldBody body = bodyOf(name, shape, pose);
            return version(self, [&](const Checker& old) { return old.withBody(std::move(body)); });
          },
          py::arg("name"), py::arg("shape"), py::arg("pose") = py::none(),
          "Adds a body to the world; arguments as World.add.")
      .def(
          "with_replaced",
          [](const Handle& self, const std::string& name, const py::object& shape,
             const py::object& pose) {
            WorldBody body = bodyOf(name, shape, pose);
            return version(self,
                           [&](const Checker& old) { return old.withReplaced(std::move(body)); });
          },
          py::arg("name"), py::arg("shape"), py::arg("pose") = py::none(),
          "Replaces a body of the world and keeps all rules: the next frame of a surface, the next "
          "cloud of a sensor.")
      .def(
          "with_obstacle",
          [](const Handle& self, const std::string& name, const py::object& shape,
             const py::object& times, const py::object& poses) {
            MovingObstacle obstacle = obstacleOf(name, shape, times, poses);
            return version(
                self, [&](const Checker& old) { return old.withObstacle(std::move(obstacle)); });
          },
          py::arg("name"), py::arg("shape"), py::arg("times"), py::arg("poses"),
          "Adds a moving obstacle; arguments as World.add_obstacle. A configuration then has a "
          "time.")
      .def(
          "without_body",
          [](const Handle& self, const std::string& name) {
            return version(self, [&](const Checker& old) { return old.withoutBody(name); });
          },
          py::arg("name"), "Removes a body or moving obstacle from the world.")
      .def(
          "with_attached",
          [](const Handle& self, const std::string& name, const std::string& link,
             const py::object& shape, const py::object& pose,
             const std::vector<std::string>& touchLinks) {
            AttachedBody body = attachedOf(name, link, shape, pose, touchLinks);
            return version(self,
                           [&](const Checker& old) { return old.withAttached(std::move(body)); });
          },
          py::arg("name"), py::arg("link"), py::arg("shape"), py::arg("pose") = py::none(),
          py::arg("touch_links") = std::vector<std::string>(),
          "Adds a body that a link carries. `pose`: (4, 4), in the link's frame. `touch_links`: "
          "links "
          "that may touch it, with `*` for\nany characters; the one that carries it may anyway.")
      .def(
          "without_attached",
          [](const Handle& self, const std::string& name) {
            return version(self, [&](const Checker& old) { return old.withoutAttached(name); });
          },
          py::arg("name"), "Removes an attached body.")
      .def(
          "with_rules",
          [](const Handle& self, const CollisionRules& rules) {
            CollisionRules copy = rules;
            return version(self,
                           [&](const Checker& old) { return old.withRules(std::move(copy)); });
          },
          py::arg("rules"), "Replaces the rules.")
      .def(
          "with_tracking",
          [](const Handle& self, const TrackingTolerance& tracking) {
            return version(self, [&](const Checker& old) { return old.withTracking(tracking); });
          },
          py::arg("tracking"), "The same checks in another tube. Takes as long as a new Checker.")
      .def(
          "with_constraints",
          [](const Handle& self, const TaskConstraint& constraints) {
            return version(self,
                           [&](const Checker& old) { return old.withConstraints(constraints); });
          },
          py::arg("constraints"),
          "The same checks under a TaskConstraint, in place of that before: FREE then also means "
          "that it holds at every instant, VIOLATION\nthat it does not. Raises ArgumentError for "
          "links, bodies and joints that there are not, and for tolerances, sizes, axes and poses "
          "that\ncannot be used.")
      .def(
          "with_detached",
          [](const Handle& self, const std::string& name, const py::object& q) {
            const Table at = readVector(q, "q", self.dimension());
            return version(self, [&](const Checker& old) {
              WorldBody body = old.detachedBody(name, at.row(0));
              return old.withoutAttached(name).withBody(std::move(body));
            });
          },
          py::arg("name"), py::arg("q"),
          "Releases an attached body: it stays in the world at its pose in the configuration q "
          "(n,).");
}

py::tuple pairsOf(const std::vector<Checker::Pair>& pairs) {
  return py::tuple(py::cast(pairs));
}

void addProperties(py::class_<CheckerHandle>& type) {
  using Handle = CheckerHandle;
  type.def_property_readonly("robot", &Handle::robot, "The Robot.")
      .def_property_readonly(
          "world", [](const Handle& self) { return WorldHandle{.world = self.checker().world()}; },
          "A copy of the World.")
      .def_property_readonly(
          "group",
          [](const Handle& self) { return makeGroup(self.robot().robot, self.checker().group()); },
          "The Group.")
      .def_property_readonly("dimension", &Handle::dimension,
                             "Number of values in a configuration.")
      .def_property_readonly(
          "margin", [](const Handle& self) { return self.checker().options().margin; },
          "m, what every pair must keep, unless a rule or another margin says otherwise.")
      .def_property_readonly(
          "tolerance", [](const Handle& self) { return self.checker().options().tolerance; },
          "m. A motion that keeps more than margin + tolerance everywhere is FREE.")
      .def_property_readonly(
          "tracking", [](const Handle& self) { return self.checker().options().tracking; },
          "The TrackingTolerance of the tube.")
      .def_property_readonly(
          "rules", [](const Handle& self) { return self.checker().options().rules; },
          "A copy of the CollisionRules.")
      .def_property_readonly(
          "attached",
          [](const Handle& self) { return py::tuple(py::cast(self.checker().options().attached)); },
          "The AttachedBody that links carry.")
      .def_property_readonly(
          "constraints", [](const Handle& self) { return self.checker().options().constraints; },
          "The TaskConstraint that has to hold; an empty one: none.")
      .def_property_readonly(
          "checked_pairs",
          [](const Handle& self) { return pairsOf(self.checker().checkedPairs()); },
          "A Pair for each pair that is checked, in a fixed order.")
      .def_property_readonly(
          "skipped_pairs",
          [](const Handle& self) { return pairsOf(self.checker().skippedPairs()); },
          "A Pair for each pair that is not, with the reason.")
      .def_property_readonly(
          "static_contacts",
          [](const Handle& self) { return pairsOf(self.checker().staticContacts()); },
          "Pairs in contact that the group cannot change; they do not enter verdicts.")
      .def_property_readonly(
          "links_without_geometry",
          [](const Handle& self) {
            return py::tuple(py::cast(self.checker().linksWithoutGeometry()));
          },
          "Links that the group moves and that have no geometry: FREE says nothing about them.")
      .def_property_readonly(
          "checks_nothing", [](const Handle& self) { return self.checker().checksNothing(); },
          "Whether no pair is checked: FREE then says nothing at all.")
      .def(
          "explain",
          [](const Handle& self, const std::string& bodyA, const std::string& bodyB) {
            return self.checker().explain(bodyA, bodyB);
          },
          py::arg("body_a"), py::arg("body_b"),
          "One sentence: whether the pair is checked, which rule decides, and what it must keep.")
      .def(
          "named_state",
          [](const Handle& self, const std::string& name) {
            return makeArray(
                namedConfiguration(self.checker().robot(), self.checker().group(), name));
          },
          py::arg("name"),
          "(n,) values in a state of the SRDF, or in `default`; see Robot.named_state.")
      .def(
          "configuration",
          [](const Handle& self, const NamedValues& values, const py::object& others) {
            const Checker& checker = self.checker();
            if (others.is_none())
              return makeArray(configurationOf(checker.robot(), checker.group(), values));
            const Table rest = readVector(others, "others", checker.group().variables.size());
            return makeArray(
                configurationOf(checker.robot(), checker.group(), values, rest.row(0)));
          },
          py::arg("values"), py::arg("others") = py::none(),
          "(n,) configuration from a dict of values (rad, m) by name; the others as in `others` "
          "(n,). "
          "Raises ArgumentError for\nunknown and missing names.")
      .def("__repr__", [](const Handle& self) {
        const Checker& checker = self.checker();
        return "<swept.Checker of " + checker.robot().name() + "/" + checker.group().name +
               ", world of " + std::to_string(checker.world().bodies().size()) + " bodies>";
      });
}

}  // namespace

void bindChecker(py::module_& module) {
  const CheckerOptions usual;
  py::class_<CheckerHandle> type(
      module, "Checker",
      "Validity of states and motions of a group of a robot in a world. It never changes; any "
      "number "
      "of threads may use it.\n\nA configuration is an array (n,) of float64, C-contiguous: the "
      "values "
      "of the group's variables (rad, m), and with moving\nobstacles the time (s). Lists of "
      "numbers "
      "will do, too. The motion between two is straight; angles without limits go the\nshorter "
      "way. "
      "Queries release the GIL. They raise ArgumentError or ArgumentTypeError for another shape, "
      "order or type of\nan array, NaN and infinity.");
  type.def(
      py::init(&make), py::arg("robot"), py::arg("group"), py::arg("world") = nullptr,
      py::kw_only(), py::arg("margin") = usual.margin, py::arg("self_margin") = py::none(),
      py::arg("world_margin") = py::none(), py::arg("tolerance") = usual.tolerance,
      py::arg("reference") = py::none(), py::arg("max_intervals") = usual.maxIntervals,
      py::arg("max_pairs") = usual.maxPairs, py::arg("rules") = CollisionRules(),
      py::arg("attached") = std::vector<AttachedBody>(), py::arg("tracking") = TrackingTolerance(),
      py::arg("constraints") = TaskConstraint(),
      "`group`: a name, or a list of joints. `margin`: m, FREE means that each pair keeps more; "
      "`self_margin`, `world_margin`: in its\nplace for pairs of the robot's own bodies, and "
      "with the world. `tolerance`: m, a motion that keeps more than margin +\ntolerance is "
      "FREE. `reference`: values of all variables, an array or a dict of some; those outside "
      "the group keep them.\n`max_intervals`, `max_pairs`: caps on work and memory. `rules`: "
      "CollisionRules. `attached`: a list of AttachedBody.\n`tracking`: TrackingTolerance. "
      "Raises ArgumentError for values that cannot be used.");
  addProperties(type);
  addVersions(type);
  addQueries(type);
  addImmutableCopies(type);
}

}  // namespace swept::python
