// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "certify/motion_check.hpp"
#include "model_robots.hpp"
#include "simd_robots.hpp"
#include "simd_targets.hpp"
#include "swept/core/distance.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::simd_test {
namespace {

using detail::CheckerModel;
using detail::WorkspaceData;
using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Obstacles by the point of theirs that is farthest in a direction.
struct Tip {
  Shape shape;
  Vector3d point;  ///< m, in the shape's frame
};

Tip farthestOf(const Shape& shape, const std::vector<Vector3d>& corners, const Vector3d& towards,
               double radius) {
  const auto most = std::ranges::max_element(
      corners, {}, [&](const Vector3d& corner) { return corner.dot(towards); });
  return {shape, *most + radius * towards};
}

Tip tipOf(Random& random, const Vector3d& towards) {
  const double size = random.scale(1e-3, 0.1);
  const auto cloud = [&](int count) {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(random.vector(size));
    return points;
  };
  switch (random.below(6)) {
    case 0:
      return {Sphere{size}, size * towards};
    case 1: {
      const Vector3d half = random.vector(size).cwiseAbs() + Vector3d::Constant(1e-4);
      const Vector3d sign = towards.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
      return {Box{half}, half.cwiseProduct(sign)};
    }
    case 2: {
      const double half = random.scale(1e-3, 0.1);
      return farthestOf(Capsule{size, half}, {{0, 0, -half}, {0, 0, half}}, towards, size);
    }
    case 3: {
      const double half = random.scale(1e-3, 0.1);
      Vector3d rim(towards.x(), towards.y(), 0.0);
      if (rim.norm() > 0.0) rim *= size / rim.norm();
      rim.z() = towards.z() < 0.0 ? -half : half;
      return {Cylinder{size, half}, rim};
    }
    case 4: {
      const auto points = cloud(10);
      return farthestOf(ConvexHull::of(points), points, towards, 0.0);
    }
    default: {
      const auto points = cloud(10);
      return farthestOf(PointCloud::build(points, 0.5 * size), points, towards, 0.5 * size);
    }
  }
}

/// Links that are balls: their covers have no room to spare, so nothing hides a bound that is
/// short.
std::string ballsRobot() {
  std::string urdf = R"(<robot name="balls"><link name="base"/>)";
  std::string parent = "base";
  const std::array<const char*, 5> axes{"0 0 1", "0 1 0", "1 0 0", "0 1 0.3", "0.2 0 1"};
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::string link = "ball" + std::to_string(i);
    urdf += "<link name=\"" + link + R"("><collision><origin xyz="0.25 0.05 0.1"/>
      <geometry><sphere radius="0.05"/></geometry></collision></link><joint name="turn)" +
            std::to_string(i) + R"(" type="revolute"><parent link=")" + parent +
            R"("/><child link=")" + link + R"("/><origin xyz="0.3 0 0.1"/><axis xyz=")" + axes[i] +
            R"("/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>)";
    parent = link;
  }
  return urdf + "</robot>";
}

std::shared_ptr<const Robot> robotOf(const std::string& name) {
  if (name == "balls") return Robot::parse(ballsRobot(), "balls.urdf");
  return test::modelRobot(name);
}

/// One robot, and one obstacle that is put elsewhere for each motion.
class Stage {
 public:
  Stage(const std::string& robot, const char* group) {
    const auto loaded = robotOf(robot);
    const auto world = std::make_shared<World>();
    world->add("obstacle", Sphere{5.0}, Isometry3d::Identity());
    model_ = *detail::compileChecker(loaded, *loaded->findGroup(group), world, {});
    // What the links do to each other is not what this is about.
    model_.pairs.clear();
    model_.simd = simdModelOf(model_);
    joints_.resize(model_.kinematics.bodies.size());
    states_.resize(joints_.size());
  }

  void chooseMotion(Random& random) {
    const detail::KinematicModel& kinematics = model_.kinematics;
    from_.clear();
    to_.clear();
    const double step = random.scale(0.05, 1.0);
    for (int i = 0; i < kinematics.dimension; ++i) {
      const bool bounded = std::isfinite(kinematics.upper[i] - kinematics.lower[i]);
      const double low = bounded ? kinematics.lower[i] : -1.0;
      const double high = bounded ? kinematics.upper[i] : 1.0;
      from_.push_back(random.uniform(low, high));
      to_.push_back((1.0 - step) * from_[i] + step * random.uniform(low, high));
    }
    EXPECT_TRUE(detail::compileMotion(kinematics, from_, to_, joints_));
  }

  /// Puts an obstacle where a link only just gets at some t: across the velocity of its middle, on
  /// the side that it accelerates to or away from. False if there is no contact after all.
  bool placeObstacle(Random& random, double depth) {
    const double t = random.uniform(0.0, 1.0);
    const auto pair = model_.pair(random.below(static_cast<int>(model_.pairCount())));
    const auto& link = model_.robotGeometry[pair.a];
    // The inner side of the turn too: there the way bends past the segments that stand for it.
    const Vector3d aside = random.chance(0.5) ? outwardAt(t, link) : Vector3d(-outwardAt(t, link));
    moveTo(t);
    const Isometry3d world_from_link = states_[link.body].world_from_body * link.body_from_shape;
    const Vector3d far = states_[link.body].world_from_body * link.center + 3.0 * aside;
    const Isometry3d link_from_point(world_from_link.inverse() * Eigen::Translation3d(far));
    const auto nearest = distance(link.shape, Sphere{0.0}, link_from_point);
    const Vector3d surface = world_from_link * nearest.pointA;
    const Vector3d normal = (far - surface).normalized();
    const Eigen::Quaterniond turn = random.turn();
    const Tip tip = tipOf(random, turn.conjugate() * (-normal));
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = turn.toRotationMatrix();
    pose.translation() = surface - depth * normal - pose.linear() * tip.point;
    model_.worldGeometry.front() = worldGeometry(tip.shape, pose);
    model_.worldGeometry.front().body = 0;
    model_.simd.obstacles = detail::compileObstacles(model_.worldGeometry,
                                                     static_cast<double>(model_.simd.reach), true);
    return collide(link.shape, tip.shape, world_from_link.inverse() * pose) == Contact::Touching;
  }

  /// Proven, m: the motion keeps this much.
  double clearance() {
    WorkspaceData workspace(model_);
    const detail::StraightPath path(model_.kinematics, from_, to_);
    return detail::motionClearance(model_, path, 0.1 * tolerance::kMotion, ClearanceQuery::Least,
                                   workspace)
        .lower;
  }

  MotionCertificate certify(bool lanes, MotionQuery query) {
    model_.simd.usable = lanes;
    WorkspaceData workspace(model_);
    return detail::certifyMotion(model_, from_, to_, query, workspace);
  }

 private:
  void moveTo(double t) {
    for (std::size_t body = 1; body < states_.size(); ++body)
      detail::evaluateBody(model_.kinematics, joints_, t, static_cast<int>(body), states_);
  }

  Vector3d outwardAt(double t, const detail::RobotGeometry& link) {
    constexpr double kStep = 1e-4;
    std::array<Vector3d, 3> at;
    for (int i = 0; i < 3; ++i) {
      moveTo(t + (i - 1) * kStep);
      at[i] = states_[link.body].world_from_body * link.center;
    }
    const Vector3d velocity = at[2] - at[0];
    Vector3d outward = -(at[2] - 2.0 * at[1] + at[0]);
    if (velocity.norm() > 0.0)
      outward -= velocity.normalized().dot(outward) * velocity.normalized();
    return outward.norm() > 0.0 ? Vector3d(outward.normalized()) : Vector3d::UnitZ();
  }

  CheckerModel model_;
  std::vector<double> from_, to_;
  std::vector<detail::JointMotion> joints_;
  std::vector<detail::BodyState> states_;
};

/// A motion that reaches into an obstacle at one moment and no more than a hair's breadth is never
/// proven free.
TEST(SimdGrazing, NoContactIsEverPassedOver) {
  struct Named {
    const char* robot;
    const char* group;
  };
  for (const Named& robot :
       {Named{"balls", "all"}, Named{"rook7", "arm_with_gripper"}, Named{"rook6", "arm_with_tool"},
        Named{"rook6_cart", "whole_body"}, Named{"drifter", "body"}}) {
    SCOPED_TRACE(robot.robot);
    Stage stage(robot.robot, robot.group);
    Random random(61);
    int contacts = 0;
    int asked = 0;  // on each instruction set
    int inLanes = 0;
    int brief = 0;
    for (int round = 0; round < 400; ++round) {
      stage.chooseMotion(random);
      const double depth = random.scale(1e-8, 1e-3);
      if (!stage.placeObstacle(random, depth)) continue;
      ++contacts;
      for (const std::int64_t target : simdTargets()) {
        const OnTarget on(target);
        const auto found = stage.certify(true, MotionQuery::VerdictOnly);
        ASSERT_NE(found.verdict, Verdict::Free) << "round " << round << ", depth " << depth;
        ++asked;
        inLanes += found.effort.lanes > 0 ? 1 : 0;
      }
      // As brief as they are, the exact tier alone is seldom sure of them.
      brief += stage.certify(false, MotionQuery::VerdictOnly).verdict == Verdict::Undecided ? 1 : 0;
    }
    RecordProperty(std::string(robot.robot) + "_contacts", contacts);
    RecordProperty(std::string(robot.robot) + "_brief", brief);
    EXPECT_GT(contacts, 300);
    EXPECT_GT(5 * inLanes, 4 * asked);
    EXPECT_GT(brief, contacts / 25);
  }
}

/// The other way round: what keeps a little more than the tolerance is decided.
TEST(SimdGrazing, AGapAboveTheToleranceIsNeverUndecided) {
  Stage stage("rook7", "arm_with_gripper");
  Random random(62);
  int above = 0;
  for (int round = 0; round < 300; ++round) {
    stage.chooseMotion(random);
    EXPECT_FALSE(stage.placeObstacle(random, -1.5 * tolerance::kMotion));
    const auto exact = stage.certify(false, MotionQuery::VerdictOnly);
    const auto found = stage.certify(true, MotionQuery::VerdictOnly);
    if (exact.verdict == Verdict::Collision) {
      EXPECT_NE(found.verdict, Verdict::Free);
    }
    if (stage.clearance() <= tolerance::kMotion) continue;
    ++above;
    EXPECT_EQ(exact.verdict, Verdict::Free) << "round " << round;
    EXPECT_EQ(found.verdict, Verdict::Free) << "round " << round;
  }
  EXPECT_GT(above, 60);
}

}  // namespace
}  // namespace swept::simd_test
