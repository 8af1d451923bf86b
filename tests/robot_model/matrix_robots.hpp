// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "swept/core/distance.hpp"
#include "swept/robot_model/allowed_collision_matrix.hpp"

/// Robots whose link pairs are looked at, and an oracle for single configurations that shares
/// nothing with what looks at them but the shapes' distance.
namespace swept::matrix_test {

inline std::string numbers(const Eigen::Vector3d& v) {
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}

inline std::string linkText(const std::string& name, const std::string& geometry,
                            const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  if (geometry.empty()) return "<link name='" + name + "'/>\n";
  return "<link name='" + name + "'><collision><origin xyz='" + numbers(origin) + "'/><geometry>" +
         geometry + "</geometry></collision></link>\n";
}

inline std::string ball(double radius) {
  return "<sphere radius='" + std::to_string(radius) + "'/>";
}

/// `limits`: "-1 1", or empty. `rest`: a mimic, say.
inline std::string jointText(const std::string& name, const std::string& type,
                             const std::string& parent, const std::string& child,
                             const std::string& limits = "", const std::string& origin = "0 0 0",
                             const std::string& axis = "0 0 1", const std::string& rest = "") {
  std::string text = "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
                     "'/><child link='" + child + "'/><origin xyz='" + origin + "'/>";
  if (type != "fixed" && type != "floating") text += "<axis xyz='" + axis + "'/>";
  if (!limits.empty()) {
    const auto blank = limits.find(' ');
    text += "<limit lower='" + limits.substr(0, blank) + "' upper='" + limits.substr(blank + 1) +
            "' effort='1' velocity='1'/>";
  }
  return text + rest + "</joint>\n";
}

inline std::shared_ptr<const Robot> robotOf(const std::string& parts) {
  return Robot::parse("<robot name='made'>\n" + parts + "</robot>", "made.urdf");
}

template <typename... Parts>
std::string joined(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// A chain of links that bend and slide about any axes; some of them fork off.
inline std::string randomChain(std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto vector = [&](double size) -> Eigen::Vector3d {
    return size * Eigen::Vector3d(2.0 * unit(random) - 1.0, 2.0 * unit(random) - 1.0,
                                  2.0 * unit(random) - 1.0);
  };
  std::string text;
  const int links = 6;
  for (int i = 0; i < links; ++i) {
    const double length = 0.1 + 0.25 * unit(random);
    const double width = 0.03 + 0.05 * unit(random);
    const std::string geometry =
        i % 2 == 0 ? joined("<box size='", width, " ", width, " ", length, "'/>")
                   : joined("<cylinder radius='", width, "' length='", length, "'/>");
    text += linkText(joined("l", i), geometry, {0.0, 0.0, 0.5 * length});
    if (i == 0) continue;
    const bool slides = unit(random) < 0.2;
    const bool forks = i > 2 && unit(random) < 0.3;
    const double range = slides ? 0.1 : 0.5 + 2.6 * unit(random);
    text +=
        jointText(joined("j", i), slides ? "prismatic" : "revolute",
                  joined("l", forks ? i - 2 : i - 1), joined("l", i), joined(-range, " ", range),
                  numbers(vector(0.06) + Eigen::Vector3d(0.0, 0.0, 0.1 + 0.7 * length)),
                  numbers(vector(1.0)));
  }
  return text;
}

/// Poses of all links, from the joints as the robot has them.
inline std::vector<Eigen::Isometry3d> linkPoses(const Robot& robot, const Eigen::VectorXd& q) {
  std::vector<Eigen::Isometry3d> poses(robot.links().size(), Eigen::Isometry3d::Identity());
  for (const Joint& joint : robot.joints()) {
    Eigen::Isometry3d pose = joint.parent_from_joint;
    const Joint& source = joint.mimic ? robot.joints()[joint.mimic->master] : joint;
    double value = source.firstVariable < 0 ? 0.0 : q[source.firstVariable];
    if (joint.mimic) value = joint.mimic->multiplier * value + joint.mimic->offset;
    if (joint.type == JointType::Revolute || joint.type == JointType::Continuous)
      pose.rotate(Eigen::AngleAxisd(value, joint.axis));
    if (joint.type == JointType::Prismatic) pose.translate(value * joint.axis);
    if (joint.parentLink >= 0) pose = poses[joint.parentLink] * pose;
    poses[joint.childLink] = pose;
  }
  return poses;
}

/// m, of two links; 0 in contact.
inline double linkDistance(const Robot& robot, int linkA, int linkB, const Eigen::VectorXd& q) {
  const auto poses = linkPoses(robot, q);
  double least = std::numeric_limits<double>::infinity();
  for (const CollisionGeometry& a : robot.links()[linkA].collision)
    for (const CollisionGeometry& b : robot.links()[linkB].collision) {
      const Eigen::Isometry3d a_from_b =
          (poses[linkA] * a.link_from_shape).inverse() * (poses[linkB] * b.link_from_shape);
      DistanceOptions options;
      options.enough = least;
      least = std::min(least, distance(a.shape, b.shape, a_from_b, options).upper);
    }
  return least;
}

inline Eigen::VectorXd randomState(const Robot& robot, std::mt19937& random) {
  Eigen::VectorXd q = robot.defaultState();
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t v = 0; v < robot.variables().size(); ++v) {
    const Variable& variable = robot.variables()[v];
    if (!std::isfinite(variable.upper - variable.lower)) continue;
    if (robot.joints()[variable.joint].type == JointType::Floating) continue;
    // Limits themselves are where robots are built to stop just short of contact.
    const double u = std::clamp(1.2 * unit(random) - 0.1, 0.0, 1.0);
    q[static_cast<Eigen::Index>(v)] = variable.lower + u * (variable.upper - variable.lower);
  }
  return q;
}

inline const LinkPairReport& reportOf(const Robot& robot,
                                      const std::vector<LinkPairReport>& reports,
                                      const std::string& a, const std::string& b) {
  const std::pair<int, int> links = std::minmax(*robot.findLink(a), *robot.findLink(b));
  for (const LinkPairReport& report : reports)
    if (report.linkA == links.first && report.linkB == links.second) return report;
  throw std::runtime_error("no report for " + a + " - " + b);
}

}  // namespace swept::matrix_test
