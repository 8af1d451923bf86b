// SPDX-License-Identifier: BSD-3-Clause
//
// withoutRobot() against the signed distance of every point to every piece of every link, placed by
// kinematics of the test's own.
#include "swept/robot_model/self_filter.hpp"
#include "model_robots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>

#include "message_of.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// Of any type, and of what mimics another; planar joints in the plane z = 0.
Isometry3d jointPose(const Robot& robot, const Joint& joint, const std::vector<double>& state) {
  Isometry3d pose = Isometry3d::Identity();
  const Joint& source =
      joint.mimic ? robot.joints()[static_cast<std::size_t>(joint.mimic->master)] : joint;
  if (joint.type == JointType::Fixed) return pose;
  const double* q = state.data() + source.firstVariable;
  const double value = joint.mimic ? joint.mimic->multiplier * *q + joint.mimic->offset : *q;
  if (joint.type == JointType::Prismatic) pose.translation() = value * joint.axis;
  if (joint.type == JointType::Revolute || joint.type == JointType::Continuous) {
    pose.linear() = Eigen::AngleAxisd(value, joint.axis).toRotationMatrix();
  }
  if (joint.type == JointType::Planar) {
    EXPECT_EQ(joint.axis, Vector3d::UnitZ());
    pose.translation() = Vector3d(q[0], q[1], 0.0);
    pose.linear() = Eigen::AngleAxisd(q[2], Vector3d::UnitZ()).toRotationMatrix();
  }
  if (joint.type == JointType::Floating) {
    pose.translation() = Vector3d(q[0], q[1], q[2]);
    pose.linear() = Eigen::Quaterniond(q[6], q[3], q[4], q[5]).normalized().toRotationMatrix();
  }
  return pose;
}

struct PlacedShape {
  Shape shape;
  Isometry3d model_from_shape;
};

std::vector<PlacedShape> placed(const Robot& robot, const std::vector<double>& state) {
  std::vector<PlacedShape> shapes;
  const std::function<Isometry3d(const Link&)> poseOf = [&](const Link& link) -> Isometry3d {
    if (link.parentJoint < 0) return Isometry3d::Identity();
    const Joint& joint = robot.joints()[static_cast<std::size_t>(link.parentJoint)];
    const Isometry3d parent =
        joint.parentLink < 0 ? Isometry3d::Identity()
                             : poseOf(robot.links()[static_cast<std::size_t>(joint.parentLink)]);
    return parent * joint.parent_from_joint * jointPose(robot, joint, state);
  };
  for (const Link& link : robot.links()) {
    for (const CollisionGeometry& piece : link.collision) {
      shapes.push_back({piece.shape, poseOf(link) * piece.link_from_shape});
    }
  }
  return shapes;
}

/// m, of a point from the nearest shape: an interval.
struct Signed {
  double lower = std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};
Signed distanceTo(const std::vector<PlacedShape>& shapes, const Vector3d& point) {
  Signed nearest;
  for (const PlacedShape& placed : shapes) {
    const Isometry3d shape_from_point =
        placed.model_from_shape.inverse() * Isometry3d(Eigen::Translation3d(point));
    const auto result = signedDistance(placed.shape, Sphere{0.0}, shape_from_point);
    nearest.lower = std::min(nearest.lower, result.lower);
    nearest.upper = std::min(nearest.upper, result.upper);
  }
  return nearest;
}

std::vector<double> randomState(const Robot& robot, std::mt19937& random) {
  std::vector<double> state;
  for (const Variable& variable : robot.variables()) {
    const double lower = std::max(variable.lower, -2.0);
    const double upper = std::min(variable.upper, 2.0);
    state.push_back(std::uniform_real_distribution<double>(lower, upper)(random));
  }
  return state;
}

/// In the boxes of the shapes, which are mostly full, and a little beside them.
Points pointsAround(const std::vector<PlacedShape>& shapes, std::size_t count, double reach,
                    std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<std::size_t> choice(0, shapes.size() - 1);
  Points points;
  while (points.size() < count) {
    const PlacedShape& around = shapes[choice(random)];
    const Aabb box = boundingBox(around.shape).inflated(reach);
    const Vector3d part(unit(random), unit(random), unit(random));
    points.push_back(around.model_from_shape *
                     (box.lower + part.cwiseProduct(box.upper - box.lower)));
  }
  return points;
}

class SelfFilter : public ::testing::TestWithParam<std::string> {};

TEST_P(SelfFilter, LeavesOutWhatIsWithinTheMarginOfALink) {
  constexpr std::size_t kPoints = 400;
  constexpr double kEither = 2e-6;  // m
  const auto robot = test::modelRobot(GetParam());
  std::mt19937 random(21);
  for (const double margin : {0.0, 0.001, 0.03}) {
    std::size_t left = 0;
    std::size_t near = 0;
    for (int round = 0; round < 4; ++round) {
      const std::vector<double> state = randomState(*robot, random);
      const std::vector<PlacedShape> shapes = placed(*robot, state);
      const Points points = pointsAround(shapes, kPoints, margin + 0.01, random);
      const Points kept = withoutRobot(points, *robot, state, margin);
      auto next = kept.begin();
      for (const Vector3d& point : points) {
        const bool isKept = next != kept.end() && *next == point;
        if (isKept) ++next;
        left += isKept ? 0 : 1;
        const Signed distance = distanceTo(shapes, point);
        near += std::abs(distance.upper - margin) < 0.005 ? 1 : 0;
        if (distance.lower > margin + kEither) {
          ASSERT_TRUE(isKept) << point.transpose() << ", margin " << margin << ", distance "
                              << distance.lower << " to " << distance.upper;
        }
        if (distance.upper < margin - kEither) {
          ASSERT_FALSE(isKept) << point.transpose() << ", margin " << margin << ", distance "
                               << distance.lower << " to " << distance.upper;
        }
      }
      ASSERT_EQ(next, kept.end());  // in their order, and none that was not given
    }
    EXPECT_GT(left, 4 * kPoints * 3 / 10) << margin;
    EXPECT_LT(left, 4 * kPoints * 9 / 10) << margin;
    EXPECT_GT(near, 4 * kPoints / 20) << margin;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, SelfFilter,
                         ::testing::Values("rook7", "rook6", "rook6_cart", "drifter"),
                         [](const auto& test) { return test.param; });

/// A ball on a floating joint, and a plate that nothing moves.
constexpr const char* kBall = R"(<robot name="r">
  <link name="plate"><collision><geometry><box size="1 1 0.25"/></geometry></collision></link>
  <link name="ball"><collision><geometry><sphere radius="0.5"/></geometry></collision></link>
  <joint name="float" type="floating"><parent link="plate"/><child link="ball"/></joint>
</robot>)";

class Ball : public ::testing::Test {
 protected:
  std::string refusal(const std::vector<double>& state, double margin) const {
    try {
      withoutRobot(Points{}, *robot_, state, margin);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }
  const std::shared_ptr<const Robot> robot_ = Robot::parse(kBall, "r.urdf");
  const std::vector<double> state_{0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0};
};

TEST_F(Ball, BoundariesBelongToIt) {
  // Numbers that doubles have: touching is within.
  const Points inside{{0, 0, 0}, {0, 0, 2}, {0, 0, 2.375}, {0.5, 0.5, 0.0}, {0.5, 0.0, 2.0}};
  const Points outside{{0, 0, 1}, {0.625, 0, 0}, {0, 0.5625, 2}, {9, 9, 9}};
  Points all = outside;
  all.insert(all.begin() + 2, inside.begin(), inside.end());
  EXPECT_EQ(withoutRobot(all, *robot_, state_, 0.0), outside);
  EXPECT_EQ(withoutRobot(all, *robot_, state_, 0.0625),
            (Points{{0, 0, 1}, {0.625, 0, 0}, {9, 9, 9}}));
  EXPECT_EQ(withoutRobot(all, *robot_, state_, 0.125), (Points{{0, 0, 1}, {9, 9, 9}}));
  EXPECT_EQ(withoutRobot(all, *robot_, state_, 1e6), Points{});
  EXPECT_EQ(withoutRobot(Points{}, *robot_, state_, 0.0), Points{});
}

TEST_F(Ball, PointsThatAreNotFiniteAreKept) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Points points{{nan, 0, 0}, {0, 0, 0}, {0, infinity, 0}, {nan, nan, nan}, {0, 0, -infinity}};
  EXPECT_EQ(withoutRobot(points, *robot_, state_, 0.1).size(), 4u);
  const auto arm = test::modelRobot("rook7");
  const std::vector<double> state(arm->variables().size(), 0.0);
  EXPECT_EQ(withoutRobot(points, *arm, state, 0.1).size(), 4u);
}

TEST_F(Ball, BallsKeepMoreThanTheMarginToo) {
  const Balls all{.centers = {{0, 0, 1}, {0, 0, 1}, {0, 0, 2}, {0.75, 0, 2}, {9, 9, 9}},
                  .radii = {0.25, 0.5, 0.0, 0.25, 4.0}};
  const auto centersAt = [&](double margin) {
    return ballsWithoutRobot(all, *robot_, state_, margin).centers;
  };
  EXPECT_EQ(centersAt(0.0), (Points{{0, 0, 1}, {9, 9, 9}}));
  EXPECT_EQ(ballsWithoutRobot(all, *robot_, state_, 0.0).radii, (std::vector<double>{0.25, 4.0}));
  EXPECT_EQ(centersAt(0.25), (Points{{9, 9, 9}}));
  const Balls broken{.centers = {{0, 0, 1}}, .radii = {}};
  EXPECT_EQ(test::messageOf([&] { ballsWithoutRobot(broken, *robot_, state_, 0.0); }),
            "withoutRobot: 1 balls have 0 radii");
}

/// Large cubes whose middles were near the robot were left out whole: walls around it were free.
TEST_F(Ball, OfLargeCubesOnlyWhatIsNearIsLeftOut) {
  // In the ball is the middle of the first; 8 m beside it the second; the third is all in the
  // plate.
  const OccupancyMap map{.resolution = 0.125,
                         .occupied = {{.center = {0, 0, 2}, .side = 4.0},
                                      {.center = {8, 0, 2}, .side = 4.0},
                                      {.center = {0.25, 0.25, 0}, .side = 0.125}}};
  const Eigen::Isometry3d world_from_map(Eigen::Translation3d(0.0, 0.0, 0.0));
  const double margin = 0.03125;
  const OccupancyMap kept = mapWithoutRobot(map, world_from_map, *robot_, state_, margin);
  EXPECT_EQ(kept.resolution, map.resolution);
  double volume = 0.0;
  for (const OccupancyMap::Cube& cube : kept.occupied) volume += std::pow(cube.side, 3);
  const double ball = 4.0 / 3.0 * 3.14159 * std::pow(0.5 + margin, 3);
  const double plate = 0.125 * 1.0 * 1.0;  // of it, in the first cube
  EXPECT_NEAR(volume, 2 * 64.0 - ball - plate, 0.2);
  // Every smallest cube of the map is kept exactly if its middle is not near.
  Points middles;
  for (double x = -1.9375; x < 2.0; x += 0.125)
    for (double y = -1.9375; y < 2.0; y += 0.125)
      for (double z = 0.0625; z < 4.0; z += 0.125) middles.emplace_back(x, y, z);
  const Points far = withoutRobot(middles, *robot_, state_, margin);
  ASSERT_LT(far.size(), middles.size());
  for (const Vector3d& middle : middles) {
    const auto contains = [&](const OccupancyMap::Cube& cube) {
      return (middle - cube.center).lpNorm<Eigen::Infinity>() < 0.5 * cube.side;
    };
    ASSERT_EQ(std::ranges::count_if(kept.occupied, contains), std::ranges::count(far, middle))
        << middle.transpose();
  }
  // Whole where it can be: most of it is in few cubes.
  EXPECT_LT(kept.occupied.size(), 4000u);
  EXPECT_EQ(std::ranges::count(kept.occupied, 4.0, &OccupancyMap::Cube::side), 1);
}

TEST_F(Ball, AMapIsFilteredWhereItStands) {
  const OccupancyMap map{.resolution = 0.125,
                         .occupied = {{.center = {0.0625, 0.0625, 0.0625}, .side = 0.125}}};
  const Eigen::Isometry3d away(Eigen::Translation3d(0.0, 0.0, 1.0));
  EXPECT_EQ(mapWithoutRobot(map, away, *robot_, state_, 0.0).occupied.size(), 1u);
  EXPECT_EQ(mapWithoutRobot(map, away, *robot_, state_, 1.0).occupied.size(), 0u);
  const Eigen::Isometry3d there(Eigen::Translation3d(0.0, 0.0, 2.0));
  EXPECT_EQ(mapWithoutRobot(map, there, *robot_, state_, 0.0).occupied.size(), 0u);
  EXPECT_EQ(test::messageOf([&] { mapWithoutRobot({}, there, *robot_, state_, 0.0); }),
            "withoutRobot: the map's resolution is 0; it must be above 0");
}

TEST_F(Ball, AMapThatIsTooFineIsRefused) {
  const OccupancyMap map{.resolution = 0x1p-14, .occupied = {{.center = {0, 0, 2}, .side = 4.0}}};
  EXPECT_EQ(test::messageOf(
                [&] { mapWithoutRobot(map, Eigen::Isometry3d::Identity(), *robot_, state_, 0.0); }),
            "withoutRobot: cubes near the robot have more than 10000000 parts at a resolution of "
            "6.103515625e-05 m");
}

TEST_F(Ball, RefusesWhatIsNoStateOrMargin) {
  const std::vector<double> none{0, 0, 0, 0, 0, 0, 0};
  std::vector<double> infinite = state_;
  infinite[4] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(state_, 0.0), "");
  EXPECT_EQ(refusal(state_, -0.5),
            "withoutRobot: the margin is -0.5; it must be finite and at least 0");
  EXPECT_EQ(refusal(state_, std::numeric_limits<double>::quiet_NaN()),
            "withoutRobot: the margin is nan; it must be finite and at least 0");
  EXPECT_EQ(refusal(state_, std::numeric_limits<double>::infinity()),
            "withoutRobot: the margin is inf; it must be finite and at least 0");
  EXPECT_EQ(refusal({0.0, 1.0}, 0.0), "withoutRobot: the state has 2 values instead of 7");
  EXPECT_EQ(refusal(infinite, 0.0), "withoutRobot: 'float/rot_y' of the state is not finite");
  EXPECT_EQ(refusal(none, 0.0), "withoutRobot: the quaternion of joint 'float' has no direction");
}

}  // namespace
}  // namespace swept
