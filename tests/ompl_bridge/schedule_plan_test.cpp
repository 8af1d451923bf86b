// SPDX-License-Identifier: BSD-3-Clause
// Schedules that are planned: truths by hand for sliding cubes, samples that refute, and messages.
#include "swept/ompl_bridge/schedule_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <random>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "crossing_robot.hpp"
#include "message_of.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/work_cell.hpp"

namespace swept {
namespace {

using test::messageOf;
using Status = PlannedSchedule::Status;

constexpr double kFast = 1.0;    // m/s
constexpr double kQuick = 10.0;  // m/s^2

std::string slide(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& axis, double reach = 3.0) {
  return "<joint name='" + name + "' type='prismatic'><parent link='" + parent +
         "'/><child link='" + child + "'/><axis xyz='" + axis + "'/><limit lower='-" +
         std::to_string(reach) + "' upper='" + std::to_string(reach) +
         "' effort='1' velocity='1'/></joint>";
}

std::string cube(const std::string& name) {
  return "<link name='" + name +
         "'><collision><geometry><box size='0.2 0.2 0.2'/></geometry></collision></link>";
}

std::string group(const std::string& name, const std::vector<std::string>& joints) {
  std::string text = "<group name='" + name + "'>";
  for (const std::string& joint : joints) text += "<joint name='" + joint + "'/>";
  return text + "</group>";
}

/// Cubes of 0.2 m: `east` slides along x, `north` along y, through one another at the origin.
std::shared_ptr<const Robot> crossing() {
  return Robot::parse(test::crossingUrdf({{"east", "1 0 0"}, {"north", "0 1 0"}}), "crossing.urdf",
                      "<robot name='crossing'>" + group("east", {"east"}) +
                          group("north", {"north"}) + group("both", {"east", "north"}) + "</robot>",
                      "crossing.srdf");
}

/// Such cubes on one plane, each of which slides along x and y, by so much from 0 (m). `all`: the
/// group of them all.
std::shared_ptr<const Robot> planeOf(const std::vector<std::string>& cubes, const std::string& all,
                                     double alongX, double alongY) {
  std::string links = "<link name='base'/>", joints, groups;
  std::vector<std::string> names;
  for (const std::string& one : cubes) {
    links += "<link name='" + one + "_rail'/>" + cube(one);
    joints += slide(one + "_x", "base", one + "_rail", "1 0 0", alongX) +
              slide(one + "_y", one + "_rail", one, "0 1 0", alongY);
    groups += group(one, {one + "_x", one + "_y"});
    names.insert(names.end(), {one + "_x", one + "_y"});
  }
  groups += group(all, names);
  return Robot::parse("<robot name='plane'>" + links + joints + "</robot>", "plane.urdf",
                      "<robot name='plane'>" + groups + "</robot>", "plane.srdf");
}

std::shared_ptr<const Robot> plane(double alongX = 3.0, double alongY = 3.0) {
  return planeOf({"a", "b"}, "both", alongX, alongY);
}
std::shared_ptr<const Robot> threeOnAPlane() {
  return planeOf({"a", "b", "c"}, "all", 3.0, 3.0);
}

Checker checkerOf(const std::shared_ptr<const Robot>& robot, World world = {}) {
  return {robot, "both", std::make_shared<World>(std::move(world))};
}

RateLimits limits(std::size_t size, double velocity = kFast, double acceleration = kQuick) {
  return {std::vector<double>(size, velocity), std::vector<double>(size, acceleration),
          std::vector<double>(size, std::numeric_limits<double>::infinity())};
}

ScheduleTask pass(const std::string& name) {
  return {.group = name, .start = {-1.0}, .goals = {{1.0}}, .limits = limits(1)};
}

/// A schedule is what it should be: proven, within limits, and it begins and ends where it should.
void expectSound(const Checker& checker, const std::vector<ScheduleTask>& tasks,
                 const PlannedSchedule& found) {
  ASSERT_EQ(found.status, Status::Found) << toString(found.status);
  ASSERT_EQ(found.curves.size(), tasks.size());
  ASSERT_TRUE(found.certificate);
  EXPECT_EQ(found.certificate->verdict, Verdict::Free);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const PiecewisePolynomial& curve = found.curves[i].curve;
    const auto size = static_cast<Eigen::Index>(tasks[i].start.size());
    EXPECT_EQ(curve.begin(), 0.0);
    for (Eigen::Index v = 0; v < size; ++v) {
      EXPECT_NEAR(curve.position(0.0)[v], tasks[i].start[static_cast<std::size_t>(v)], 1e-12);
      EXPECT_NEAR(curve.velocity(0.0)[v], 0.0, 1e-9);
      EXPECT_NEAR(curve.velocity(curve.end())[v], 0.0, 1e-7);
    }
    const Eigen::VectorXd end = curve.position(curve.end());
    EXPECT_TRUE(std::ranges::any_of(tasks[i].goals, [&](const std::vector<double>& goal) {
      return (end - Eigen::Map<const Eigen::VectorXd>(goal.data(), size)).norm() < 1e-9;
    }));
    const Group& own = *checker.robot().findGroup(tasks[i].group);
    const Checker alone(std::shared_ptr<const Robot>(std::shared_ptr<void>(), &checker.robot()),
                        own.name, std::make_shared<World>());
    Workspace workspace(alone);
    EXPECT_TRUE(
        alone.certifyTrajectory(curve, workspace, {.limits = tasks[i].limits}).violations.empty());
  }
}

double arrival(const PlannedSchedule& found, std::size_t task) {
  return found.curves[task].curve.end();
}

Eigen::VectorXd at(const ScheduledCurve& curve, double time) {
  return curve.curve.position(time);
}

double lastArrival(const PlannedSchedule& found) {
  double last = 0.0;
  for (const ScheduledCurve& curve : found.curves) last = std::max(last, curve.curve.end());
  return last;
}

TEST(SchedulePlan, WhoWaitsAtACrossingIsKnownByHand) {
  const Checker checker = checkerOf(crossing());
  const std::vector<ScheduleTask> tasks{pass("east"), pass("north")};
  const PlannedSchedule found = planSchedule(checker, tasks);
  expectSound(checker, tasks, found);
  EXPECT_EQ(found.order, (std::vector<std::size_t>{0, 1}));
  // Alone: 2 m at 1 m/s, and 0.1 s to reach this speed and to stop.
  EXPECT_GE(arrival(found, 0), 2.1);
  EXPECT_LE(arrival(found, 0), 2.15);
  // The first leaves the crossing, 0.2 m behind the origin, 0.9 m before its goal, which takes it
  // 0.95 s. The second needs as long from 0.2 m before the origin, and the 0.3 m between.
  EXPECT_GE(arrival(found, 1), arrival(found, 0) + 0.4 - 1e-3);
  EXPECT_LE(arrival(found, 1), arrival(found, 0) + 0.7);
  for (double time = 0.0; time < lastArrival(found); time += 1e-3) {
    const bool both = std::abs(at(found.curves[0], time)[0]) < 0.2 &&
                      std::abs(at(found.curves[1], time)[0]) < 0.2;
    ASSERT_FALSE(both) << time;
  }
}

TEST(SchedulePlan, ARobotIsPlannedBesideAKnownCurve) {
  const Checker checker = checkerOf(crossing());
  // It comes to the origin at 0.9 s, stays there until 5 s, and goes back.
  const JointTrajectory north{.variables = {"north"},
                              .points = {{0.0, {-1.0}, {0.0}, {}},
                                         {0.9, {0.0}, {0.0}, {}},
                                         {5.0, {0.0}, {0.0}, {}},
                                         {6.0, {-1.0}, {0.0}, {}}}};
  const std::vector<ScheduledCurve> known{
      {.variables = {"north"}, .curve = controllerCurve(north)}};
  const std::vector<ScheduleTask> tasks{pass("east")};
  const PlannedSchedule found = planSchedule(checker, tasks, known);
  expectSound(checker, tasks, found);
  // Nothing passes before 5 s, from 0.2 m before the origin; 1.25 s remain from there.
  EXPECT_GE(arrival(found, 0), 5.0 + 1.2);
  EXPECT_LE(arrival(found, 0), 6.0 + 1.5);
  EXPECT_LE(at(found.curves[0], 5.0)[0], -0.2);

  const PlannedSchedule late =
      planSchedule(checker, tasks, known, {}, {.seconds = 0.3, .latest = 6.0});
  EXPECT_EQ(late.status, Status::NotFound);
  EXPECT_FALSE(late.found());
}

TEST(SchedulePlan, EachMayBeLateByTheDelay) {
  const Checker checker = checkerOf(crossing());
  const std::vector<ScheduleTask> tasks{pass("east"), pass("north")};
  constexpr double kDelay = 0.5;
  const PlannedSchedule found = planSchedule(checker, tasks, {}, {}, {.delay = kDelay});
  expectSound(checker, tasks, found);
  ASSERT_EQ(found.delays.size(), 2U);
  for (const DelayCertificate& delay : found.delays) {
    EXPECT_EQ(delay.verdict, Verdict::Free);
    EXPECT_EQ(delay.proven, kDelay);
  }
  // Without one, the second arrives 0.4 s after the first; a tube needs a little more.
  EXPECT_GE(arrival(found, 1), arrival(found, 0) + 0.4 + kDelay - 1e-3);
  EXPECT_LE(arrival(found, 1), arrival(found, 0) + 0.7 + kDelay);
  for (double late = 0.0; late <= kDelay; late += 0.05) {
    for (std::size_t who = 0; who < 2; ++who) {
      std::vector<ScheduledCurve> curves = found.curves;
      curves[who].start += late;
      EXPECT_EQ(certifySchedule(checker, curves).verdict, Verdict::Free) << who << ' ' << late;
    }
  }
  std::vector<ScheduledCurve> later = found.curves;
  later[0].start += kDelay + 0.4;
  EXPECT_EQ(certifySchedule(checker, later).verdict, Verdict::Collision);
}

TEST(SchedulePlan, EachMayBeSlowAndLate) {
  const Checker checker = checkerOf(crossing());
  const std::vector<ScheduleTask> tasks{pass("east"), pass("north")};
  for (const double delay : {0.0, 0.3}) {
    constexpr double kSlowest = 1.25;
    const PlannedSchedule found =
        planSchedule(checker, tasks, {}, {}, {.delay = delay, .slowest = kSlowest});
    expectSound(checker, tasks, found);
    ASSERT_EQ(found.delays.size(), 2U);
    for (const DelayCertificate& each : found.delays) {
      EXPECT_EQ(each.verdict, Verdict::Free);
      EXPECT_EQ(each.proven, delay);
    }
    // The first leaves the crossing 0.95 s before it arrives, a quarter later if it is slow, and
    // late. The second comes to it no sooner, and needs 1.35 s from there.
    const double soonest = delay + kSlowest * (arrival(found, 0) - 0.95) + 1.35;
    EXPECT_GE(arrival(found, 1), soonest - 1e-3);
    EXPECT_LE(arrival(found, 1), soonest + 0.3);
    for (std::size_t who = 0; who < 2; ++who)
      for (double late = 0.0; late <= delay; late += 0.05)
        for (double slower = 1.0; slower <= kSlowest; slower += 0.01)
          for (double time = 0.0; time < lastArrival(found) + 2.0; time += 2e-3) {
            const double x = at(found.curves[who], (time - late) / slower)[0];
            const double y = at(found.curves[1 - who], time)[0];
            ASSERT_FALSE(std::abs(x) < 0.2 && std::abs(y) < 0.2)
                << who << ' ' << late << ' ' << slower << ' ' << time;
          }
    std::vector<ScheduledCurve> slower = found.curves;
    slower[0].slowdown = 1.6;
    EXPECT_EQ(certifySchedule(checker, slower).verdict, Verdict::Collision);
  }
}

TEST(SchedulePlan, EachMayBeLateWhileAnObstacleIsNot) {
  // The cart passes the origin at 2 s, along z: `east` and `north` pass before or after it.
  const auto height = [](double z) { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, z)); };
  World world;
  world.add({.name = "cart",
             .parts = {{makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}},
             .waypoints = {{0.0, height(-2.0)}, {4.0, height(2.0)}}});
  const Checker checker = checkerOf(crossing(), std::move(world));
  const std::vector<ScheduleTask> tasks{pass("east"), pass("north")};
  constexpr double kDelay = 0.5;
  const PlannedSchedule found = planSchedule(checker, tasks, {}, {}, {.delay = kDelay});
  expectSound(checker, tasks, found);
  ASSERT_EQ(found.delays.size(), 2U);
  for (const DelayCertificate& delay : found.delays) EXPECT_EQ(delay.proven, kDelay);
  // At the origin while the cart is there, with some delay or with none.
  int near = 0;
  for (std::size_t who = 0; who < 2; ++who) {
    for (double late = 0.0; late <= kDelay; late += 0.01) {
      for (double time = 0.0; time < 10.0; time += 1e-3) {
        const double cart = std::clamp(time - 2.0, -2.0, 2.0);
        const double x = at(found.curves[who], time - late)[0];
        ASSERT_FALSE(std::abs(x) < 0.2 && std::abs(cart) < 0.2) << who << ' ' << late;
        near += std::abs(x) < 0.2 && std::abs(cart) < 0.9 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(near, 0);  // it does not just wait until all is over
}

TEST(SchedulePlan, AGoalIsReachedOnceAnObstacleHasLeftIt) {
  const auto at = [](double y) { return Eigen::Isometry3d(Eigen::Translation3d(1.0, y, 0.0)); };
  World world;
  world.add({.name = "cart",
             .parts = {{makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}},
             .waypoints = {{0.0, at(0.0)}, {4.0, at(0.0)}, {5.0, at(1.0)}}});
  const Checker checker = checkerOf(crossing(), std::move(world));
  const std::vector<double> still{0.0, -3.0};
  const std::vector<ScheduleTask> tasks{pass("east")};
  const PlannedSchedule found = planSchedule(checker, tasks, {}, still);
  expectSound(checker, tasks, found);
  EXPECT_GE(arrival(found, 0), 4.2);  // when it is 0.2 m away
  EXPECT_LE(arrival(found, 0), 5.0);
}

TEST(SchedulePlan, TwoRobotsExchangeTheirPlaces) {
  const Checker checker = checkerOf(plane());
  const std::vector<ScheduleTask> tasks{
      {.group = "a", .start = {-0.5, 0.0}, .goals = {{0.5, 0.0}}, .limits = limits(2)},
      {.group = "b", .start = {0.5, 0.0}, .goals = {{-0.5, 0.0}}, .limits = limits(2)}};
  const PlannedSchedule found = planSchedule(checker, tasks);
  expectSound(checker, tasks, found);
  for (double time = 0.0; time < lastArrival(found); time += 1e-3) {
    const Eigen::VectorXd apart = at(found.curves[0], time) - at(found.curves[1], time);
    ASSERT_GE(apart.array().abs().maxCoeff(), 0.2) << time;
  }
  // Each goes a metre; one of them around the other.
  EXPECT_LE(lastArrival(found), 3.0);
}

/// An aisle along x, 0.3 m wide, with a bay of 0.4 m by 0.4 m beside its middle.
World aisle() {
  World world;
  const auto wall = [&](const std::string& name, double x0, double x1, double y0, double y1) {
    world.add(name, makeBox({x1 - x0, y1 - y0, 0.2}),
              Eigen::Isometry3d(Eigen::Translation3d(0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.0)));
  };
  wall("south", -3.2, 3.2, -0.35, -0.15);
  wall("west", -3.2, -0.2, 0.15, 0.75);
  wall("east", 0.2, 3.2, 0.15, 0.75);
  wall("north", -0.2, 0.2, 0.55, 0.75);
  return world;
}

/// An aisle along x from 0 on, 0.3 m wide and closed at 1.6 m.
World aisleWithOneEnd() {
  World world;
  const auto wall = [&](const std::string& name, double x0, double x1, double y0, double y1) {
    world.add(name, makeBox({x1 - x0, y1 - y0, 0.2}),
              Eigen::Isometry3d(Eigen::Translation3d(0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.0)));
  };
  wall("south", 0.0, 1.8, -3.2, -0.15);
  wall("north", 0.0, 1.8, 0.15, 3.2);
  wall("end", 1.6, 1.8, -0.15, 0.15);
  return world;
}

TEST(SchedulePlan, TheFirstWaitsWhereTwoMeetInAnAisle) {
  // Whoever goes first at once is in the middle before the other can be in the bay.
  const Checker checker = checkerOf(plane(1.2, 0.45), aisle());
  const std::vector<ScheduleTask> tasks{
      {.group = "a", .start = {-1.0, 0.0}, .goals = {{1.0, 0.0}}, .limits = limits(2)},
      {.group = "b", .start = {1.0, 0.0}, .goals = {{-1.0, 0.0}}, .limits = limits(2)}};
  const PlannedSchedule found = planSchedule(checker, tasks);
  expectSound(checker, tasks, found);
  double highest = 0.0;
  for (double time = 0.0; time < lastArrival(found); time += 1e-3) {
    const Eigen::VectorXd apart = at(found.curves[0], time) - at(found.curves[1], time);
    ASSERT_GE(apart.array().abs().maxCoeff(), 0.2) << time;
    highest = std::max({highest, at(found.curves[0], time)[1], at(found.curves[1], time)[1]});
  }
  EXPECT_GE(highest, 0.15);  // one of them was in the bay
}

TEST(SchedulePlan, ThreeGoIntoAnAisleInTheOnlyOrder) {
  // The goals of `b`, `c` and `a` are behind each other in an aisle that has one end. `a` is there
  // soonest, and `c` sooner than `b`. In any other order one has to wait for those after it.
  const Checker checker(threeOnAPlane(), "all", std::make_shared<World>(aisleWithOneEnd()));
  const std::vector<ScheduleTask> tasks{
      {.group = "a", .start = {-0.5, 0.5}, .goals = {{0.3, 0.0}}, .limits = limits(2, 1.0)},
      {.group = "b", .start = {-0.5, 0.0}, .goals = {{1.3, 0.0}}, .limits = limits(2, 0.25)},
      {.group = "c", .start = {-0.5, -0.5}, .goals = {{0.8, 0.0}}, .limits = limits(2, 0.5)}};
  const PlannedSchedule found =
      planSchedule(checker, tasks, {}, {}, {.seconds = 12.0, .improvements = 100});
  expectSound(checker, tasks, found);
  EXPECT_EQ(found.order, (std::vector<std::size_t>{1, 2, 0}));
}

/// A comb of two teeth, 2 m and 2.1 m behind its place, slides along x; a cube slides along y
/// through the lines of both.
std::shared_ptr<const Robot> comb() {
  const auto tooth = [](double x, double y) {
    return "<collision><origin xyz='" + std::to_string(x) + " " + std::to_string(y) +
           " 0'/><geometry><box size='0.8 0.4 0.2'/></geometry></collision>";
  };
  return Robot::parse(
      "<robot name='comb'><link name='base'/><link name='comb'>" + tooth(-2.0, 1.0) +
          tooth(-2.1, 0.0) + "</link>" + cube("ball") + slide("along", "base", "comb", "1 0 0") +
          slide("through", "base", "ball", "0 1 0") + "</robot>",
      "comb.urdf",
      "<robot name='comb'>" + group("comb", {"along"}) + group("ball", {"through"}) +
          group("both", {"along", "through"}) + "</robot>",
      "comb.srdf");
}

TEST(SchedulePlan, TheFirstWaitsWhereEachGoalIsInTheWayOfTheOther) {
  // The ball ends in the line of the one tooth, the comb with the other tooth in the ball's line.
  // So the ball goes between the lines, the comb to its goal, and the ball to its own.
  const Checker checker = checkerOf(comb());
  std::vector<ScheduleTask> tasks{
      {.group = "comb", .start = {0.0}, .goals = {{2.55}}, .limits = limits(1)},
      {.group = "ball", .start = {-1.55}, .goals = {{1.0}}, .limits = limits(1)}};
  for (int turn = 0; turn < 2; ++turn) {
    const PlannedSchedule found = planSchedule(checker, tasks);
    expectSound(checker, tasks, found);
    std::ranges::reverse(tasks);
  }
}

TEST(SchedulePlan, WhoCannotStayAtItsStartIsNotTheOneThatWaits) {
  // The same, and a press comes down where the ball starts: it is there from 1 s on.
  const auto height = [](double z) {
    return Eigen::Isometry3d(Eigen::Translation3d(0.0, -1.55, z));
  };
  World world;
  world.add({.name = "press",
             .parts = {{makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}},
             .waypoints = {{0.0, height(1.2)}, {1.2, height(0.0)}}});
  const Checker checker = checkerOf(comb(), std::move(world));
  const std::vector<ScheduleTask> tasks{
      {.group = "ball", .start = {-1.55}, .goals = {{1.0}}, .limits = limits(1)},
      {.group = "comb", .start = {0.0}, .goals = {{2.55}}, .limits = limits(1)}};
  const PlannedSchedule found = planSchedule(checker, tasks);
  expectSound(checker, tasks, found);
  EXPECT_EQ(found.order, (std::vector<std::size_t>{1, 0}));
  EXPECT_GE(at(found.curves[0], 1.0)[0], -1.35);
  EXPECT_EQ(at(found.curves[1], 1.0)[0], 0.0);
}

TEST(SchedulePlan, ManyOnOnePlaneAreProvenAndTheirSamplesApart) {
  const Checker checker = checkerOf(plane());
  std::mt19937 random(7);
  const auto coordinate = [&] { return 0.1 * static_cast<double>(random() % 13) - 0.6; };
  int solved = 0, together = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<ScheduleTask> tasks;
    for (const char* name : {"a", "b"}) {
      tasks.push_back({.group = name,
                       .start = {coordinate(), coordinate()},
                       .goals = {{coordinate(), coordinate()}},
                       .limits = limits(2, 0.5 + 0.1 * static_cast<double>(random() % 10), 5.0)});
    }
    const PlannedSchedule found =
        planSchedule(checker, tasks, {}, {}, {.seconds = 1.0, .improvements = 200});
    const auto apart = [](const std::vector<double>& p, const std::vector<double>& q) {
      return std::max(std::abs(p[0] - q[0]), std::abs(p[1] - q[1]));
    };
    if (apart(tasks[0].start, tasks[1].start) < 0.2 - 1e-9) {
      EXPECT_EQ(found.status, Status::StartNotFree);
      continue;
    }
    if (apart(tasks[0].goals[0], tasks[1].goals[0]) < 0.2 - 1e-9) {
      EXPECT_EQ(found.status, Status::GoalNotFree);
      continue;
    }
    if (!found.found()) continue;  // touching
    ++solved;
    expectSound(checker, tasks, found);
    double least = 10.0;
    for (double time = 0.0; time < lastArrival(found); time += 1e-3) {
      const Eigen::VectorXd way = at(found.curves[0], time) - at(found.curves[1], time);
      least = std::min(least, way.array().abs().maxCoeff());
    }
    EXPECT_GE(least, 0.2 - 1e-9) << i;
    together += least < 0.3 ? 1 : 0;
  }
  EXPECT_GE(solved, 25);
  EXPECT_GE(together, 5);
}

TEST(SchedulePlan, TwoArmsReachOverOneTable) {
  const auto robot = loadWorkCell(WorkCell::read(modelsDir() + "/cells/two_rooks.yaml"));
  const Checker checker(robot, "both", std::make_shared<World>());
  const std::vector<double> reaching{0, 1.3, 0, 0.3, 0, 0, 0};
  std::vector<ScheduleTask> tasks;
  for (const char* arm : {"left/arm", "right/arm"}) {
    const Group& group = *robot->findGroup(arm);
    const std::vector<double> tucked = namedConfiguration(*robot, group, "tucked");
    const bool reaches = tasks.empty();
    tasks.push_back({.group = arm,
                     .start = reaches ? tucked : reaching,
                     .goals = {reaches ? reaching : tucked},
                     .limits = limits(7, 2.0, 5.0)});
  }
  const PlannedSchedule found = planSchedule(checker, tasks, {}, {}, {.improvements = 300});
  expectSound(checker, tasks, found);
  const Group& both = checker.group();
  Workspace workspace(checker);
  for (double time = 0.0; time < lastArrival(found); time += 1e-2) {
    std::vector<double> q;
    for (const int variable : both.variables) {
      const std::string& name = robot->variables()[static_cast<std::size_t>(variable)].name;
      for (const ScheduledCurve& curve : found.curves) {
        const auto own = std::ranges::find(curve.variables, name);
        if (own != curve.variables.end())
          q.push_back(at(curve, time)[own - curve.variables.begin()]);
      }
    }
    ASSERT_EQ(checker.checkState(q, workspace), Verdict::Free) << time;
  }
}

TEST(SchedulePlan, TheSameSeedGivesTheSameSchedule) {
  const Checker checker = checkerOf(plane());
  const std::vector<ScheduleTask> tasks{
      {.group = "a", .start = {-0.5, 0.0}, .goals = {{0.5, 0.1}}, .limits = limits(2)},
      {.group = "b", .start = {0.5, 0.0}, .goals = {{-0.5, 0.1}}, .limits = limits(2)}};
  const PlannedSchedule one = planSchedule(checker, tasks, {}, {}, {.improvements = 100});
  const PlannedSchedule two = planSchedule(checker, tasks, {}, {}, {.improvements = 100});
  ASSERT_TRUE(one.found() && two.found());
  EXPECT_EQ(one.curves[0].curve.knots(), two.curves[0].curve.knots());
  EXPECT_EQ(one.curves[1].curve.knots(), two.curves[1].curve.knots());
  const PlannedSchedule other =
      planSchedule(checker, tasks, {}, {}, {.improvements = 100, .seed = 5});
  ASSERT_TRUE(other.found());
  EXPECT_NE(one.curves[1].curve.knots(), other.curves[1].curve.knots());
}

TEST(SchedulePlan, ItSaysWhatIsNotFree) {
  World world;
  world.add("post", makeBox({0.2, 0.2, 0.2}),
            Eigen::Isometry3d(Eigen::Translation3d(1.0, 0.0, 0.0)));
  const Checker checker = checkerOf(crossing(), std::move(world));
  const std::vector<double> still{0.0, -3.0};
  const std::vector<ScheduleTask> blocked{pass("east")};
  const PlannedSchedule goal = planSchedule(checker, blocked, {}, still);
  EXPECT_EQ(goal.status, Status::GoalNotFree);
  ASSERT_TRUE(goal.contact);
  EXPECT_EQ(goal.contact->bodyB.str(), "post");
  EXPECT_TRUE(goal.curves.empty());

  std::vector<ScheduleTask> inside{pass("north"), pass("east")};
  inside[1].start = {1.0};
  inside[1].goals = {{-1.0}};
  const PlannedSchedule start = planSchedule(checker, inside);
  EXPECT_EQ(start.status, Status::StartNotFree);
  EXPECT_EQ(start.task, 1U);

  std::vector<ScheduleTask> together{pass("north"), pass("east")};
  for (ScheduleTask& task : together) task.start = {0.0};
  const PlannedSchedule meet = planSchedule(checker, together);
  EXPECT_EQ(meet.status, Status::StartNotFree);
  EXPECT_EQ(meet.task, 0U);

  std::stop_source stop;
  stop.request_stop();
  const std::vector<ScheduleTask> north{pass("north")};
  const PlannedSchedule stopped =
      planSchedule(checker, north, {}, std::vector{-2.0, 0.0}, {.stop = stop.get_token()});
  EXPECT_EQ(stopped.status, Status::NotFound);
}

TEST(SchedulePlan, WhatIsNotAllowedIsNamed) {
  const Checker checker = checkerOf(crossing());
  const std::vector<double> still{0.0, -3.0};
  const auto message = [&](const ScheduleTask& task, const SchedulePlanOptions& options = {}) {
    return messageOf([&] { planSchedule(checker, std::vector{task}, {}, still, options); });
  };
  ScheduleTask task = pass("east");
  EXPECT_EQ(messageOf([&] { planSchedule(checker, {}, {}, still); }),
            "planSchedule: there is no task");
  EXPECT_EQ(messageOf([&] { planSchedule(checker, std::vector{task}); }),
            "planSchedule: nothing says where 'north' is");
  EXPECT_EQ(messageOf([&] {
              planSchedule(checker, std::vector{task, task}, {}, still);
            }),
            "planSchedule: two tasks move 'east'");
  EXPECT_EQ(messageOf([&] { planSchedule(checker, std::vector{task}, {}, std::vector{1.0}); }),
            "planSchedule: the configuration has 1 values, expected 2");
  task.group = "west";
  EXPECT_EQ(message(task), "planSchedule: task 1: there is no group 'west'");
  task = pass("east");
  task.start = {0.0, 1.0};
  EXPECT_EQ(message(task), "planSchedule: task 1 has 2 values of a start, expected 1");
  task.start = {3.5};
  EXPECT_EQ(message(task), "planSchedule: task 1: the start's east is 3.5, allowed is -3 to 3 m");
  task.start = {std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(message(task), "planSchedule: task 1: the start's value of 'east' is not finite");
  task = pass("east");
  task.goals = {};
  EXPECT_EQ(message(task), "planSchedule: task 1 has no goal");
  task = pass("east");
  task.limits.acceleration = {std::numeric_limits<double>::infinity()};
  EXPECT_EQ(message(task),
            "planSchedule: task 1: the limit of acceleration of 'east' is inf; allowed are finite "
            "numbers above 0");
  task.limits.acceleration = {};
  EXPECT_EQ(message(task), "planSchedule: task 1 has 0 limits of acceleration, expected 1");
  task = pass("east");
  EXPECT_EQ(message(task, {.seconds = 0.0}),
            "planSchedule: seconds is 0; allowed are finite numbers above 0");
  EXPECT_EQ(message(task, {.latest = -1.0}),
            "planSchedule: latest is -1 s; allowed are numbers above 0");
  EXPECT_EQ(message(task, {.improvements = -1}),
            "planSchedule: improvements is -1; allowed are 0 and more");
  EXPECT_EQ(message(task, {.delay = -1.0}),
            "planSchedule: delay is -1 s; allowed are finite numbers from 0 on");
  EXPECT_EQ(message(task, {.slowest = 0.9}),
            "planSchedule: slowest is 0.9; allowed are finite numbers from 1 on");
}

}  // namespace
}  // namespace swept
