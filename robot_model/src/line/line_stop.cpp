// SPDX-License-Identifier: BSD-3-Clause
#include "line/line_stop.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <vector>

#include <Eigen/SVD>

#include "kinematics/rotation_vector.hpp"
#include "robot/cyclic_values.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {

namespace detail {

namespace {

using Eigen::Isometry3d;
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Of the largest singular value. A pose that is h beyond reach, or that needs a jump, is at a
/// configuration whose least singular value is some sqrt(h), by the implicit function theorem: with
/// steps of 1e-5 of the arm's size 3e-3.
constexpr double kSingularShare = 2e-2;
/// rad or m. A value so near to its limit is at it.
constexpr double kAtLimit = 1e-9;

/// Without the rows that do not count.
Eigen::MatrixXd jacobianOf(const LineModel& model, std::span<const double> q, bool anyOrientation) {
  const Jacobian all = model.solver.jacobian(q);
  return anyOrientation ? Eigen::MatrixXd(all.topRows<3>()) : Eigen::MatrixXd(all);
}

/// What of an error no motion takes away, to first order.
double restOf(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& error) {
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(kSingularShare);
  return (error - jacobian * svd.solve(error)).norm();
}

/// The degree of freedom of each variable that a limit holds back from taking the error away.
struct Held {
  std::vector<Eigen::Index> columns;
  std::size_t variable = 0;  ///< of the group: the one that would move most
};

std::optional<Held> heldAtLimits(const LineModel& model, const Eigen::MatrixXd& jacobian,
                                 const Eigen::VectorXd& error, std::span<const double> q) {
  Held held;
  double most = 0.0;
  Eigen::Index column = 0;
  const Robot& robot = model.checker->robot();
  const Group& group = model.checker->group();
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Variable& variable = robot.variables()[static_cast<std::size_t>(group.variables[i])];
    if (isOrientation(robot, variable)) {
      // Three rotations stand for four components, which have no limits.
      const bool isFirst =
          i == 0 ||
          robot.variables()[static_cast<std::size_t>(group.variables[i - 1])].joint !=
              variable.joint ||
          !isOrientation(robot,
                         robot.variables()[static_cast<std::size_t>(group.variables[i - 1])]);
      if (isFirst) column += 3;
      continue;
    }
    const double wish = jacobian.col(column).dot(error);
    const bool atLimit = (wish > 0.0 && q[i] >= variable.upper - kAtLimit) ||
                         (wish < 0.0 && q[i] <= variable.lower + kAtLimit);
    if (atLimit && !variable.cyclic) {
      held.columns.push_back(column);
      if (std::abs(wish) > most) {
        most = std::abs(wish);
        held.variable = i;
      }
    }
    ++column;
  }
  if (held.columns.empty()) return std::nullopt;
  return held;
}

Eigen::VectorXd errorOf(const Isometry3d& actual, const Isometry3d& wanted, bool anyOrientation) {
  const Eigen::Vector3d place = wanted.translation() - actual.translation();
  if (anyOrientation) return place;
  Eigen::VectorXd error(6);
  error << place, rotationVectorOf(wanted.linear() * actual.linear().transpose());
  return error;
}

struct Singular {
  double least = 0.0;
  bool isSmall = false;
};

Singular singularOf(const Eigen::MatrixXd& jacobian) {
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(jacobian).singularValues();
  const double least = values[values.size() - 1];
  return {least, least <= kSingularShare * values[0]};
}

}  // namespace

ToolLineStop whyNotSolved(const LineModel& model, const Isometry3d& wanted,
                          std::span<const double> nearest, bool anyOrientation) {
  const Eigen::MatrixXd jacobian = jacobianOf(model, nearest, anyOrientation);
  const Eigen::VectorXd error = errorOf(model.solver.pose(nearest), wanted, anyOrientation);
  const Singular singular = singularOf(jacobian);
  ToolLineStop stop;
  stop.leastSingularValue = singular.least;
  stop.reason =
      singular.isSmall ? ToolLineStop::Reason::Singularity : ToolLineStop::Reason::Unreachable;
  if (const auto held = heldAtLimits(model, jacobian, error, nearest)) {
    Eigen::MatrixXd free = jacobian;
    for (const Eigen::Index column : held->columns) free.col(column).setZero();
    if (restOf(jacobian, error) < 0.5 * restOf(free, error)) {
      stop.reason = ToolLineStop::Reason::Limit;
      const Group& group = model.checker->group();
      stop.variable = model.checker->robot()
                          .variables()[static_cast<std::size_t>(group.variables[held->variable])]
                          .name;
    }
  }
  return stop;
}

ToolLineStop whyNotStraight(const LineModel& model, std::span<const double> wayPoint,
                            bool anyOrientation) {
  const Singular singular = singularOf(jacobianOf(model, wayPoint, anyOrientation));
  ToolLineStop stop;
  stop.leastSingularValue = singular.least;
  stop.reason = singular.isSmall ? ToolLineStop::Reason::Singularity : ToolLineStop::Reason::Jump;
  return stop;
}

double largestChange(const KinematicModel& model, std::span<const double> from,
                     std::span<const double> to) {
  double most = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i)
    most = std::max(
        most, std::abs(model.cyclic[i] != 0 ? cyclicDifference(from[i], to[i]) : to[i] - from[i]));
  return most;
}

}  // namespace detail

std::string toString(ToolLineStop::Reason reason) {
  using Reason = ToolLineStop::Reason;
  switch (reason) {
    case Reason::Limit:
      return "limit";
    case Reason::Singularity:
      return "singularity";
    case Reason::Jump:
      return "jump";
    case Reason::Unreachable:
      return "unreachable";
    case Reason::Contact:
      return "contact";
    case Reason::Violation:
      return "violation";
    case Reason::Undecided:
      break;
  }
  return "undecided";
}

std::string describe(const ToolLineStop& stop, const TaskConstraint& constraints) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return describe(stop, constraints); });
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(3);
  using Reason = ToolLineStop::Reason;
  text << toString(stop.reason) << " at " << stop.share << " of the line: ";
  switch (stop.reason) {
    case Reason::Limit:
      text << "'" << stop.variable << "' is at its limit";
      break;
    case Reason::Singularity:
    case Reason::Jump:
      text << "the least singular value of the tool's Jacobian is " << stop.leastSingularValue;
      if (stop.jointStep > 0.0)
        text << ", joints move by " << stop.jointStep << " per unit of the tool's way";
      break;
    case Reason::Unreachable:
      text << "no motion of the group takes the tool farther in this direction";
      break;
    case Reason::Contact:
      text << stop.contact->bodyA << " - " << stop.contact->bodyB;
      break;
    case Reason::Violation:
      text << describe(*stop.violation, constraints);
      break;
    case Reason::Undecided:
      text << "not proven beyond";
      break;
  }
  return text.str();
}

}  // namespace swept
