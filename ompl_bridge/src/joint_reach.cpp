// SPDX-License-Identifier: BSD-3-Clause
#include "joint_reach.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "swept/core/bounding_sphere.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

namespace {

constexpr int kConfigurations = 8;
/// rad or m, from zero, of a value without limits.
constexpr double kFarthestTurn = std::numbers::pi;

/// A ball around all that a link has and carries, in the link's frame.
struct LinkBall {
  int link = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

/// Up to rounding, without a look at all vertices.
BoundingSphere ballAround(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return mesh->hull().ball();
  if (const auto* cloud = std::get_if<PointCloud>(&shape)) return cloud->hull().ball();
  return boundingSphere(shape);
}

std::optional<LinkBall> ballOf(const Checker& checker, int link) {
  std::vector<BoundingSphere> balls;
  const auto add = [&](const Shape& shape, const Eigen::Isometry3d& link_from_shape) {
    const BoundingSphere ball = ballAround(shape);
    if (std::isfinite(ball.radius)) balls.push_back({link_from_shape * ball.center, ball.radius});
  };
  const Link& own = checker.robot().links()[static_cast<std::size_t>(link)];
  for (const CollisionGeometry& geometry : own.collision) {
    add(geometry.shape, geometry.link_from_shape);
  }
  for (const AttachedBody& body : checker.options().attached) {
    if (body.link != own.name) continue;
    for (const AttachedBody::Part& part : body.parts) add(part.shape, part.link_from_shape);
  }
  if (balls.empty()) return std::nullopt;
  LinkBall all{link};
  for (const BoundingSphere& ball : balls) all.center += ball.center;
  all.center /= static_cast<double>(balls.size());
  for (const BoundingSphere& ball : balls) {
    all.radius = std::max(all.radius, (ball.center - all.center).norm() + ball.radius);
  }
  return all;
}

bool turns(const Joint& joint) {
  return joint.type == JointType::Revolute || joint.type == JointType::Continuous;
}

/// The joint whose value moves this one; none for one that nothing moves.
int masterOf(const Robot& robot, int joint) {
  const Joint& own = robot.joints()[static_cast<std::size_t>(joint)];
  return own.type == JointType::Fixed ? -1 : own.mimic ? own.mimic->master : joint;
}

/// A robot in one configuration, its planar and floating joints at rest.
class Posture {
 public:
  explicit Posture(const Robot& robot)
      : robot_(robot),
        frames_(robot.links().size(), Eigen::Isometry3d::Identity()),
        axes_(robot.joints().size()),
        origins_(robot.joints().size()) {}

  /// `values`: of Robot::variables().
  void take(const std::vector<double>& values) {
    for (std::size_t j = 0; j < robot_.joints().size(); ++j) {
      const Joint& joint = robot_.joints()[j];
      Eigen::Isometry3d& frame = frames_[static_cast<std::size_t>(joint.childLink)];
      frame = joint.parentLink < 0
                  ? joint.parent_from_joint
                  : frames_[static_cast<std::size_t>(joint.parentLink)] * joint.parent_from_joint;
      axes_[j] = frame.linear() * joint.axis;
      origins_[j] = frame.translation();
      const double value = valueOf(joint, values);
      if (turns(joint)) frame.rotate(Eigen::AngleAxisd(value, joint.axis));
      if (joint.type == JointType::Prismatic) frame.translate(value * joint.axis);
    }
  }

  /// m. The farthest point of a ball from the axis of a joint.
  double armOf(int joint, const LinkBall& ball) const {
    const auto j = static_cast<std::size_t>(joint);
    const Eigen::Vector3d center = frames_[static_cast<std::size_t>(ball.link)] * ball.center;
    return axes_[j].cross(center - origins_[j]).norm() + ball.radius;
  }

 private:
  double valueOf(const Joint& joint, const std::vector<double>& values) const {
    if (!turns(joint) && joint.type != JointType::Prismatic) return 0.0;
    if (!joint.mimic) return values[static_cast<std::size_t>(joint.firstVariable)];
    const Joint& master = robot_.joints()[static_cast<std::size_t>(joint.mimic->master)];
    return joint.mimic->multiplier * values[static_cast<std::size_t>(master.firstVariable)] +
           joint.mimic->offset;
  }

  const Robot& robot_;
  std::vector<Eigen::Isometry3d> frames_;  ///< of links
  std::vector<Eigen::Vector3d> axes_, origins_;
};

/// Spread evenly: each variable steps by the golden ratio's share, and by another start.
std::vector<double> spreadValues(const Robot& robot, int configuration) {
  std::vector<double> values;
  for (const Variable& variable : robot.variables()) {
    const double place = (configuration + 1) * std::numbers::phi +
                         static_cast<double>(values.size()) * std::numbers::sqrt2;
    const double low = std::isfinite(variable.lower) ? variable.lower : -kFarthestTurn;
    const double high = std::isfinite(variable.upper) ? variable.upper : kFarthestTurn;
    values.push_back(low + (place - std::floor(place)) * (high - low));
  }
  return values;
}

}  // namespace

std::vector<double> jointReach(const Checker& checker) {
  const Robot& robot = checker.robot();
  std::vector<double> reach(robot.joints().size(), 0.0), farthest(reach.size(), 0.0);
  std::vector<char> isOfGroup(reach.size(), 0);
  for (const int joint : checker.group().joints) isOfGroup[static_cast<std::size_t>(joint)] = 1;
  std::vector<LinkBall> balls;
  for (int link = 0; link < static_cast<int>(robot.links().size()); ++link) {
    if (const auto ball = ballOf(checker, link)) balls.push_back(*ball);
  }
  Posture posture(robot);
  for (int i = 0; i < kConfigurations; ++i) {
    posture.take(spreadValues(robot, i));
    std::ranges::fill(farthest, 0.0);
    for (const LinkBall& ball : balls) {
      for (int link = ball.link; link >= 0;) {
        const int j = robot.links()[static_cast<std::size_t>(link)].parentJoint;
        if (j < 0) break;
        const Joint& joint = robot.joints()[static_cast<std::size_t>(j)];
        link = joint.parentLink;
        const int master = masterOf(robot, j);
        if (master < 0 || isOfGroup[static_cast<std::size_t>(master)] == 0) continue;
        const double arm = turns(joint) ? posture.armOf(j, ball) : 1.0;
        double& most = farthest[static_cast<std::size_t>(master)];
        most = std::max(most, (joint.mimic ? std::abs(joint.mimic->multiplier) : 1.0) * arm);
      }
    }
    for (std::size_t j = 0; j < reach.size(); ++j) {
      reach[j] += farthest[j] * farthest[j] / kConfigurations;
    }
  }
  for (double& square : reach) square = std::sqrt(square);
  return reach;
}

}  // namespace swept::detail
