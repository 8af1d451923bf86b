// SPDX-License-Identifier: BSD-3-Clause
// Pages of trajectories with constraints, for constraints_page_browser.py:
// constraint_pages NAME --html FILE.html. Beside it, FILE.json has the value of each constraint at
// 1001 times, from poses of the library and by formulas that are here alone.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "swept/pages/page.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using nlohmann::json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::string kTool = "tool";
const std::string kArm = "link4";

/// A value of a constraint, and the most that it may be.
struct Value {
  double value, most;
};
/// At a configuration, with the poses of kTool and kArm in the model frame.
using Measure =
    std::function<Value(const Eigen::VectorXd&, const Isometry3d& tool, const Isometry3d& arm)>;

/// A constraint, and what it is about in other words.
struct Told {
  swept::TaskConstraint constraint;
  Measure measure;
};

Value worse(const Value& a, const Value& b) {
  return a.value / a.most < b.value / b.most ? b : a;
}

const Isometry3d kOff =
    Translation3d(0.05, -0.02, 0.1) * Eigen::AngleAxisd(0.7, Vector3d(2, -1, 2) / 3.0);

/// The tool's own z axis from a direction in the model frame.
Told leaning(double angle) {
  const Vector3d direction = Vector3d(0.8, 0.0, -0.6);
  return {{.axes = {{.frame = {.body = kTool}, .direction = 3.0 * direction, .angle = angle}}},
          [=](const Eigen::VectorXd&, const Isometry3d& tool, const Isometry3d&) -> Value {
            return {std::acos(tool.linear().col(2).dot(direction)), angle};
          }};
}

/// A point of the tool in a slanted cylinder, or in a ball that it never gets into.
Told held() {
  const Isometry3d place = Translation3d(0.3, 0.1, 0.4) * Eigen::AngleAxisd(0.4, Vector3d::UnitX());
  using Type = swept::ConstraintRegion::Type;
  return {{.positions = {{.frame = {.body = kTool, .body_from_frame = kOff},
                          .regions = {{.type = Type::Sphere, .size = {0.01, 0, 0}},
                                      {.type = Type::Cylinder,
                                       .size = {1.5, 4.0, 0},
                                       .reference_from_region = place}}}}},
          [=](const Eigen::VectorXd&, const Isometry3d& tool, const Isometry3d&) -> Value {
            const Vector3d p = place.inverse() * (tool * kOff.translation());
            return worse({std::hypot(p.x(), p.y()), 1.5}, {std::abs(p.z()), 2.0});
          }};
}

/// The tool seen from the arm, in a box without an end along y.
Told near() {
  return {{.positions = {{.frame = {.body = kTool},
                          .reference = {.body = kArm, .body_from_frame = kOff},
                          .regions = {{.size = {2.0, kInfinity, 3.0}}}}}},
          [](const Eigen::VectorXd&, const Isometry3d& tool, const Isometry3d& arm) -> Value {
            const Vector3d p = (arm * kOff).inverse() * tool.translation();
            return worse({std::abs(p.x()), 1.0}, {std::abs(p.z()), 1.5});
          }};
}

/// R = Rx(a) Ry(b) Rz(c): R(0, 2) = sin b, R(1, 2) = -sin a cos b.
Told turned(bool asVector) {
  const Eigen::Quaterniond wanted(Eigen::AngleAxisd(1.1, Vector3d(1, 0.5, -0.5).normalized()));
  using Parameterization = swept::OrientationConstraint::Parameterization;
  const Measure angles = [=](const Eigen::VectorXd&, const Isometry3d& tool,
                             const Isometry3d& arm) -> Value {
    const Eigen::Matrix3d r =
        wanted.conjugate().toRotationMatrix() * arm.linear().transpose() * tool.linear();
    const double b = std::asin(r(0, 2)), a = std::asin(-r(1, 2) / std::cos(b));
    return worse({std::abs(r(2, 2) < 0.0 ? std::copysign(M_PI, a) - a : a), 3.1},
                 {std::abs(b), 1.5});
  };
  const Measure vector = [=](const Eigen::VectorXd&, const Isometry3d& tool,
                             const Isometry3d& arm) -> Value {
    const Eigen::AngleAxisd turn(arm.linear().transpose() * tool.linear() *
                                 wanted.conjugate().toRotationMatrix());
    const Vector3d v = turn.angle() * turn.axis();
    return worse(worse({std::abs(v.x()), 3.0}, {std::abs(v.y()), 2.5}), {std::abs(v.z()), 3.05});
  };
  return {{.orientations = {{.frame = {.body = kTool},
                             .reference = {.body = kArm},
                             .orientation = wanted,
                             .tolerance = asVector ? Vector3d(3.0, 2.5, 3.05)
                                                   : Vector3d(3.1, 1.5, kInfinity),
                             .parameterization = asVector ? Parameterization::RotationVector
                                                          : Parameterization::EulerAngles}}},
          asVector ? vector : angles};
}

/// 1e-5 more counts as within.
Told bent() {
  return {{.joints = {{.joint = "joint4", .position = 1.5, .above = 0.5, .below = 0.75}}},
          [](const Eigen::VectorXd& q, const Isometry3d&, const Isometry3d&) -> Value {
            return {std::abs(q[3] - 1.5), (q[3] < 1.5 ? 0.75 : 0.5) + 1e-5};
          }};
}

void write(const std::filesystem::path& file, const std::vector<Told>& told) {
  const std::string name = "models/robots/rook7/rook7";
  swept::TaskConstraint task;
  for (const Told& own : told) task.add(own.constraint);
  swept::CheckerOptions options;
  options.constraints = task;
  const auto checker = std::make_shared<const swept::Checker>(
      swept::Robot::load(name + ".urdf", name + ".srdf"), "arm",
      std::make_shared<const swept::World>(), options);
  const std::vector<double> none(7, 0.0);
  const swept::PiecewisePolynomial curve =
      swept::controllerCurve({std::vector<std::string>(7, "v"),
                              {{0.5, {0.23, 0.53, 0.12, 1.44, 0.35, -0.73, 0.11}, none, none},
                               {1.5, {-0.1, -0.08, 0.93, 1.8, -0.66, 0.43, -0.29}, none, none},
                               {2.5, {-0.32, 0.78, 0.2, 1.2, 0.01, -0.77, -0.14}, none, none}}});
  swept::Page page(checker);
  page.addTrajectory("swing", curve);
  page.write(file);

  json all = {{"times", json::array()}, {"values", json::array()}, {"most", json::array()}};
  for (int i = 0; i <= 1000; ++i) {
    const double time = curve.begin() + curve.duration() * i / 1000;
    const Eigen::VectorXd q = curve.position(time);
    const auto pose = [&](const std::string& link) {
      return swept::linkPose(checker->robot(), "arm", link, q);
    };
    json values = json::array(), most = json::array();
    for (const Told& own : told) {
      const Value found = own.measure(q, pose(kTool), pose(kArm));
      values.push_back(found.value);
      most.push_back(found.most);
    }
    all["times"].push_back(time);
    all["values"].push_back(values);
    all["most"].push_back(most);
  }
  std::ofstream(std::filesystem::path(file).replace_extension(".json")) << all;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) return 2;
  // In the order of TaskConstraint: joints, positions, orientations, axes.
  if (std::string(argv[1]) == "kept")
    write(argv[3], {bent(), held(), near(), turned(false), turned(true), leaning(3.0)});
  else if (std::string(argv[1]) == "broken")
    write(argv[3], {leaning(0.95)});
  else if (std::string(argv[1]) == "none")
    write(argv[3], {});
  else
    return 2;
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
