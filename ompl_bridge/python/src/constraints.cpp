// SPDX-License-Identifier: BSD-3-Clause
#include "constraints.hpp"

#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "enums.hpp"
#include "errors.hpp"
#include "handles.hpp"
#include "swept/robot_model/constraint_projection.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Projection = ConstraintProjection;

/// Three sizes or tolerances, of which some may be infinite: no array has these.
Eigen::Vector3d threeOf(const py::object& value, const char* argument) {
  std::vector<double> numbers;
  if (py::isinstance<py::sequence>(value) && !py::isinstance<py::str>(value))
    for (const py::handle item : value) {
      const double number = PyFloat_AsDouble(item.ptr());
      if (number == -1.0 && PyErr_Occurred() != nullptr) {
        PyErr_Clear();
        throw ArgumentTypeError(std::string(argument) + ": expected three numbers, got " +
                                std::string(py::repr(value)));
      }
      numbers.push_back(number);
    }
  if (numbers.size() != 3)
    throw std::invalid_argument(std::string(argument) + ": expected three numbers, got " +
                                std::string(py::repr(value)));
  return {numbers[0], numbers[1], numbers[2]};
}

Eigen::Vector3d pointOr(const py::object& value, const char* argument,
                        const Eigen::Vector3d& other) {
  return value.is_none() ? other : readPoint(value, argument);
}

py::object pairOf(const ConstraintFrame& frame) {
  return py::make_tuple(frame.body, makeArray(frame.body_from_frame));
}

/// A read-only property with a frame.
template <typename Class>
void addFrames(py::class_<Class>& type) {
  type.def_property_readonly(
          "frame", [](const Class& self) { return pairOf(self.frame); },
          "What it is about: a link or an attached body, and the frame's pose (4, 4) in it.")
      .def_property_readonly(
          "reference", [](const Class& self) { return pairOf(self.reference); },
          "From which it is seen, likewise; an empty name: the model frame.");
}

void bindRegion(py::module_& module) {
  using Region = ConstraintRegion;
  py::class_<Region> type(module, "ConstraintRegion",
                          "Where a point may be: see PositionConstraint. `pose`: (4, 4) of its "
                          "centre, in the reference. A size (m) may be infinite.");
  type.def_static(
          "box",
          [](const py::object& size, const py::object& pose) {
            return Region{Region::Type::Box, threeOf(size, "size"), readPose(pose, "pose")};
          },
          py::arg("size"), py::arg("pose") = py::none(), "`size`: (3,) m, full sides.")
      .def_static(
          "sphere",
          [](double radius, const py::object& pose) {
            return Region{Region::Type::Sphere, {radius, 0.0, 0.0}, readPose(pose, "pose")};
          },
          py::arg("radius"), py::arg("pose") = py::none(), "`radius`: m.")
      .def_static(
          "cylinder",
          [](double radius, double length, const py::object& pose) {
            return Region{Region::Type::Cylinder, {radius, length, 0.0}, readPose(pose, "pose")};
          },
          py::arg("radius"), py::arg("length"), py::arg("pose") = py::none(),
          "About z; `length`: m, in full.")
      .def_property_readonly(
          "kind",
          [](const Region& self) {
            constexpr std::array kKinds{"box", "sphere", "cylinder"};
            return kKinds[static_cast<std::size_t>(self.type)];
          },
          "`box`, `sphere` or `cylinder`.")
      .def_property_readonly(
          "size", [](const Region& self) { return makeArray(self.size); },
          "(3,) m: of a box its sides; of a sphere its radius, 0, 0; of a cylinder radius, length, "
          "0.")
      .def_property_readonly(
          "pose", [](const Region& self) { return makeArray(self.reference_from_region); },
          "(4, 4) reference_from_region.");
  addRepr(type, {"kind", "size"});
  addImmutableCopies(type);
}

void bindJoint(py::module_& module) {
  py::class_<JointConstraint> type(
      module, "JointConstraint",
      "A joint's value stays in [position - below, position + above]; of a cyclic one the shorter "
      "way counts.");
  type.def(py::init([](const std::string& joint, double position, double above, double below) {
             return JointConstraint{joint, position, above, below};
           }),
           py::arg("joint"), py::arg("position"), py::kw_only(), py::arg("above") = 0.0,
           py::arg("below") = 0.0,
           "`joint`: a joint of one value, or a variable (`base/x`). All in rad or m.")
      .def_readonly("joint", &JointConstraint::joint, "The joint or variable.")
      .def_readonly("position", &JointConstraint::position, "rad or m.")
      .def_readonly("above", &JointConstraint::above, "rad or m.")
      .def_readonly("below", &JointConstraint::below, "rad or m.");
  addRepr(type, {"joint", "position", "above", "below"});
  addImmutableCopies(type);
}

void bindPosition(py::module_& module) {
  py::class_<PositionConstraint> type(module, "PositionConstraint",
                                      "The origin of a frame stays in one of some regions.");
  type.def(py::init([](const py::object& frame, std::vector<ConstraintRegion> regions,
                       const py::object& reference) {
             return PositionConstraint{frameOf(frame, "frame"), frameOf(reference, "reference"),
                                       std::move(regions)};
           }),
           py::arg("frame"), py::arg("regions"), py::arg("reference") = py::none(),
           "`frame`: the name of a link or an attached body, or a pair of it and a pose (4, 4) in "
           "it. `regions`: ConstraintRegion, in the\nframe `reference`: likewise; None: the model "
           "frame.")
      .def_property_readonly(
          "regions",
          [](const PositionConstraint& self) { return py::tuple(py::cast(self.regions)); },
          "A ConstraintRegion each.");
  addFrames(type);
  addRepr(type, {"frame", "reference", "regions"});
  addImmutableCopies(type);
}

void bindOrientation(py::module_& module) {
  using Constraint = OrientationConstraint;
  using Parameters = Constraint::Parameterization;
  py::class_<Constraint> type(
      module, "OrientationConstraint",
      "A frame is turned from `orientation` by no more than tolerances (rad): R = "
      "inverse(orientation) * (rotation from `reference` to `frame`).");
  type.def(
          py::init([](const py::object& frame, const py::object& tolerance,
                      const py::object& orientation, const py::object& reference,
                      bool rotationVector) {
            return Constraint{
                .frame = frameOf(frame, "frame"),
                .reference = frameOf(reference, "reference"),
                .orientation =
                    Eigen::Quaterniond(readPose(orientation, "orientation").linear()).normalized(),
                .tolerance = threeOf(tolerance, "tolerance"),
                .parameterization =
                    rotationVector ? Parameters::RotationVector : Parameters::EulerAngles};
          }),
          py::arg("frame"), py::arg("tolerance"), py::kw_only(),
          py::arg("orientation") = py::none(), py::arg("reference") = py::none(),
          py::arg("rotation_vector") = false,
          "Frames as in PositionConstraint. `tolerance`: (3,) rad, pi and more: any angle. "
          "`orientation`: a pose (4, 4) in the reference, of\nwhich the rotation counts; None: the "
          "reference's own. R = Rx(a) Ry(b) Rz(c), and |a|, |b|, |c| are within the tolerances; "
          "with\n`rotation_vector` those of the rotation vector of R, in the axes of the "
          "reference.")
      .def_property_readonly(
          "tolerance", [](const Constraint& self) { return makeArray(self.tolerance); },
          "(3,) rad.")
      .def_property_readonly(
          "orientation",
          [](const Constraint& self) {
            Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
            pose.linear() = self.orientation.toRotationMatrix();
            return makeArray(pose);
          },
          "(4, 4), without a translation.")
      .def_property_readonly(
          "rotation_vector",
          [](const Constraint& self) {
            return self.parameterization == Parameters::RotationVector;
          },
          "Whether the tolerances are of a rotation vector.");
  addFrames(type);
  addRepr(type, {"frame", "reference", "tolerance", "rotation_vector"});
  addImmutableCopies(type);
}

void bindAxis(py::module_& module) {
  py::class_<AxisConstraint> type(
      module, "AxisConstraint",
      "An axis of a frame stays within an angle of a direction of the reference.");
  type.def(py::init([](const py::object& frame, double angle, const py::object& axis,
                       const py::object& direction, const py::object& reference) {
             const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
             return AxisConstraint{frameOf(frame, "frame"), frameOf(reference, "reference"),
                                   pointOr(axis, "axis", up), pointOr(direction, "direction", up),
                                   angle};
           }),
           py::arg("frame"), py::arg("angle"), py::kw_only(), py::arg("axis") = py::none(),
           py::arg("direction") = py::none(), py::arg("reference") = py::none(),
           "Frames as in PositionConstraint. `angle`: rad, pi and more: any. `axis`: (3,) in the "
           "frame, `direction`: (3,) in the reference;\nz by default.")
      .def_readonly("angle", &AxisConstraint::angle, "rad.")
      .def_property_readonly(
          "axis", [](const AxisConstraint& self) { return makeArray(self.axis); },
          "(3,) in the frame.")
      .def_property_readonly(
          "direction", [](const AxisConstraint& self) { return makeArray(self.direction); },
          "(3,) in the reference.");
  addFrames(type);
  addRepr(type, {"frame", "reference", "angle", "axis", "direction"});
  addImmutableCopies(type);
}

std::size_t countOf(const TaskConstraint& constraint, ConstraintViolation::Kind kind) {
  const std::array sizes{constraint.joints.size(), constraint.positions.size(),
                         constraint.orientations.size(), constraint.axes.size()};
  return sizes[static_cast<std::size_t>(kind)];
}

std::string describeOf(const TaskConstraint& self, const ConstraintViolation& violation) {
  if (violation.index >= countOf(self, violation.kind))
    throw std::invalid_argument("violation: it is not one of these constraints");
  return describe(violation, self);
}

void addMakers(py::class_<TaskConstraint>& type) {
  type.def_static(
          "upright",
          [](const std::string& link, double angle, const py::object& axis) {
            return TaskConstraint::upright(link, angle,
                                           pointOr(axis, "axis", Eigen::Vector3d::UnitZ()));
          },
          py::arg("link"), py::arg("angle"), py::arg("axis") = py::none(),
          "An axis (3,) of a link or an attached body, by default z, points up to within `angle` "
          "(rad): along z of the model frame.")
      .def_static(
          "level",
          [](const std::string& link, const py::object& pose, double angle) {
            return TaskConstraint::level(link, readPose(pose, "pose"), angle);
          },
          py::arg("link"), py::arg("pose"), py::arg("angle"),
          "What points up in the link at `pose` (4, 4) keeps pointing up to within `angle` (rad); "
          "the link may turn about the vertical.")
      .def_static(
          "inside",
          [](const std::string& link, const py::object& size, const py::object& pose,
             const py::object& point) {
            return TaskConstraint::inside(link, threeOf(size, "size"), readPose(pose, "pose"),
                                          pointOr(point, "point", Eigen::Vector3d::Zero()));
          },
          py::arg("link"), py::arg("size"), py::arg("pose") = py::none(),
          py::arg("point") = py::none(),
          "A point (3,) of the link, by default its origin, is in a box with full sides `size` "
          "(3,) m at `pose` (4, 4).")
      .def_static(
          "on_line",
          [](const std::string& link, const py::object& origin, const py::object& direction,
             double tolerance, const py::object& point) {
            return TaskConstraint::onLine(link, readPoint(origin, "origin"),
                                          readPoint(direction, "direction"), tolerance,
                                          pointOr(point, "point", Eigen::Vector3d::Zero()));
          },
          py::arg("link"), py::arg("origin"), py::arg("direction"), py::arg("tolerance"),
          py::arg("point") = py::none(),
          "The point is within `tolerance` (m) of a line through `origin` (3,).")
      .def_static(
          "on_plane",
          [](const std::string& link, const py::object& origin, const py::object& normal,
             double tolerance, const py::object& point) {
            return TaskConstraint::onPlane(link, readPoint(origin, "origin"),
                                           readPoint(normal, "normal"), tolerance,
                                           pointOr(point, "point", Eigen::Vector3d::Zero()));
          },
          py::arg("link"), py::arg("origin"), py::arg("normal"), py::arg("tolerance"),
          py::arg("point") = py::none(),
          "The point is within `tolerance` (m) of a plane through `origin` (3,).");
}

void bindTask(py::module_& module) {
  py::class_<TaskConstraint> type(
      module, "TaskConstraint",
      "What a task asks of a robot besides keeping clear of bodies; all of it holds at once. "
      "Poses and points are in the model frame,\nlengths in m, angles in rad. See "
      "Checker.with_constraints, which finds what is wrong with one.");
  type.def(py::init([](std::vector<JointConstraint> joints,
                       std::vector<PositionConstraint> positions,
                       std::vector<OrientationConstraint> orientations,
                       std::vector<AxisConstraint> axes) {
             return TaskConstraint{std::move(joints), std::move(positions), std::move(orientations),
                                   std::move(axes)};
           }),
           py::kw_only(), py::arg("joints") = std::vector<JointConstraint>(),
           py::arg("positions") = std::vector<PositionConstraint>(),
           py::arg("orientations") = std::vector<OrientationConstraint>(),
           py::arg("axes") = std::vector<AxisConstraint>(),
           "Lists of JointConstraint, PositionConstraint, OrientationConstraint and "
           "AxisConstraint.")
      .def_property_readonly(
          "joints", [](const TaskConstraint& self) { return py::tuple(py::cast(self.joints)); },
          "A JointConstraint each.")
      .def_property_readonly(
          "positions",
          [](const TaskConstraint& self) { return py::tuple(py::cast(self.positions)); },
          "A PositionConstraint each.")
      .def_property_readonly(
          "orientations",
          [](const TaskConstraint& self) { return py::tuple(py::cast(self.orientations)); },
          "An OrientationConstraint each.")
      .def_property_readonly(
          "axes", [](const TaskConstraint& self) { return py::tuple(py::cast(self.axes)); },
          "An AxisConstraint each.")
      .def("describe", &describeOf, py::arg("violation"),
           "`orientation of 'hand' is 0.0213 rad beyond its tolerance`: a ConstraintViolation of "
           "these in words. Raises ArgumentError if it\ncannot be one.")
      .def(
          "__and__",
          [](const TaskConstraint& self, const TaskConstraint& other) {
            TaskConstraint both = self;
            both.add(other);
            return both;
          },
          py::arg("other"), py::is_operator(), "Both hold.")
      .def("__len__", &TaskConstraint::size);
  addMakers(type);
  addRepr(type, {"joints", "positions", "orientations", "axes"});
  addImmutableCopies(type);
}

void bindViolation(py::module_& module) {
  py::class_<ConstraintViolation> type(
      module, "ConstraintViolation",
      "A constraint does not hold at an instant, proven with all rounding: the witness of "
      "VIOLATION. TaskConstraint.describe puts it in words.");
  type.def_readonly("t", &ConstraintViolation::t, "In [0, 1]; 0 for a state.")
      .def_property_readonly(
          "kind", [](const ConstraintViolation& self) { return toPython(self.kind); },
          "ConstraintKind: in which list of TaskConstraint the constraint is.")
      .def_readonly("index", &ConstraintViolation::index, "Into that list.")
      .def_readonly("excess", &ConstraintViolation::excess,
                    "rad or m: by how much the value or angle is beyond its tolerance, or the "
                    "distance from the nearest region.");
  addRepr(type, {"t", "kind", "index", "excess"});
  addImmutableCopies(type);
}

ConfigurationView read(const Table& table) {
  return table.row(0);
}

Table vectorOf(const Projection& self, const py::object& q, const char* argument) {
  return readVector(q, argument, static_cast<std::size_t>(self.dimension()));
}

py::object project(const Projection& self, const py::object& q, double share, int maxIterations) {
  const Table from = vectorOf(self, q, "q");
  double* memory = nullptr;
  py::object result = makeDoubles(from.columns(), memory);
  std::ranges::copy(from.numbers(), memory);
  bool found = false;
  {
    const py::gil_scoped_release others;
    Projection::Workspace workspace(self);
    found = self.project(ConfigurationSpan(memory, from.columns()),
                         {.share = share, .maxIterations = maxIterations}, workspace);
  }
  if (!found) return py::none();
  return result;
}

py::tuple projectStates(const Projection& self, const py::object& states, double share,
                        int maxIterations, std::optional<double> seconds,
                        const std::shared_ptr<CancellationToken>& cancel) {
  const Watch watch(seconds, cancel);
  const Table from = readTable(states, "states", static_cast<std::size_t>(self.dimension()));
  double* memory = nullptr;
  const py::object numbers = makeDoubles(from.numbers().size(), memory);
  std::ranges::copy(from.numbers(), memory);
  std::uint8_t* found = nullptr;
  const py::object flags = makeBytes(from.rows(), found);
  Projection::Workspace workspace(self);
  Pace pace;
  runInRanges(from.rows(), watch, pace, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const ConfigurationSpan q(memory + i * from.columns(), from.columns());
      found[i] = self.project(q, {.share = share, .maxIterations = maxIterations}, workspace);
    }
  });
  return py::make_tuple(numbers.attr("reshape")(from.rows(), from.columns()),
                        flags.attr("view")("bool"));
}

py::object residuals(const Projection& self, const py::object& q) {
  const Table at = vectorOf(self, q, "q");
  Eigen::VectorXd values(self.rows());
  Projection::Workspace workspace(self);
  self.residuals(read(at), values, workspace);
  return makeArray(ConfigurationView(values));
}

py::object jacobian(const Projection& self, const py::object& q) {
  const Table at = vectorOf(self, q, "q");
  Eigen::MatrixXd derivatives(self.rows(), self.degreesOfFreedom());
  Projection::Workspace workspace(self);
  self.jacobian(read(at), derivatives, workspace);
  return makeArray(derivatives);
}

void bindProjection(py::module_& module) {
  const ConstraintProjectionOptions usual;
  py::class_<Projection> type(
      module, "ConstraintProjection",
      "Brings configurations to where the constraints of a checker hold. It finds them by numbers "
      "and proves nothing: Checker.check_state does.\nIt ignores collisions. Any number of threads "
      "may use one.");
  type.def(py::init([](const CheckerHandle& checker) { return Projection(checker.checker()); }),
           py::arg("checker"), "Of a checker with constraints.")
      .def_property_readonly("dimension", &Projection::dimension, "Of a configuration.")
      .def_property_readonly("degrees_of_freedom", &Projection::degreesOfFreedom,
                             "One for each value, but three for the four of a quaternion.")
      .def_property_readonly("rows", &Projection::rows,
                             "The number of values that the constraints limit.")
      .def(
          "within",
          [](const Projection& self, const py::object& lower, const py::object& upper) {
            const Table low = vectorOf(self, lower, "lower"), high = vectorOf(self, upper, "upper");
            return self.within(read(low), read(high));
          },
          py::arg("lower"), py::arg("upper"),
          "The same with tighter limits (n,), rad or m. Raises ArgumentError if no value is left.")
      .def(
          "used_share",
          [](const Projection& self, const py::object& q) {
            const Table at = vectorOf(self, q, "q");
            Projection::Workspace workspace(self);
            return self.usedShare(read(at), workspace);
          },
          py::arg("q"),
          "The largest share of a tolerance that q (n,) uses, up to rounding: at most 1 where all "
          "constraints hold; inf without a pose.")
      .def("project", &project, py::arg("q"), py::kw_only(), py::arg("share") = usual.share,
           py::arg("max_iterations") = usual.maxIterations,
           "(n,) configuration near q (n,) in which no constraint uses more of its tolerance than "
           "`share`, in (0, 1), or a tenth of the rest more,\nwithin limits. None if it finds none "
           "from q, which proves nothing.")
      .def("project_states", &projectStates, py::arg("states"), py::kw_only(),
           py::arg("share") = usual.share, py::arg("max_iterations") = usual.maxIterations,
           py::arg("seconds") = py::none(), py::arg("cancel") = py::none(),
           "The same for states (m, n): a pair of the new ones (m, n), and (m,) bool, whether each "
           "was found; one that was not is the best one\nthat it came to. `seconds`, `cancel` and "
           "Ctrl-C as in Checker.check_states.")
      .def(
          "residuals", &residuals, py::arg("q"),
          "(rows,) the limited values at q (n,), each as a signed share of its tolerance; 0 is the "
          "middle.")
      .def("jacobian", &jacobian, py::arg("q"),
           "(rows, degrees_of_freedom) derivatives of `residuals` per rad or m.")
      .def("__repr__", [](const Projection& self) {
        return "<swept.ConstraintProjection of " + std::to_string(self.rows()) + " rows, " +
               std::to_string(self.dimension()) + " values>";
      });
  addImmutableCopies(type);
}

}  // namespace

ConstraintFrame frameOf(const py::object& value, const char* argument) {
  if (value.is_none()) return {};
  if (py::isinstance<py::str>(value)) return {.body = value.cast<std::string>()};
  if (py::isinstance<py::sequence>(value) && py::len(value) == 2) {
    const py::object body = value[py::int_(0)], pose = value[py::int_(1)];
    if (py::isinstance<py::str>(body))
      return {.body = body.cast<std::string>(), .body_from_frame = readPose(pose, argument)};
  }
  throw ArgumentTypeError(std::string(argument) +
                          ": expected the name of a link or an attached body, or a pair of it and "
                          "a pose (4, 4); got " +
                          std::string(py::repr(value)));
}

void bindConstraints(py::module_& module) {
  bindRegion(module);
  bindJoint(module);
  bindPosition(module);
  bindOrientation(module);
  bindAxis(module);
  bindViolation(module);
  bindTask(module);
}

void bindProjections(py::module_& module) {
  bindProjection(module);
}

}  // namespace swept::python
