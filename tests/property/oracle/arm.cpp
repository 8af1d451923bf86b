// SPDX-License-Identifier: BSD-3-Clause
#include "arm.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace oracle {
namespace {

constexpr double kPi = 3.14159265358979323846;

Eigen::Matrix3d rotation(const Vector3d& axis, double angle) {
  Eigen::Matrix3d k;
  k << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  return Eigen::Matrix3d::Identity() + std::sin(angle) * k + (1 - std::cos(angle)) * k * k;
}

/// x, y, z, w.
Eigen::Matrix3d rotation(Eigen::Vector4d q) {
  q.normalize();
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Eigen::Matrix3d r;
  r << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
      2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),   //
      2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
  return r;
}

Eigen::Vector4d quaternion(const std::vector<double>& q, int first) {
  return Eigen::Vector4d(q[first], q[first + 1], q[first + 2], q[first + 3]).normalized();
}

double shorterWay(double from, double to) {
  return std::remainder(to - from, 2 * kPi);
}

/// rad, the turn between two orientations.
double arc(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  const Eigen::Vector4d c = a.dot(b) < 0 ? Eigen::Vector4d(-b) : b;
  return 4 * std::atan2((a - c).norm(), (a + c).norm());
}

Eigen::Vector4d slerp(const Eigen::Vector4d& a, Eigen::Vector4d b, double t) {
  if (a.dot(b) < 0) b = -b;
  const double half = arc(a, b) / 2;
  if (half < 1e-9) return ((1 - t) * a + t * b).normalized();
  return ((std::sin((1 - t) * half) * a + std::sin(t * half) * b) / std::sin(half)).normalized();
}

}  // namespace

int Arm::link(const std::string& name) const {
  for (size_t i = 0; i < links_.size(); ++i)
    if (links_[i].name == name) return static_cast<int>(i);
  throw std::runtime_error("no link " + name);
}

bool Arm::disabled(const std::string& a, const std::string& b) const {
  return disabled_.count(std::minmax(a, b)) > 0;
}

std::set<std::string> Arm::groupVariables(const std::string& group) const {
  std::set<std::string> names;
  const auto found = groups_.find(group);
  if (found == groups_.end() && !(group == "all" && groups_.empty()))
    throw std::runtime_error("no group " + group);
  for (const ArmJoint& j : joints_) {
    if (j.variable < 0 || !j.mimics.empty()) continue;
    if (found != groups_.end() && !found->second.count(j.name)) continue;
    const int count = j.type == "planar" ? 3 : j.type == "floating" ? 7 : 1;
    for (int k = 0; k < count; ++k) names.insert(variables_[j.variable + k].name);
  }
  return names;
}

std::vector<double> Arm::home() const {
  std::vector<double> q;
  for (const ArmVariable& v : variables_)
    q.push_back(v.lower <= 0 && v.upper >= 0 ? 0.0 : (v.lower + v.upper) / 2);
  for (const ArmJoint& j : joints_)
    if (j.type == "floating") q[j.variable + 6] = 1;
  return q;
}

Isometry3d Arm::motion(const ArmJoint& j, const std::vector<double>& q) const {
  Isometry3d pose = Isometry3d::Identity();
  if (j.type == "fixed") return pose;
  if (j.type == "planar") {
    // The plane's own axes: x and y of the joint frame for the usual normal, z.
    pose.translation() = Vector3d(q[j.variable], q[j.variable + 1], 0);
    pose.linear() = rotation(Vector3d::UnitZ(), q[j.variable + 2]);
  } else if (j.type == "floating") {
    pose.translation() = Vector3d(q[j.variable], q[j.variable + 1], q[j.variable + 2]);
    pose.linear() = rotation(quaternion(q, j.variable + 3));
  } else {
    const double own = q[j.variable];
    const double value = j.mimics.empty() ? own : j.multiplier * own + j.offset;
    if (j.type == "prismatic")
      pose.translation() = value * j.axis;
    else
      pose.linear() = rotation(j.axis, value);
  }
  return pose;
}

void Arm::poses(const std::vector<double>& q, std::vector<Isometry3d>& model_from_link) const {
  model_from_link.assign(links_.size(), Isometry3d::Identity());
  for (const ArmJoint& j : joints_) {
    const Isometry3d base = j.parent < 0 ? Isometry3d::Identity() : model_from_link[j.parent];
    model_from_link[j.child] = base * j.parent_from_joint * motion(j, q);
  }
}

std::vector<double> Arm::between(const std::vector<double>& a, const std::vector<double>& b,
                                 double t) const {
  std::vector<double> q(a.size());
  for (size_t i = 0; i < a.size(); ++i)
    q[i] = a[i] + t * (variables_[i].cyclic ? shorterWay(a[i], b[i]) : b[i] - a[i]);
  for (const ArmJoint& j : joints_) {
    if (j.type != "floating") continue;
    const int r = j.variable + 3;
    const Eigen::Vector4d turned = slerp(quaternion(a, r), quaternion(b, r), t);
    for (int k = 0; k < 4; ++k) q[r + k] = turned[k];
  }
  return q;
}

double Arm::largestChange(const std::vector<double>& a, const std::vector<double>& b) const {
  double most = 0;
  for (const ArmJoint& j : joints_) {
    if (j.type == "fixed") continue;
    const int v = j.variable;
    auto delta = [&](int i) {
      return std::abs(variables_[i].cyclic ? shorterWay(a[i], b[i]) : b[i] - a[i]);
    };
    if (j.type == "floating")
      most = std::max(most, arc(quaternion(a, v + 3), quaternion(b, v + 3)));
    const int linear = j.type == "planar" || j.type == "floating" ? 3 : 1;
    for (int k = 0; k < linear; ++k)
      most = std::max(most, delta(v + k) * std::max(1.0, std::abs(j.multiplier)));
  }
  return most;
}

}  // namespace oracle
