// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "enums.hpp"
#include "errors.hpp"
#include "handles.hpp"
#include "loading.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"
#include "swept/robot_model/trajectory_file.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Values = std::vector<double> TrajectoryPoint::*;

JointTrajectory makeTrajectory(const std::vector<std::string>& names, const py::object& times,
                               const py::object& positions, const py::object& velocities,
                               const py::object& accelerations) {
  JointTrajectory trajectory;
  trajectory.variables = names;
  const Table at = readVector(times, "times", 0);
  trajectory.points.resize(at.columns());
  for (std::size_t i = 0; i < at.columns(); ++i) trajectory.points[i].time = at.numbers()[i];
  const auto fill = [&](const py::object& values, const char* argument, Values member) {
    if (values.is_none()) return;
    const Table table = readTable(values, argument, names.size());
    if (table.rows() != at.columns())
      throw std::invalid_argument(std::string(argument) + ": expected a row for each of times, " +
                                  std::to_string(at.columns()) + "; got " +
                                  std::to_string(table.rows()));
    for (std::size_t i = 0; i < table.rows(); ++i)
      (trajectory.points[i].*member).assign(table.row(i).begin(), table.row(i).end());
  };
  fill(positions, "positions", &TrajectoryPoint::positions);
  fill(velocities, "velocities", &TrajectoryPoint::velocities);
  fill(accelerations, "accelerations", &TrajectoryPoint::accelerations);
  controllerCurve(trajectory);  // throws for what is no trajectory
  return trajectory;
}

/// A row for each point; NaN where one has none, None if none has any.
py::object valuesOf(const JointTrajectory& self, Values member) {
  std::vector<std::vector<double>> rows;
  bool any = false;
  for (const TrajectoryPoint& point : self.points) {
    rows.push_back(point.*member);
    any = any || !rows.back().empty();
    rows.back().resize(self.variables.size(), std::numeric_limits<double>::quiet_NaN());
  }
  if (!any) return py::none();
  return makeArray(rows, self.variables.size());
}

std::vector<JointTrajectory> load(const std::filesystem::path& file, const CheckerHandle& checker) {
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor({});
  std::vector<JointTrajectory> read;
  {
    const py::gil_scoped_release others;
    const Checker& of = checker.checker();
    read = readTrajectories(file, of.robot(), of.group(), of.options().reference, options);
  }
  remarks.warn();
  return read;
}

void bindTrajectory(py::module_& module) {
  py::class_<JointTrajectory> type(
      module, "Trajectory",
      "What a trajectory controller is given: points with times. Between two, each value follows a "
      "straight line; with velocities a\ncubic, with accelerations a quintic. Immutable.");
  type.def(py::init(&makeTrajectory), py::arg("variable_names"), py::arg("times"),
           py::arg("positions"), py::arg("velocities") = py::none(),
           py::arg("accelerations") = py::none(),
           "`times`: (m,) s, increasing. `positions`, `velocities`, `accelerations`: (m, n) rad or "
           "m, "
           "and per s and s^2.")
      .def_static(
          "load", &load, py::arg("file"), py::arg("checker"),
          "A list of the trajectories in a file: .csv, .yaml as ROS prints messages, or .json. "
          "Values are in the order of the\nchecker's group. Raises InputError.")
      .def(
          "save",
          [](const JointTrajectory& self, const std::filesystem::path& file) {
            writeTrajectory(file, self);
          },
          py::arg("file"),
          "Writes a .csv, .yaml (trajectory_msgs/JointTrajectory) or .json file. "
          "Raises UsageError.")
      .def_property_readonly(
          "variable_names",
          [](const JointTrajectory& self) { return py::tuple(py::cast(self.variables)); },
          "In the order of the columns.")
      .def_property_readonly(
          "times",
          [](const JointTrajectory& self) {
            std::vector<double> times;
            for (const TrajectoryPoint& point : self.points) times.push_back(point.time);
            return makeArray(times);
          },
          "(m,) s.")
      .def_property_readonly(
          "positions",
          [](const JointTrajectory& self) { return valuesOf(self, &TrajectoryPoint::positions); },
          "(m, n) rad or m.")
      .def_property_readonly(
          "velocities",
          [](const JointTrajectory& self) { return valuesOf(self, &TrajectoryPoint::velocities); },
          "(m, n) rad/s or m/s, NaN where a point has none; None if no point has any.")
      .def_property_readonly(
          "accelerations",
          [](const JointTrajectory& self) {
            return valuesOf(self, &TrajectoryPoint::accelerations);
          },
          "(m, n) rad/s^2 or m/s^2, likewise.")
      .def_property_readonly(
          "curve", [](const JointTrajectory& self) { return controllerCurve(self); },
          "Curve that ros2_control's joint_trajectory_controller makes of it.")
      .def("__len__", [](const JointTrajectory& self) { return self.points.size(); })
      .def("__repr__", [](const JointTrajectory& self) {
        return "<swept.Trajectory of " + std::to_string(self.points.size()) + " points>";
      });
  addImmutableCopies(type);
}

PiecewisePolynomial makeCurve(const py::object& knots, const py::object& coefficients) {
  std::vector<Eigen::MatrixXd> pieces;
  for (const py::handle piece : coefficients) {
    const Table table = readTable(piece, "coefficients", 0);
    pieces.emplace_back(
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            table.numbers().data(), static_cast<Eigen::Index>(table.rows()),
            static_cast<Eigen::Index>(table.columns())));
  }
  const Table times = readVector(knots, "knots", 0);
  return {{times.numbers().begin(), times.numbers().end()}, std::move(pieces)};
}

PiecewisePolynomial makeSpline(int degree, const py::object& knots, const py::object& points) {
  const Table times = readVector(knots, "knots", 0), table = readTable(points, "control_points", 0);
  const Eigen::MatrixXd columns = Eigen::Map<const Eigen::MatrixXd>(
      table.numbers().data(), static_cast<Eigen::Index>(table.columns()),
      static_cast<Eigen::Index>(table.rows()));
  return PiecewisePolynomial::bSpline(degree, {times.numbers().begin(), times.numbers().end()},
                                      columns);
}

void bindCurve(py::module_& module) {
  using Curve = PiecewisePolynomial;
  py::class_<Curve> type(
      module, "Curve",
      "A curve q(t), t in s: between two knots each value is a polynomial. Immutable.");
  type.def(py::init(&makeCurve), py::arg("knots"), py::arg("coefficients"),
           "`knots`: (pieces + 1,) s. `coefficients`: for each piece its Bernstein coefficients, "
           "(n, "
           "degree + 1) rad or m.")
      .def_static(
          "b_spline", &makeSpline, py::arg("degree"), py::arg("knots"), py::arg("control_points"),
          "The curve of a B-spline: `control_points` (m, n) rad or m, `knots` (m + degree + 1,) "
          "s, not descending.")
      .def_property_readonly("dimension", &Curve::dimension, "Number of values.")
      .def_property_readonly(
          "knots", [](const Curve& self) { return makeArray(self.knots()); }, "(pieces + 1,) s.")
      .def_property_readonly("duration", &Curve::duration, "s.")
      .def(
          "position",
          [](const Curve& self, double t) {
            return makeArray(ConfigurationView(self.position(t)));
          },
          py::arg("t"), "(n,) rad or m at t (s); beyond the ends, at the nearest end.")
      .def(
          "velocity",
          [](const Curve& self, double t) {
            return makeArray(ConfigurationView(self.velocity(t)));
          },
          py::arg("t"), "(n,) rad/s or m/s at t (s).")
      .def(
          "acceleration",
          [](const Curve& self, double t) {
            return makeArray(ConfigurationView(self.acceleration(t)));
          },
          py::arg("t"), "(n,) rad/s^2 or m/s^2 at t (s).")
      .def("__repr__", [](const Curve& self) {
        return "<swept.Curve of " + std::to_string(self.pieces()) + " pieces, " +
               std::string(py::str(py::float_(self.duration()))) + " s>";
      });
  addImmutableCopies(type);
}

/// A time of a curve that may be missing.
py::object timeOf(const std::optional<TrajectoryPlace>& place) {
  if (!place) return py::none();
  return py::float_(place->time);
}

void bindCertificate(py::module_& module) {
  py::class_<LimitViolation> violation(module, "LimitViolation",
                                       "A curve leaves a limit: the largest excess of a variable.");
  violation
      .def_property_readonly(
          "kind", [](const LimitViolation& self) { return toPython(self.kind); },
          "LimitKind: of which limit.")
      .def_readonly("variable", &LimitViolation::variable, "Its name.")
      .def_readonly("time", &LimitViolation::time, "s.")
      .def_readonly("value", &LimitViolation::value, "rad or m, and per s, s^2 or s^3; at `time`.")
      .def_readonly("limit", &LimitViolation::limit, "Likewise.");
  addRepr(violation, {"variable", "kind", "time", "value", "limit"});

  py::class_<TrajectoryClearance> clearance(module, "TrajectoryClearance",
                                            "Least distance over a curve of some pairs.");
  clearance.def_readonly("lower", &TrajectoryClearance::lower, "m, proven for every time.")
      .def_readonly("upper", &TrajectoryClearance::upper, "m, attained at `time`; inf: unknown.")
      .def_readonly("time", &TrajectoryClearance::time, "s.")
      .def_property_readonly(
          "body_a", [](const TrajectoryClearance& self) { return self.bodyA.str(); },
          "Of the pair that attains it; empty without one.")
      .def_property_readonly(
          "body_b", [](const TrajectoryClearance& self) { return self.bodyB.str(); }, "Likewise.");
  addRepr(clearance, {"lower", "upper", "time", "body_a", "body_b"});

  using Certificate = TrajectoryCertificate;
  py::class_<Certificate> type(
      module, "TrajectoryCertificate",
      "What is known about a whole curve in time. True if the verdict is FREE.");
  type.def_property_readonly(
          "verdict", [](const Certificate& self) { return toPython(self.verdict); },
          "Verdict of the whole curve, and of all that the tracking tolerance allows.")
      .def_readonly("free_until", &Certificate::freeUntil, "s: until then all is free.")
      .def_property_readonly(
          "witness",
          [](const Certificate& self) -> py::object {
            if (!self.contact) return py::none();
            return py::cast(self.contact->witness);
          },
          "Witness of the contact, exactly if the verdict is COLLISION; its t is the share of the "
          "duration. Else None.")
      .def_property_readonly(
          "contact_time",
          [](const Certificate& self) {
            return self.contact ? timeOf(*self.contact) : timeOf(std::nullopt);
          },
          "s, of the contact; else None.")
      .def_property_readonly(
          "contact_configuration",
          [](const Certificate& self) -> py::object {
            if (!self.contact) return py::none();
            return makeArray(ConfigurationView(self.contact->configuration));
          },
          "(n,) that of the contact; else None.")
      .def_property_readonly(
          "violation",
          [](const Certificate& self) -> py::object {
            if (!self.violation) return py::none();
            return py::cast(self.violation->violation);
          },
          "ConstraintViolation, exactly if the verdict is VIOLATION; its t is the share of the "
          "duration. Else None.")
      .def_property_readonly(
          "violation_time",
          [](const Certificate& self) {
            return self.violation ? timeOf(*self.violation) : timeOf(std::nullopt);
          },
          "s, of that; else None.")
      .def_property_readonly(
          "undecided_at", [](const Certificate& self) { return timeOf(self.undecided); },
          "s, where the first interval begins that could not be proven, exactly if the verdict is "
          "UNDECIDED; else None.")
      .def_property_readonly(
          "violations",
          [](const Certificate& self) { return py::tuple(py::cast(self.violations)); },
          "A LimitViolation for each variable and kind of limit that the curve leaves.")
      .def_readonly("world", &Certificate::world,
                    "TrajectoryClearance of pairs with the world, if it was asked for.")
      .def_readonly("self_pairs", &Certificate::self,
                    "Likewise, of pairs of the robot's own bodies.")
      .def_readonly("effort", &Certificate::effort, "Effort that the answer took.")
      .def("__bool__", [](const Certificate& self) { return self.verdict == Verdict::Free; })
      .def("__repr__", [](const Certificate& self) {
        return "<swept.TrajectoryCertificate " + std::string(toString(self.verdict)) +
               ", free until " + std::string(py::str(py::float_(self.freeUntil))) + " s, " +
               std::to_string(self.violations.size()) + " limits left>";
      });
  addImmutableCopies(type);
}

std::vector<std::string> variablesOf(const Checker& checker) {
  std::vector<std::string> names;
  for (const int variable : checker.group().variables)
    names.push_back(checker.robot().variables()[static_cast<std::size_t>(variable)].name);
  return names;
}

TrajectoryCertificate certify(const CheckerHandle& self, const py::object& trajectory,
                              const RateLimits* limits, double clock, bool clearances,
                              const py::object& query) {
  const PiecewisePolynomial curve = curveOf(trajectory, "trajectory", variablesOf(self.checker()));
  const TrajectoryQuery how = queryOf(limits, clock, clearances, query);
  const py::gil_scoped_release others;
  Workspace workspace(self.checker());
  return self.checker().certifyTrajectory(curve, workspace, how);
}

RateLimits makeLimits(const CheckerHandle& checker, const py::object& velocity,
                      const py::object& acceleration, const py::object& jerk) {
  return limitsOf(RateLimits::of(checker.checker().robot(), checker.checker().group()), velocity,
                  acceleration, jerk);
}

void bindLimits(py::module_& module) {
  py::class_<RateLimits> type(
      module, "RateLimits", "Limits of a group's joints for curves in time; inf: none. Immutable.");
  type.def(py::init(&makeLimits), py::arg("checker"), py::kw_only(),
           py::arg("velocity") = py::none(), py::arg("acceleration") = py::none(),
           py::arg("jerk") = py::none(),
           "Velocities of the URDF, unless given. Each is a number for all variables of the "
           "checker's "
           "group, or (n,).")
      .def_static(
          "load",
          [](const std::filesystem::path& file, const CheckerHandle& checker) {
            Remarks remarks;
            const RateLimits limits = RateLimits::read(
                file, checker.checker().robot(), checker.checker().group(), remarks.optionsFor({}));
            remarks.warn();
            return limits;
          },
          py::arg("file"), py::arg("checker"),
          "Velocities of the URDF, changed as MoveIt's joint_limits.yaml says. Raises "
          "InputError.")
      .def_property_readonly(
          "velocity", [](const RateLimits& self) { return makeArray(self.velocity); },
          "(n,) rad/s or m/s.")
      .def_property_readonly(
          "acceleration", [](const RateLimits& self) { return makeArray(self.acceleration); },
          "(n,) rad/s^2 or m/s^2.")
      .def_property_readonly(
          "jerk", [](const RateLimits& self) { return makeArray(self.jerk); },
          "(n,) rad/s^3 or m/s^3.");
  addRepr(type, {"velocity", "acceleration", "jerk"});
  addImmutableCopies(type);
}

}  // namespace

PiecewisePolynomial curveOf(const py::object& trajectory, const char* argument) {
  if (py::isinstance<JointTrajectory>(trajectory))
    return controllerCurve(trajectory.cast<const JointTrajectory&>());
  if (py::isinstance<PiecewisePolynomial>(trajectory))
    return trajectory.cast<const PiecewisePolynomial&>();
  throw ArgumentTypeError(std::string(argument) +
                          ": expected a swept.Trajectory or a swept.Curve, got " +
                          std::string(py::repr(trajectory)));
}

PiecewisePolynomial curveOf(const py::object& trajectory, const char* argument,
                            const std::vector<std::string>& variables) {
  if (py::isinstance<JointTrajectory>(trajectory)) {
    const std::vector<std::string>& own = trajectory.cast<const JointTrajectory&>().variables;
    const auto listed = [](const std::vector<std::string>& names) {
      std::string text;
      for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
      return text;
    };
    if (own != variables)
      throw std::invalid_argument(std::string(argument) + ": expected the variables " +
                                  listed(variables) + ", in this order; got " + listed(own));
  }
  return curveOf(trajectory, argument);
}

TrajectoryQuery queryOf(const RateLimits* limits, double clock, bool clearances,
                        const py::object& contact) {
  TrajectoryQuery query{
      .contact = contact.is_none() ? MotionQuery::FirstContact : motionQueryOf(contact, "query"),
      .clock = clock,
      .limits = {},
      .clearances = clearances};
  if (limits != nullptr) query.limits = *limits;
  return query;
}

RateLimits limitsOf(RateLimits limits, const py::object& velocity, const py::object& acceleration,
                    const py::object& jerk) {
  const auto take = [](std::vector<double>& values, const py::object& given, const char* argument) {
    if (given.is_none()) return;
    if (PyFloat_Check(given.ptr()) || PyLong_Check(given.ptr())) {
      values.assign(values.size(), given.cast<double>());
      return;
    }
    const Table table = readVector(given, argument, values.size());
    values.assign(table.numbers().begin(), table.numbers().end());
  };
  take(limits.velocity, velocity, "velocity");
  take(limits.acceleration, acceleration, "acceleration");
  take(limits.jerk, jerk, "jerk");
  return limits;
}

void bindTrajectories(py::module_& module) {
  bindLimits(module);
  bindCurve(module);
  bindTrajectory(module);
  bindCertificate(module);
  py::class_<CheckerHandle>(module.attr("Checker"))
      .def("certify_trajectory", &certify, py::arg("trajectory"), py::kw_only(),
           py::arg("limits") = nullptr, py::arg("clock") = 0.0, py::arg("clearances") = false,
           py::arg("query") = py::none(),
           "TrajectoryCertificate: what is proven about the whole curve of a Trajectory or Curve, "
           "in "
           "the checker's tube. `limits`:\nRateLimits to look at. `clock`: s, what moving "
           "obstacles' "
           "clock shows at time 0. `clearances`: whether to compute least\ndistances. `query`: "
           "MotionQuery, by default FIRST_CONTACT. Raises ArgumentError for a Trajectory of other "
           "variables than the group's, in its order.");
}

}  // namespace swept::python
