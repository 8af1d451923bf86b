// SPDX-License-Identifier: BSD-3-Clause
// Straight motions of a tool, against a planar arm whose way is known by hand, and against
// kinematics that are multiplied here, along random lines of robots.
#include "swept/robot_model/tool_line.hpp"
#include "model_robots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <random>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "message_of.hpp"
#include "swept/robot_model/planning_scene.hpp"

namespace swept {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Reason = ToolLineStop::Reason;
using test::messageOf;

constexpr double kPi = std::numbers::pi;

/// Two links of 1 m that turn about z, with a ball of 5 cm at the tip.
std::shared_ptr<const Robot> planarArm(double leastElbow, double mostElbow) {
  const auto limits = [](double lower, double upper) {
    return "<axis xyz='0 0 1'/><limit lower='" + std::to_string(lower) + "' upper='" +
           std::to_string(upper) + "' effort='1' velocity='1'/></joint>";
  };
  return Robot::parse(
      "<robot name='arm'><link name='base'/><link name='upper'/><link name='lower'/>"
      "<link name='tip'><collision><geometry><sphere radius='0.05'/></geometry></collision></link>"
      "<joint name='shoulder' type='revolute'><parent link='base'/><child link='upper'/>" +
          limits(-3.0, 3.0) +
          "<joint name='elbow' type='revolute'><parent link='upper'/><child link='lower'/>"
          "<origin xyz='1 0 0'/>" +
          limits(leastElbow, mostElbow) +
          "<joint name='end' type='fixed'><parent link='lower'/><child link='tip'/>"
          "<origin xyz='1 0 0'/></joint></robot>",
      "arm.urdf");
}

class PlanarLine : public testing::Test {
 protected:
  static constexpr double kHeight = 0.6;
  static constexpr double kBegin = 1.0;

  /// The line y = 0.6 from x = 1, with the elbow to the right.
  ToolLine along(double length, double leastElbow = -3.0, double mostElbow = 3.0,
                 const World& world = {}, ToolLineOptions options = {.angle = kPi}) {
    checker_ = std::make_shared<const Checker>(planarArm(leastElbow, mostElbow), "all",
                                               std::make_shared<const World>(world));
    const ToolLinePlanner planner(checker_, {.body = "tip"});
    Isometry3d goal = planner.pose(start());
    goal.translation().x() += length;
    Workspace workspace(*checker_);
    return planner.plan(start(), goal, workspace, options);
  }

  /// By the law of cosines.
  static std::vector<double> start() {
    const double squared = kBegin * kBegin + kHeight * kHeight;
    const double elbow = std::acos(0.5 * squared - 1.0);
    return {std::atan2(kHeight, kBegin) - 0.5 * elbow, elbow};
  }
  /// The share of a line at which the tip is so far from the shoulder.
  static double shareAtRadius(double radius, double length) {
    return (std::sqrt(radius * radius - kHeight * kHeight) - kBegin) / length;
  }
  /// The largest deviation of the tip from its line, sampled.
  static double sampled(const ToolLine& line) {
    double most = 0.0;
    for (std::size_t i = 1; i < line.wayPoints.size(); ++i)
      for (int k = 0; k <= 1000; ++k) {
        const double t = k / 1000.0;
        const auto &from = line.wayPoints[i - 1], &to = line.wayPoints[i];
        const double a = from[0] + t * (to[0] - from[0]);
        const double b = a + from[1] + t * (to[1] - from[1]);
        most = std::max(most, std::abs(std::sin(a) + std::sin(b) - kHeight));
      }
    return most;
  }

  std::shared_ptr<const Checker> checker_;
};

TEST_F(PlanarLine, ReachesItsGoal) {
  const ToolLine line = along(0.7);
  EXPECT_TRUE(line.complete());
  EXPECT_EQ(line.share, 1.0);
  EXPECT_NEAR(line.length, 0.7, 1e-12);
  const std::vector<double>& q = line.wayPoints.back();
  EXPECT_NEAR(std::cos(q[0]) + std::cos(q[0] + q[1]), 1.7, 1e-6);
  EXPECT_NEAR(std::sin(q[0]) + std::sin(q[0] + q[1]), kHeight, 1e-6);
  const double found = sampled(line);
  EXPECT_LE(found, line.position);
  EXPECT_LE(line.position, 1e-3);
  EXPECT_GT(found, 1e-4);  // the way points are not closer than they need be
  EXPECT_EQ(line.shares.size(), line.wayPoints.size());
  EXPECT_TRUE(std::ranges::is_sorted(line.shares));
  // Ten times less takes some sqrt(10) times as many.
  const ToolLine fine = along(0.7, -3.0, 3.0, {}, {.position = 1e-4, .angle = kPi});
  EXPECT_TRUE(fine.complete());
  EXPECT_LE(sampled(fine), 1e-4);
  EXPECT_LT(fine.wayPoints.size(), 6 * line.wayPoints.size());
}

TEST_F(PlanarLine, WhoeverStopsItGetsWhatIsProvenByThen) {
  std::stop_source stopped;
  EXPECT_TRUE(along(0.7, -3.0, 3.0, {}, {.angle = kPi, .stop = stopped.get_token()}).complete());
  stopped.request_stop();
  const ToolLine none = along(0.7, -3.0, 3.0, {}, {.angle = kPi, .stop = stopped.get_token()});
  ASSERT_TRUE(none.stop);
  EXPECT_EQ(none.stop->reason, Reason::Undecided);
  EXPECT_EQ(none.share, 0.0);
  EXPECT_EQ(none.wayPoints.size(), 1U);
  const ToolLine whole = along(0.7, -3.0, 3.0, {}, {.position = 1e-8, .angle = kPi});
  ASSERT_TRUE(whole.complete());
  int partly = 0;
  for (int i = 0; i < 400 && partly < 3; ++i) {
    std::stop_source own;
    const std::jthread stopper([&own, i] {
      std::this_thread::sleep_for(std::chrono::microseconds(100 * i));
      own.request_stop();
    });
    const ToolLine some =
        along(0.7, -3.0, 3.0, {}, {.position = 1e-8, .angle = kPi, .stop = own.get_token()});
    if (some.share == 0.0 || some.complete()) continue;
    ++partly;
    EXPECT_EQ(some.stop->reason, Reason::Undecided);
    EXPECT_EQ(some.stop->share, some.share);
    // The same way points as without a stop, but fewer.
    ASSERT_LT(some.wayPoints.size(), whole.wayPoints.size());
    for (std::size_t k = 0; k < some.wayPoints.size(); ++k)
      EXPECT_EQ(some.wayPoints[k], whole.wayPoints[k]);
  }
  EXPECT_EQ(partly, 3);
}

TEST_F(PlanarLine, EndsWhereTheArmIsStretched) {
  const ToolLine line = along(1.5);
  ASSERT_FALSE(line.complete());
  EXPECT_EQ(line.stop->reason, Reason::Singularity);
  const double most = shareAtRadius(2.0, 1.5);
  EXPECT_LE(line.share, most + 1e-6);
  EXPECT_GT(line.share, most - 1e-4);
  EXPECT_LT(line.stop->leastSingularValue, 0.05);
  EXPECT_GT(line.stop->jointStep, 3.0);
  EXPECT_LE(sampled(line), line.position);
}

TEST_F(PlanarLine, EndsAtALimit) {
  const ToolLine line = along(1.5, 0.5);
  ASSERT_FALSE(line.complete());
  EXPECT_EQ(line.stop->reason, Reason::Limit);
  EXPECT_EQ(line.stop->variable, "elbow");
  const double most = shareAtRadius(std::sqrt(2.0 + 2.0 * std::cos(0.5)), 1.5);
  EXPECT_LE(line.share, most + 1e-6);
  EXPECT_GT(line.share, most - 1e-4);
  EXPECT_GE(line.wayPoints.back()[1], 0.5);
  EXPECT_EQ(describe(*line.stop, {}).substr(0, 10), "limit at 0");
}

TEST_F(PlanarLine, EndsAtAContact) {
  World world;
  world.add("wall", Box{{0.1, 0.5, 0.5}}, Isometry3d(Eigen::Translation3d(1.6, kHeight, 0.0)));
  const ToolLine line = along(0.7, -3.0, 3.0, world);
  ASSERT_FALSE(line.complete());
  EXPECT_EQ(line.stop->reason, Reason::Contact);
  const double most = (1.6 - 0.1 - 0.05 - kBegin) / 0.7;
  const double contact = line.stop->share;
  EXPECT_NEAR(contact, most, 3e-3);
  EXPECT_LE(line.share, contact);
  EXPECT_GT(line.share, contact - 0.01);
  EXPECT_EQ(line.stop->contact->bodyB, "wall");
  EXPECT_EQ(line.stop->contact->t, contact);
}

TEST_F(PlanarLine, BeginsOnlyWhereItMay) {
  World world;
  world.add("wall", Box{{0.1, 0.5, 0.5}}, Isometry3d(Eigen::Translation3d(1.0, kHeight, 0.0)));
  const ToolLine inWall = along(0.7, -3.0, 3.0, world);
  EXPECT_EQ(inWall.stop->reason, Reason::Contact);
  EXPECT_EQ(inWall.share, 0.0);
  EXPECT_EQ(inWall.wayPoints.size(), 1U);
  const ToolLine outside = along(0.7, -3.0, 0.3);
  EXPECT_EQ(outside.stop->reason, Reason::Limit);
  EXPECT_EQ(outside.stop->variable, "elbow");
  EXPECT_EQ(outside.share, 0.0);
  const ToolLine still = along(0.0);
  EXPECT_TRUE(still.complete());
  EXPECT_EQ(still.share, 1.0);
}

/// Two joints keep no orientation, and never leave the plane.
TEST_F(PlanarLine, SaysWhereNoMotionLeads) {
  const ToolLine turned = along(0.5, -3.0, 3.0, {}, {});
  EXPECT_EQ(turned.stop->reason, Reason::Unreachable);
  const ToolLinePlanner planner(checker_, {.body = "tip"});
  Workspace workspace(*checker_);
  Isometry3d goal = planner.pose(start());
  goal.translation().z() += 0.1;
  const ToolLine lifted = planner.plan(start(), goal, workspace, {.angle = kPi});
  EXPECT_EQ(lifted.stop->reason, Reason::Unreachable);
  // The tool may leave the line by 1 mm.
  EXPECT_LT(lifted.share, 0.02);
}

TEST_F(PlanarLine, RefusesBadInput) {
  along(0.1);
  EXPECT_EQ(messageOf([] { ToolLinePlanner(nullptr, {}); }), "ToolLinePlanner: no checker given");
  const auto made = [this](const ConstraintFrame& tool) {
    return messageOf([&] { ToolLinePlanner(checker_, tool); });
  };
  EXPECT_EQ(made({}), "ToolLinePlanner: the tool is fixed in the model frame");
  EXPECT_EQ(made({.body = "tap"}),
            "ToolLinePlanner: 'tap' is no link and no attached body; did you mean 'tip'?");
  EXPECT_EQ(made({.body = "base"}), "InverseKinematics: group 'all' does not move link 'base'");
  Isometry3d sheared = Isometry3d::Identity();
  sheared.linear()(0, 1) = 0.1;
  EXPECT_EQ(made({.body = "tip", .body_from_frame = sheared}),
            "ToolLinePlanner: the tool is not a rigid transform");
  const ToolLinePlanner planner(checker_, {.body = "tip"});
  Workspace workspace(*checker_);
  const auto planned = [&](const Isometry3d& goal, const ToolLineOptions& options) {
    return messageOf([&] { planner.plan(start(), goal, workspace, options); });
  };
  EXPECT_EQ(planned(sheared, {}), "ToolLinePlanner: the goal is not a rigid transform");
  const Isometry3d goal = planner.pose(start());
  EXPECT_EQ(planned(goal, {.position = 0.0}),
            "ToolLinePlanner: the allowed deviation of the position is 0 m; it must be above 0");
  EXPECT_EQ(planned(goal, {.angle = std::nan("")}),
            "ToolLinePlanner: the allowed deviation of the orientation is nan rad; it must be "
            "above 0");
  EXPECT_EQ(planned(goal, {.leastStep = -1.0}),
            "ToolLinePlanner: the least step is -1 m; it must be above 0");
  EXPECT_EQ(planned(goal, {.maxWayPoints = 1}),
            "ToolLinePlanner: the largest number of way points is 1; it must be at least 2");
}

/// The pose of a link, from the frames and axes of the robot's joints alone. All joints turn.
Isometry3d poseOf(const Robot& robot, const Group& group, int link, const std::vector<double>& q) {
  for (const Joint& joint : robot.joints()) {
    if (joint.childLink != link) continue;
    double value = 0.0;
    if (joint.firstVariable >= 0) {
      const auto at = std::ranges::find(group.variables, joint.firstVariable);
      value = at == group.variables.end()
                  ? robot.defaultState()[joint.firstVariable]
                  : q[static_cast<std::size_t>(at - group.variables.begin())];
    }
    Isometry3d own = joint.parent_from_joint;
    if (joint.type == JointType::Prismatic)
      own.translate(value * joint.axis);
    else if (joint.type != JointType::Fixed)
      own.rotate(AngleAxisd(value, joint.axis));
    return joint.parentLink < 0 ? own : poseOf(robot, group, joint.parentLink, q) * own;
  }
  return Isometry3d::Identity();
}

struct Seen {
  double position = 0.0, angle = 0.0;
};

/// By samples at most 1e-3 rad apart.
Seen sampledAlong(const Checker& checker, int link, const Isometry3d& link_from_tool,
                  const ToolLine& line, Workspace& workspace) {
  Seen seen;
  const Vector3d p0 = line.model_from_start.translation();
  const Vector3d way = line.model_from_goal.translation() - p0;
  const Quaterniond r0(line.model_from_start.linear()), r1(line.model_from_goal.linear());
  for (std::size_t i = 1; i < line.wayPoints.size(); ++i) {
    const std::vector<double>&from = line.wayPoints[i - 1], &to = line.wayPoints[i];
    const auto point = [&](double t) { return checker.interpolate(from, to, t); };
    const double s0 = line.shares[i - 1], s1 = line.shares[i];
    const double change = (Eigen::Map<const Eigen::VectorXd>(to.data(), std::ssize(to)) -
                           Eigen::Map<const Eigen::VectorXd>(from.data(), std::ssize(from)))
                              .cwiseAbs()
                              .maxCoeff();
    const int count = std::min(2000, static_cast<int>(std::ceil(change / 1e-3)) + 1);
    for (int k = 0; k <= count; ++k) {
      const double t = static_cast<double>(k) / count;
      const Eigen::VectorXd q = point(t);
      const std::vector<double> values(q.begin(), q.end());
      const Isometry3d pose =
          poseOf(checker.robot(), checker.group(), link, values) * link_from_tool;
      const double near =
          way.squaredNorm() > 0.0
              ? std::clamp((pose.translation() - p0).dot(way) / way.squaredNorm(), s0, s1)
              : s0;
      seen.position = std::max(seen.position, (pose.translation() - p0 - near * way).norm());
      seen.angle = std::max(
          seen.angle, Quaterniond(pose.linear()).angularDistance(r0.slerp(s0 + t * (s1 - s0), r1)));
      EXPECT_NE(checker.checkState(values, workspace), Verdict::Collision);
      EXPECT_TRUE(checker.withinLimits(values));
    }
  }
  return seen;
}

TEST(ToolLines, KeepWhatTheyProve) {
  std::mt19937 random(7);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::map<Reason, int> stops;
  int lines = 0, complete = 0, near = 0;
  for (const auto& [name, scene] : {std::pair{"rook7", "shelf"}, std::pair{"rook6", "bin"}}) {
    const auto robot = test::modelRobot(name);
    const auto world = std::make_shared<const World>(
        PlanningScene::load(modelsDir() + "/scenes/" + scene + ".yaml", *robot).world);
    const auto checker = std::make_shared<const Checker>(robot, "arm", world);
    const int link = checker->group().tipLink;
    Isometry3d link_from_tool(Eigen::Translation3d(0.02, 0.0, 0.1));
    link_from_tool.rotate(AngleAxisd(0.7, Vector3d(1.0, 2.0, -1.0).normalized()));
    const ToolLinePlanner planner(checker,
                                  {.body = robot->links()[static_cast<std::size_t>(link)].name,
                                   .body_from_frame = link_from_tool});
    Workspace workspace(*checker);
    for (int i = 0; i < 60;) {
      std::vector<double> q;
      for (const int v : checker->group().variables) {
        const Variable& variable = robot->variables()[static_cast<std::size_t>(v)];
        q.push_back(uniform(std::max(variable.lower, -kPi), std::min(variable.upper, kPi)));
      }
      if (checker->checkState(q, workspace) != Verdict::Free) continue;
      ++i;
      Isometry3d goal = planner.pose(q);
      goal.pretranslate(uniform(0.05, 0.5) *
                        Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized());
      if (i % 3 == 0)
        goal.rotate(AngleAxisd(uniform(0.1, 1.5),
                               Vector3d(uniform(-1, 1), uniform(-1, 1), 0.3).normalized()));
      const ToolLineOptions options =
          i % 4 == 0 ? ToolLineOptions{.position = 1e-4, .angle = 2e-3} : ToolLineOptions{};
      const ToolLine line = planner.plan(q, goal, workspace, options);
      ++lines;
      complete += line.complete() ? 1 : 0;
      if (line.stop) ++stops[line.stop->reason];
      EXPECT_EQ(line.complete(), line.share == 1.0);
      EXPECT_LE(line.position, options.position);
      EXPECT_LE(line.angle, options.angle);
      const Seen seen = sampledAlong(*checker, link, link_from_tool, line, workspace);
      EXPECT_LE(seen.position, line.position + 1e-12) << name << i;
      EXPECT_LE(seen.angle, line.angle + 1e-7) << name << i;
      near += seen.position > 0.3 * options.position || seen.angle > 0.3 * options.angle ? 1 : 0;
      if (line.complete()) {
        const Isometry3d end = planner.pose(line.wayPoints.back());
        EXPECT_LT((end.translation() - goal.translation()).norm(), 1e-6);
      }
    }
  }
  std::cout << lines << " lines, " << complete << " complete, " << near
            << " that use a third of what is allowed";
  for (const auto& [reason, count] : stops) std::cout << ", " << toString(reason) << ' ' << count;
  std::cout << std::endl;
  EXPECT_GT(complete, lines / 5);
  EXPECT_GT(near, lines / 3);
  for (const Reason reason : {Reason::Limit, Reason::Singularity, Reason::Contact})
    EXPECT_GT(stops[reason], 0) << toString(reason);
}

}  // namespace
}  // namespace swept
