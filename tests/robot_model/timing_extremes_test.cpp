// SPDX-License-Identifier: BSD-3-Clause
// Paths and limits at their extremes, kinds of joints, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "message_of.hpp"
#include "path_robot.hpp"
#include "timed_paths.hpp"

namespace swept {
namespace {

using Eigen::VectorXd;
using test::WayPoints;

constexpr double kPi = std::numbers::pi;
constexpr double kNone = std::numeric_limits<double>::infinity();

TimedPath timedOf(const WayPoints& path, const RateLimits& limits,
                  const TimingOptions& options = {}) {
  const auto robot = test::chainRobot(static_cast<int>(path[0].size()));
  TimedPath timed = timeParameterize(*robot, robot->groups()[0], path, limits, {}, options);
  test::expectWellTimed(timed, path, limits, options);
  return timed;
}

/// Steps from 1e-9 to 1e3 rad, limits from 1e-3 to 1e6, way points that repeat, lie on lines and
/// turn back, joints that stay.
TEST(TimingExtremes, KeepLimits) {
  std::mt19937 random(130);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  int blended = 0;
  int tiny = 0;
  for (int round = 0; round < 400; ++round) {
    SCOPED_TRACE(round);
    const int joints = 1 + round % 9;
    RateLimits limits = test::sameLimits(joints, 1.0, 1.0, 1.0);
    for (auto* rate : {&limits.velocity, &limits.acceleration, &limits.jerk})
      for (double& limit : *rate) limit = std::pow(10.0, uniform(-3.0, 6.0));
    WayPoints path(1, VectorXd::Zero(joints));
    for (double& value : path[0]) value = uniform(-3.0, 3.0);
    VectorXd step = VectorXd::Zero(joints);
    const int count = 2 + round % 29;
    while (std::ssize(path) < count) {
      const int kind = static_cast<int>(uniform(0.0, 8.0));
      if (kind == 0) step.setZero();
      if (kind == 1) step = -step;
      if (kind == 2) step = 3.0 * step;
      if (kind > 2) {
        const double size = std::pow(10.0, uniform(-9.0, 3.0));
        for (double& value : step) value = uniform(0.0, 1.0) < 0.3 ? 0.0 : uniform(-size, size);
        tiny += size < 1e-6;
      }
      path.push_back(path.back() + step);
    }
    TimingOptions options;
    options.jerkLimited = round % 2 == 1;
    for (const TimedCorner& corner : timedOf(path, limits, options).corners)
      blended += !corner.stops();
  }
  EXPECT_GT(blended, 1000);
  EXPECT_GT(tiny, 500);
}

TEST(TimingExtremes, OfOneTinyStep) {
  for (const double size : {1e-9, 1e-12, 1e-15, 1e-30, 1e-300})
    for (const double limit : {1e-3, 1.0, 1e6}) {
      const WayPoints path{VectorXd{{0.0, 0.0}}, VectorXd{{size, -size}}};
      for (const bool jerkLimited : {false, true}) {
        TimingOptions options;
        options.jerkLimited = jerkLimited;
        EXPECT_LT(timedOf(path, test::sameLimits(2, limit, limit, limit), options).curve.duration(),
                  0.1);
      }
    }
}

TEST(TimingExtremes, OfALineIsOneStraightMotion) {
  const RateLimits limits = test::sameLimits(3, 2.0, 5.0, 50.0);
  WayPoints line;
  for (int i = 0; i <= 300; ++i) line.push_back(0.01 * i * VectorXd{{0.1, -0.7, 0.3}});
  line.insert(line.begin() + 100, line[100]);
  const TimedPath timed = timedOf(line, limits);
  EXPECT_TRUE(timed.corners.empty());
  EXPECT_LE(timed.trajectory.points.size(), 4U);
  EXPECT_NEAR(timed.curve.duration(), timedOf({line.front(), line.back()}, limits).curve.duration(),
              1e-8);
  for (double t = 0.0; t < timed.curve.end(); t += 0.01)
    EXPECT_LE(test::distanceFrom(line.front(), line.back(), timed.curve.position(t)), 1e-12);
}

TEST(TimingExtremes, LeaveOutWhatIsOnALineToWithinRounding) {
  const RateLimits limits = test::sameLimits(2, 2.0, 5.0, 50.0);
  const auto corners = [&](double off) {
    return timedOf({VectorXd::Zero(2), VectorXd{{0.5, off}}, VectorXd{{1.0, 0.0}}}, limits)
        .corners.size();
  };
  EXPECT_EQ(corners(1e-14), 0U);
  EXPECT_EQ(corners(1e-11), 1U);
  // Each of these is nearly on the line through those before, and all together are not.
  WayPoints bow;
  for (int i = 0; i <= 200; ++i) bow.push_back(VectorXd{{1e-3 * i, 1e-15 * i * i}});
  const TimedPath timed = timedOf(bow, limits);
  EXPECT_GT(timed.corners.size(), 2U);
  EXPECT_LT(timed.corners.size(), 100U);
  double farthest = 0.0;
  for (int k = 0; k <= 2000; ++k)
    farthest = std::max(
        farthest, test::distanceFrom(bow, timed.curve.position(timed.curve.end() * k / 2000.0)));
  EXPECT_LE(farthest, 1e-12);
}

TEST(TimingExtremes, StopWhereThePathTurnsBack) {
  const RateLimits limits = test::sameLimits(2, 2.0, 5.0, 50.0);
  const VectorXd far{{0.3, 0.9}};
  const TimedPath timed = timedOf({VectorXd::Zero(2), far, 0.25 * far, 2.0 * far}, limits);
  ASSERT_EQ(timed.corners.size(), 2U);
  for (const TimedCorner& corner : timed.corners) EXPECT_TRUE(corner.stops());
  EXPECT_EQ(timed.curve.position(timed.corners[0].begin), far);
  // A hair beside that, it need not stop.
  const TimedPath beside =
      timedOf({VectorXd::Zero(2), far, VectorXd{{0.25 * 0.3 + 1e-3, 0.25 * 0.9}}}, limits);
  ASSERT_EQ(beside.corners.size(), 1U);
  EXPECT_FALSE(beside.corners[0].stops());
}

TEST(TimingExtremes, StopWhereTheyAreToldTo) {
  const RateLimits limits = test::sameLimits(2, 2.0, 5.0, 50.0);
  const VectorXd step{{0.3, 0.2}}, side{{0.0, 0.4}};
  // 1 and 4 are on a line, 2 repeats, 5 is a corner.
  const VectorXd start = VectorXd::Zero(2);
  const WayPoints path{start,
                       start + step,
                       start + 2.0 * step,
                       start + 2.0 * step,
                       start + 3.0 * step,
                       start + 4.0 * step,
                       start + 4.0 * step + side};
  for (const bool jerkLimited : {false, true}) {
    TimingOptions options;
    options.jerkLimited = jerkLimited;
    const auto stopsOf = [&](std::vector<std::size_t> stops) {
      options.stops = std::move(stops);
      const TimedPath timed = timedOf(path, limits, options);
      std::vector<std::size_t> found;
      for (const TimedCorner& corner : timed.corners) {
        if (!corner.stops()) continue;
        found.push_back(corner.wayPoint);
        EXPECT_EQ(timed.curve.position(corner.begin), path[corner.wayPoint]);
        EXPECT_EQ(timed.curve.velocity(corner.begin), VectorXd::Zero(2));
      }
      test::expectWellTimed(timed, path, limits, options);
      return found;
    };
    using Indices = std::vector<std::size_t>;
    EXPECT_EQ(stopsOf({}), Indices{});
    EXPECT_EQ(stopsOf({5}), Indices{5});
    EXPECT_EQ(stopsOf({4, 1}), (Indices{1, 4}));
    // Of way points that repeat there is one stop; the ends are stops in any case.
    EXPECT_EQ(stopsOf({2}), Indices{2});
    EXPECT_EQ(stopsOf({3, 0, 6, 3}), Indices{2});
  }
}

TEST(TimingExtremes, OfAPathThatStaysAreAMillisecond) {
  const VectorXd q{{0.5, -0.25}};
  for (const WayPoints& path : {WayPoints{q}, WayPoints{q, q, q}})
    for (const bool jerkLimited : {false, true}) {
      TimingOptions options;
      options.jerkLimited = jerkLimited;
      // Limits do not matter.
      const TimedPath timed = timedOf(path, test::sameLimits(2, kNone, kNone, kNone), options);
      EXPECT_EQ(timed.trajectory.points.size(), 2U);
      EXPECT_EQ(timed.curve.duration(), 1e-3);
      EXPECT_EQ(timed.curve.position(0.4e-3), q);
      EXPECT_TRUE(timed.corners.empty());
    }
}

TEST(TimingExtremes, TakeTheShorterWayOfCyclicVariables) {
  const auto robot = test::pathRobot();  // turn, wheel (without limits), slide
  const Group& group = *robot->findGroup("arm");
  const WayPoints path{VectorXd{{0.0, 3.0, 0.0}}, VectorXd{{0.5, -3.0, 0.5}},
                       VectorXd{{0.0, -1.0, 0.25}}, VectorXd{{0.5, 2.5, 0.5}},
                       VectorXd{{1.0, -2.5, 0.75}}};
  const TimedPath timed =
      timeParameterize(*robot, group, path, test::sameLimits(3, 1.0, 2.0, 20.0));
  const VectorXd end = timed.curve.position(timed.curve.end());
  // 3, 2 pi - 3, 2 pi - 1, back to 2.5, 2 pi - 2.5.
  EXPECT_NEAR(end[1], 2.0 * kPi - 2.5, 1e-12);
  EXPECT_EQ(end[0], 1.0);
  EXPECT_EQ(end[2], 0.75);
  EXPECT_EQ(timed.trajectory.variables, (std::vector<std::string>{"turn", "wheel", "slide"}));
  double highest = 0.0;
  for (double t = 0.0; t < timed.curve.end(); t += 0.01)
    highest = std::max(highest, timed.curve.position(t)[1]);
  EXPECT_GT(highest, 2.0 * kPi - 1.2);
  EXPECT_LT(highest, 2.0 * kPi - 1.0 + 1e-9);
}

TEST(TimingExtremes, MovePlanarJoints) {
  const auto robot = test::pathRobot();
  const Group& group = *robot->findGroup("whole");  // x, y, theta, turn, wheel, slide
  VectorXd from = VectorXd::Zero(6);
  VectorXd to = from;
  to << 1.0, 2.0, 3.0, 0.0, 0.0, 0.0;
  const WayPoints path{from, to};
  const TimedPath timed =
      timeParameterize(*robot, group, path, test::sameLimits(6, 1.0, 2.0, 20.0));
  EXPECT_NEAR(timed.curve.duration(), 3.0 + 0.5, 1e-4);
}

/// A box that flies.
std::shared_ptr<const Robot> flyingRobot() {
  return Robot::parse("<robot name='r'><link name='base'/></robot>", "r.urdf",
                      "<robot name='r'><virtual_joint name='vj' type='floating' "
                      "parent_frame='world' child_link='base'/>"
                      "<group name='g'><joint name='vj'/></group></robot>",
                      "r.srdf");
}

TEST(TimingExtremes, MoveFloatingJointsThatDoNotTurn) {
  const auto robot = flyingRobot();
  const RateLimits limits = test::sameLimits(7, 1.0, 2.0, 20.0);
  VectorXd from = VectorXd::Zero(7);
  from[6] = 1.0;
  VectorXd to = from;
  to[1] = 2.0;
  const Group& group = robot->groups()[0];
  const WayPoints slides{from, to};
  EXPECT_NEAR(timeParameterize(*robot, group, slides, limits).curve.duration(), 2.5, 1e-4);
  to[5] = 0.6;
  to[6] = 0.8;
  const WayPoints turns{from, to};
  EXPECT_EQ(test::messageOf([&] { timeParameterize(*robot, group, turns, limits); }),
            "timeParameterize: vj/rot_z changes to way point 1: an orientation turns by a slerp, "
            "which no trajectory of polynomials follows");
}

TEST(TimingExtremes, NameWhatIsNotAllowed) {
  const auto robot = test::chainRobot(2);
  const WayPoints path{VectorXd{{0.0, 0.0}}, VectorXd{{1.0, 0.0}}, VectorXd{{1.0, 1.0}}};
  const RateLimits limits = test::sameLimits(2, 1.0, 2.0, 20.0);
  const auto of = [&](const WayPoints& points, const RateLimits& rates,
                      const TimingOptions& options = {}) {
    return test::messageOf(
        [&] { timeParameterize(*robot, robot->groups()[0], points, rates, {}, options); });
  };
  EXPECT_EQ(of(path, limits), "");
  EXPECT_EQ(of({}, limits), "timeParameterize: there is no way point");
  EXPECT_EQ(of({path[0], VectorXd::Zero(3)}, limits),
            "timeParameterize: way point 1 has 3 values, expected 2");
  EXPECT_EQ(of({path[0], VectorXd{{0.0, kNone}}}, limits),
            "timeParameterize: j1 of way point 1 is not finite");

  RateLimits rates = limits;
  rates.acceleration[1] = kNone;
  EXPECT_EQ(of(path, rates),
            "timeParameterize: j1 moves from way point 1 to 2 and has no limit of acceleration");
  EXPECT_EQ(of({path[0], path[1]}, rates), "");
  rates.velocity[0] = kNone;
  EXPECT_EQ(of(path, rates),
            "timeParameterize: j0 moves from way point 0 to 1 and has no limit of velocity");
  rates = limits;
  rates.jerk[1] = kNone;
  EXPECT_EQ(of(path, rates), "");
  TimingOptions options;
  options.jerkLimited = true;
  EXPECT_EQ(of(path, rates, options),
            "timeParameterize: j1 moves from way point 1 to 2 and has no limit of jerk");
  rates.jerk[1] = 0.0;
  EXPECT_EQ(of(path, rates), "timeParameterize: the limit of jerk of j1 is 0, allowed is above 0");
  rates.velocity[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(of(path, rates),
            "timeParameterize: the limit of velocity of j0 is nan, allowed is above 0");
  rates.velocity.pop_back();
  EXPECT_EQ(of(path, rates), "timeParameterize: there are 1 limits of velocity, expected 2");

  options = {};
  options.blendDeviation = -1.0;
  EXPECT_EQ(of(path, limits, options),
            "timeParameterize: blendDeviation is -1, allowed is 0 or more");
  options = {};
  options.velocityScale = 1.5;
  EXPECT_EQ(of(path, limits, options),
            "timeParameterize: velocityScale is 1.5, allowed is above 0 and at most 1");
  options = {};
  options.accelerationScale = 0.0;
  EXPECT_EQ(of(path, limits, options),
            "timeParameterize: accelerationScale is 0, allowed is above 0 and at most 1");

  options = {};
  options.stops = {1, 3};
  EXPECT_EQ(of(path, limits, options), "timeParameterize: stop 3 is no way point, there are 3");

  EXPECT_EQ(of({path[0], VectorXd{{1e10, 0.0}}}, limits),
            "timeParameterize: the trajectory takes 2^31 s or more, which no message carries");
  EXPECT_EQ(of({VectorXd{{-1e308, 0.0}}, VectorXd{{1e308, 0.0}}}, limits),
            "timeParameterize: the distance to way point 1 is not finite");
}

}  // namespace
}  // namespace swept
