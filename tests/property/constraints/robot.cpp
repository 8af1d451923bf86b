// SPDX-License-Identifier: BSD-3-Clause
#include "robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace constraints {

namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;

Mat crossOf(const Vec& v) {
  Mat m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The frame of a planar joint: by the least turn from z to the normal.
Mat planeOf(const Vec& normal) {
  const Vec z = Vec::UnitZ();
  const Vec about = z.cross(normal);
  const Real sine = about.norm();
  if (sine < 1e-15L) {
    Mat m = Mat::Identity();
    if (normal.z() < 0) m.diagonal() << 1, -1, -1;
    return m;
  }
  return turnAbout(about / sine, std::atan2(sine, normal.z()));
}

Vec unit(const Eigen::Vector3d& axis) {
  return axis.cast<Real>().normalized();
}

/// x, y, z, w.
Mat turnOf(Real x, Real y, Real z, Real w) {
  const Real length = std::sqrt(x * x + y * y + z * z + w * w);
  const Vec v = Vec(x, y, z) / length;
  w /= length;
  return Mat::Identity() + 2 * w * crossOf(v) + 2 * crossOf(v) * crossOf(v);
}

}  // namespace

Mat turnAbout(const Vec& axis, Real angle) {
  const Mat k = crossOf(axis);
  return Mat::Identity() + std::sin(angle) * k + (1 - std::cos(angle)) * k * k;
}

double Random::logUniform(double low, double high) {
  return std::exp(uniform(std::log(low), std::log(high)));
}

Eigen::Vector3d Random::direction() {
  for (;;) {
    const Eigen::Vector3d v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
  }
}

std::string RandomRobot::urdf() const {
  static constexpr const char* kNames[] = {"revolute", "continuous", "prismatic",
                                           "fixed",    "planar",     "floating"};
  std::ostringstream text;
  text.precision(17);
  const auto vector = [&](const Eigen::Vector3d& v) {
    text << "'" << v.x() << ' ' << v.y() << ' ' << v.z() << "'";
  };
  text << "<robot name='random'><link name='l0'/>";
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const RobotJoint& joint = joints[i];
    text << "<link name='l" << i + 1 << "'/><joint name='j" << i << "' type='"
         << kNames[static_cast<int>(joint.type)] << "'><parent link='l" << joint.parent
         << "'/><child link='l" << i + 1 << "'/><origin xyz=";
    vector(joint.place);
    text << " rpy=";
    vector(joint.rpy);
    text << "/>";
    if (joint.type != Type::Fixed && joint.type != Type::Floating) {
      text << "<axis xyz=";
      vector(joint.axis);
      text << "/>";
    }
    if (joint.type == Type::Revolute || joint.type == Type::Prismatic)
      text << "<limit lower='" << joint.lower << "' upper='" << joint.upper
           << "' effort='1' velocity='1'/>";
    if (joint.master >= 0)
      text << "<mimic joint='j" << joint.master << "' multiplier='" << joint.multiplier
           << "' offset='" << joint.offset << "'/>";
    text << "</joint>";
  }
  text << "</robot>";
  return text.str();
}

Pose RandomRobot::poseOf(int link, const std::vector<Real>& q) const {
  if (link == 0) return {};
  const RobotJoint& joint = joints[static_cast<std::size_t>(link - 1)];
  const Vec rpy = joint.rpy.cast<Real>();
  Pose origin;
  origin.turn = turnAbout(Vec::UnitZ(), rpy.z()) * turnAbout(Vec::UnitY(), rpy.y()) *
                turnAbout(Vec::UnitX(), rpy.x());
  origin.place = joint.place.cast<Real>();
  const RobotJoint& source =
      joint.master < 0 ? joint : joints[static_cast<std::size_t>(joint.master)];
  const Real* own = source.first < 0 ? nullptr : q.data() + source.first;
  const Vec axis = unit(joint.axis);
  Pose moved;
  switch (joint.type) {
    case Type::Revolute:
    case Type::Continuous:
      moved.turn = turnAbout(axis, joint.multiplier * own[0] + joint.offset);
      break;
    case Type::Prismatic:
      moved.place = (joint.multiplier * own[0] + joint.offset) * axis;
      break;
    case Type::Planar:
      moved.place = planeOf(axis) * Vec(own[0], own[1], 0);
      moved.turn = turnAbout(axis, own[2]) * Mat::Identity();
      break;
    case Type::Floating:
      moved.place = Vec(own[0], own[1], own[2]);
      moved.turn = turnOf(own[3], own[4], own[5], own[6]);
      break;
    case Type::Fixed:
      break;
  }
  return poseOf(joint.parent, q) * origin * moved;
}

std::vector<Real> RandomRobot::between(const std::vector<double>& from,
                                       const std::vector<double>& to, Real t) const {
  std::vector<Real> q(from.size());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] = from[i] + t * (Real(to[i]) - from[i]);
  for (const RobotJoint& joint : joints) {
    if (joint.first < 0) continue;
    const auto first = static_cast<std::size_t>(joint.first);
    if (joint.type == Type::Continuous || joint.type == Type::Planar) {
      const std::size_t i = joint.type == Type::Planar ? first + 2 : first;
      q[i] = from[i] + t * std::remainder(Real(to[i]) - from[i], 2 * kPi);
    } else if (joint.type == Type::Floating) {
      Eigen::Matrix<Real, 4, 1> a, b;
      for (int k = 0; k < 4; ++k) {
        a[k] = from[first + 3 + static_cast<std::size_t>(k)];
        b[k] = to[first + 3 + static_cast<std::size_t>(k)];
      }
      a.normalize();
      b.normalize();
      if (a.dot(b) < 0) b = -b;
      const Real angle = std::atan2((a - b).norm() / 2, (a + b).norm() / 2) * 2;
      const Eigen::Matrix<Real, 4, 1> c =
          angle < 1e-12L
              ? Eigen::Matrix<Real, 4, 1>((1 - t) * a + t * b)
              : Eigen::Matrix<Real, 4, 1>(
                    (std::sin((1 - t) * angle) * a + std::sin(t * angle) * b) / std::sin(angle));
      for (int k = 0; k < 4; ++k) q[first + 3 + static_cast<std::size_t>(k)] = c[k];
    }
  }
  return q;
}

RandomRobot makeRobot(Random& random) {
  RandomRobot robot;
  const bool right = random.chance(0.5);  // axes and frames along x, y and z
  const int count = 1 + random.below(8);
  const bool far = random.chance(0.03);
  for (int i = 0; i < count; ++i) {
    RobotJoint joint;
    const double kind = random.uniform(0.0, 1.0);
    joint.type = kind < 0.55   ? Type::Revolute
                 : kind < 0.75 ? Type::Continuous
                 : kind < 0.9  ? Type::Prismatic
                               : Type::Fixed;
    if (i == 0 && random.chance(0.2))
      joint.type = random.chance(0.6) ? Type::Planar : Type::Floating;
    joint.parent = random.chance(0.85) ? i : random.below(i + 1);
    joint.place = 0.4 * random.uniform(0.0, 1.0) * random.direction();
    if (i == 0 && far) joint.place = 1e6 * random.direction();
    if (right)
      for (double& angle : joint.rpy) angle = 0.5 * std::numbers::pi * random.below(4);
    else
      joint.rpy = random.uniform(0.0, 3.0) * random.direction();
    joint.axis =
        right ? Eigen::Vector3d(Eigen::Vector3d::Unit(random.below(3))) : random.direction();
    if (joint.type == Type::Planar) joint.axis = Eigen::Vector3d::UnitZ();
    const bool slides = joint.type == Type::Prismatic;
    joint.lower = slides ? -1.0 : -3.0;
    joint.upper = slides ? 1.0 : 3.0;
    int master = -1;
    for (int k = 0; k < i; ++k) {
      const RobotJoint& other = robot.joints[static_cast<std::size_t>(k)];
      if (other.type == Type::Revolute && other.master < 0) master = k;
    }
    if (joint.type == Type::Revolute && master >= 0 && random.chance(0.15)) {
      joint.master = master;
      joint.multiplier = random.uniform(-1.0, 1.0);
      joint.offset = random.uniform(-0.5, 0.5);
      joint.lower = -10.0;
      joint.upper = 10.0;
    } else if (joint.type != Type::Fixed) {
      joint.first = robot.values;
      robot.values += joint.type == Type::Planar ? 3 : joint.type == Type::Floating ? 7 : 1;
    }
    robot.size = std::max(robot.size, joint.place.norm());
    robot.joints.push_back(joint);
  }
  if (robot.values == 0) return makeRobot(random);
  return robot;
}

}  // namespace constraints
