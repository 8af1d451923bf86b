// SPDX-License-Identifier: BSD-3-Clause
#include "errors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace trajectories {

namespace {

using swept::JointType;
using State = std::vector<double>;

/// Displaced values round.
constexpr double kWithin = 1.0 - 1e-12;

/// A share of the tolerance, from -1 to 1.
double shareOf(Error error, Random& random) {
  switch (error) {
    case Error::None:
      return 0.0;
    case Error::Corner:
      return random.sign();
    case Error::Plus:
      return 1.0;
    case Error::Inside:
      return random.uniform(-1.0, 1.0);
  }
  return 0.0;
}

void slide(const StageVariable& limits, double by, double& value) {
  value = std::clamp(value + by, std::min(value, limits.lower), std::max(value, limits.upper));
}

void turn(double angle, const Eigen::Vector3d& axis, double* quaternion) {
  Eigen::Map<Eigen::Quaterniond> orientation(quaternion);  // x, y, z, w
  orientation = Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)) * orientation;
}

}  // namespace

void displace(const Stage& stage, Error error, Random& random, State& q) {
  for (const StageJoint& joint : stage.joints) {
    const double rotation = kWithin * joint.tolerance.rotation * shareOf(error, random);
    const double translation = kWithin * joint.tolerance.translation * shareOf(error, random);
    double* const value = q.data() + joint.first;
    switch (joint.type) {
      case JointType::Revolute:
      case JointType::Continuous:
        *value += rotation;
        break;
      case JointType::Prismatic:
        slide(stage.variables[joint.first], translation, *value);
        break;
      case JointType::Planar: {
        const Eigen::Vector2d way = random.direction().head<2>().normalized() * translation;
        value[0] += way.x();
        value[1] += way.y();
        value[2] += rotation;
        break;
      }
      case JointType::Floating: {
        const Eigen::Vector3d way = random.direction() * translation;
        for (int i = 0; i < 3; ++i) value[i] += way[i];
        turn(rotation, random.direction(), value + 3);
        break;
      }
      case JointType::Fixed:
        break;
    }
  }
}

void displaceAgainst(const Stage& stage, const State& gradient, Random& random, State& q) {
  const auto down = [&gradient](std::size_t k, double tolerance) {
    return -kWithin * std::copysign(tolerance, gradient[k]);
  };
  for (const StageJoint& joint : stage.joints) {
    const std::size_t k = joint.first;
    const auto pushAlong = [&](std::size_t count) {
      const Eigen::Map<const Eigen::VectorXd> own(gradient.data() + k,
                                                  static_cast<Eigen::Index>(count));
      if (!(own.norm() > 0.0)) return;
      for (std::size_t i = 0; i < count; ++i)
        q[k + i] -= kWithin * joint.tolerance.translation * gradient[k + i] / own.norm();
    };
    switch (joint.type) {
      case JointType::Revolute:
      case JointType::Continuous:
        q[k] += down(k, joint.tolerance.rotation);
        break;
      case JointType::Prismatic:
        slide(stage.variables[k], down(k, joint.tolerance.translation), q[k]);
        break;
      case JointType::Planar:
        pushAlong(2);
        q[k + 2] += down(k + 2, joint.tolerance.rotation);
        break;
      case JointType::Floating:
        pushAlong(3);
        turn(kWithin * joint.tolerance.rotation, random.direction(), q.data() + k + 3);
        break;
      case JointType::Fixed:
        break;
    }
  }
}

double beyondTube(const Stage& stage, const State& q, const State& around) {
  double beyond = -1.0;
  const auto compare = [&beyond](double off, double tolerance) {
    beyond = std::max(beyond, off - tolerance);
  };
  for (const StageJoint& joint : stage.joints) {
    const std::size_t k = joint.first;
    const auto distance = [&](std::size_t count) {
      double squared = 0.0;
      for (std::size_t i = k; i < k + count; ++i)
        squared += (q[i] - around[i]) * (q[i] - around[i]);
      return std::sqrt(squared);
    };
    switch (joint.type) {
      case JointType::Revolute:
      case JointType::Continuous:
        compare(std::abs(q[k] - around[k]), joint.tolerance.rotation);
        break;
      case JointType::Prismatic:
        compare(std::abs(q[k] - around[k]), joint.tolerance.translation);
        break;
      case JointType::Planar:
        compare(distance(2), joint.tolerance.translation);
        compare(std::abs(q[k + 2] - around[k + 2]), joint.tolerance.rotation);
        break;
      case JointType::Floating: {
        compare(distance(3), joint.tolerance.translation);
        const Eigen::Quaterniond a(Eigen::Vector4d(q.data() + k + 3));
        const Eigen::Quaterniond b(Eigen::Vector4d(around.data() + k + 3));
        compare(a.normalized().angularDistance(b.normalized()), joint.tolerance.rotation);
        break;
      }
      case JointType::Fixed:
        break;
    }
  }
  return beyond;
}

}  // namespace trajectories
