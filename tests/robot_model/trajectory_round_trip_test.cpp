// SPDX-License-Identifier: BSD-3-Clause
// Random trajectories of each robot and group, written in each format and read again.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "model_robots.hpp"
#include "swept/robot_model/path_file.hpp"
#include "swept/robot_model/trajectory_file.hpp"

namespace swept {
namespace {

/// The bits of all values, so that 0 and -0 differ.
std::vector<std::uint64_t> bitsOf(const std::vector<double>& values) {
  std::vector<std::uint64_t> bits(values.size());
  std::ranges::transform(values, bits.begin(),
                         [](double v) { return std::bit_cast<std::uint64_t>(v); });
  return bits;
}

void expectSameValues(const TrajectoryPoint& read, const TrajectoryPoint& written) {
  EXPECT_EQ(bitsOf(read.positions), bitsOf(written.positions));
  EXPECT_EQ(bitsOf(read.velocities), bitsOf(written.velocities));
  EXPECT_EQ(bitsOf(read.accelerations), bitsOf(written.accelerations));
}

/// What the trajectories had, to tell that they are of all kinds.
struct Seen {
  int beyondLimits = 0, negativeZeros = 0, tiny = 0, huge = 0;
  int withRates = 0, withoutRates = 0, mixed = 0;
  int bases = 0, floating = 0, closeTimes = 0;
};

class RandomTrajectories {
 public:
  explicit RandomTrajectories(unsigned seed) : random_(seed) {}

  JointTrajectory make(const Robot& robot, const Group& group) {
    JointTrajectory trajectory;
    for (const int v : group.variables) trajectory.variables.push_back(robot.variables()[v].name);
    const int points = 1 + static_cast<int>(random_() % 7);
    const int kinds = static_cast<int>(random_() % 3);  // of rates: of none, of all, of some
    double time = random_() % 2 == 0 ? 0.0 : any(0.0, 3.0);
    for (int i = 0; i < points; ++i) {
      TrajectoryPoint point;
      point.time = time;
      point.positions = positions(robot, group);
      if (kinds == 1 || (kinds == 2 && random_() % 2 == 0))
        point.velocities = numbers(point.positions.size());
      if (kinds == 1 || (kinds == 2 && random_() % 2 == 0))
        point.accelerations = numbers(point.positions.size());
      trajectory.points.push_back(point);
      const bool close = random_() % 4 == 0;
      seen.closeTimes += close;
      time += close ? 1.5e-9 : any(1e-3, 3.0);
    }
    ++(kinds == 0 ? seen.withoutRates : kinds == 1 ? seen.withRates : seen.mixed);
    return trajectory;
  }

  std::vector<std::size_t> order(std::size_t count) {
    std::vector<std::size_t> places(count);
    std::iota(places.begin(), places.end(), 0U);
    std::ranges::shuffle(places, random_);
    return places;
  }

  Seen seen;

 private:
  double any(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// Of each size, and of each number of digits.
  double number() {
    switch (random_() % 6) {
      case 0:
        ++seen.negativeZeros;
        return -0.0;
      case 1:
        ++seen.tiny;
        return any(-1.0, 1.0) * std::numeric_limits<double>::denorm_min() * 1e6;
      case 2:
        ++seen.huge;
        return any(-1.0, 1.0) * 1e300;
      case 3:
        return std::round(any(-5.0, 5.0));
      default:
        return any(-3.0, 3.0);
    }
  }

  std::vector<double> numbers(std::size_t count) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(number());
    return values;
  }

  std::vector<double> positions(const Robot& robot, const Group& group) {
    std::vector<double> values;
    for (const int v : group.variables) {
      const Variable& variable = robot.variables()[v];
      double value = number();
      // What is a little beyond a limit would be moved to it.
      while (value < variable.lower ? value > variable.lower - 1e-3
                                    : value > variable.upper && value < variable.upper + 1e-3)
        value = number();
      seen.beyondLimits += value < variable.lower || value > variable.upper;
      values.push_back(value);
    }
    for (std::size_t i = 0; i < group.variables.size(); ++i) {
      const Variable& variable = robot.variables()[group.variables[i]];
      if (variable.name.ends_with("/theta")) ++seen.bases;
      if (!variable.name.ends_with("/rot_x")) continue;
      ++seen.floating;
      Eigen::Vector4d q(any(-1, 1), any(-1, 1), any(-1, 1), any(-1, 1));
      q.normalize();
      for (std::size_t k = 0; k < 4; ++k) values[i + k] = q[static_cast<Eigen::Index>(k)];
    }
    return values;
  }

  std::mt19937 random_;
};

const std::vector<std::string> kRobots{"rook7", "rook6", "rook6_cart", "drifter"};

/// Calls `look` with many trajectories of each robot and group.
template <typename Look>
Seen forMany(unsigned seed, int rounds, const Look& look) {
  RandomTrajectories random(seed);
  for (const std::string& name : kRobots) {
    const auto robot = test::modelRobot(name);
    for (const Group& group : robot->groups())
      for (int round = 0; round < rounds; ++round)
        if (!group.variables.empty()) look(*robot, group, random.make(*robot, group), random);
  }
  return random.seen;
}

TEST(TrajectoryRoundTrip, KeepsAllBits) {
  const test::TemporaryFolder folder;
  const Seen seen =
      forMany(7, 12,
              [&](const Robot& robot, const Group& group, const JointTrajectory& written,
                  RandomTrajectories&) {
                for (const char* name : {"t.csv", "t.json", "t.yaml", "t.yml"}) {
                  SCOPED_TRACE(robot.name() + " " + group.name + " " + name);
                  const auto file = folder.path() / name;
                  writeTrajectory(file, written);
                  const auto read = readTrajectories(file, robot, group);
                  ASSERT_EQ(read.size(), 1U);
                  ASSERT_EQ(read[0].variables, written.variables);
                  ASSERT_EQ(read[0].points.size(), written.points.size());
                  for (std::size_t i = 0; i < written.points.size(); ++i) {
                    expectSameValues(read[0].points[i], written.points[i]);
                    const bool isYaml = file.extension() != ".csv" && file.extension() != ".json";
                    EXPECT_LE(std::abs(read[0].points[i].time - written.points[i].time),
                              isYaml ? 0.5001e-9 : 0.0);
                  }
                  // A time in whole nanoseconds is itself again.
                  writeTrajectory(file, read[0]);
                  const auto again = readTrajectories(file, robot, group);
                  for (std::size_t i = 0; i < written.points.size(); ++i)
                    EXPECT_EQ(again[0].points[i].time, read[0].points[i].time);
                }
              });
  EXPECT_GT(seen.beyondLimits, 50);
  EXPECT_GT(seen.negativeZeros, 500);
  EXPECT_GT(seen.tiny, 500);
  EXPECT_GT(seen.huge, 500);
  EXPECT_GT(seen.closeTimes, 50);
  EXPECT_GT(seen.bases, 30);
  EXPECT_GT(seen.floating, 20);
  EXPECT_GT(std::min({seen.withRates, seen.withoutRates, seen.mixed}), 20);
}

TEST(TrajectoryRoundTrip, TheOrderOfAFileDoesNotMatter) {
  const test::TemporaryFolder folder;
  int moved = 0;
  forMany(11, 8,
          [&](const Robot& robot, const Group& group, const JointTrajectory& wanted,
              RandomTrajectories& random) {
            const std::vector<std::size_t> order = random.order(wanted.variables.size());
            const auto shuffled = [&](const auto& values) {
              auto result = values;
              for (std::size_t i = 0; i < values.size(); ++i) result[i] = values[order[i]];
              return result;
            };
            JointTrajectory written = wanted;
            written.variables = shuffled(wanted.variables);
            moved += written.variables != wanted.variables;
            for (TrajectoryPoint& point : written.points) {
              point.positions = shuffled(point.positions);
              point.velocities = shuffled(point.velocities);
              point.accelerations = shuffled(point.accelerations);
            }
            for (const char* name : {"t.csv", "t.json", "t.yaml"}) {
              SCOPED_TRACE(robot.name() + " " + group.name + " " + name);
              writeTrajectory(folder.path() / name, written);
              const auto read = readTrajectories(folder.path() / name, robot, group);
              ASSERT_EQ(read[0].variables, wanted.variables);
              for (std::size_t i = 0; i < wanted.points.size(); ++i)
                expectSameValues(read[0].points.at(i), wanted.points[i]);
            }
          });
  EXPECT_GT(moved, 60);
}

/// Values of bases go through transforms, which round; angles may differ by turns.
void expectNear(const Robot& robot, const Group& group, const std::vector<double>& read,
                const std::vector<double>& written) {
  ASSERT_EQ(read.size(), written.size());
  double sign = 1.0;  // of a quaternion
  for (std::size_t i = 0; i < read.size(); ++i) {
    const Variable& variable = robot.variables()[group.variables[i]];
    if (variable.name.find('/') == std::string::npos) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(read[i]), std::bit_cast<std::uint64_t>(written[i]));
    } else if (variable.name.ends_with("/theta")) {
      EXPECT_NEAR(std::remainder(read[i] - written[i], 2.0 * std::numbers::pi), 0.0,
                  1e-12 + 1e-15 * std::abs(written[i]));
    } else if (variable.name.find("/rot_") != std::string::npos) {
      if (variable.name.ends_with("/rot_x")) {
        double product = 0.0;
        for (std::size_t k = i; k < i + 4; ++k) product += read[k] * written[k];
        sign = product < 0.0 ? -1.0 : 1.0;
      }
      EXPECT_NEAR(read[i], sign * written[i], 1e-14);
    } else {
      EXPECT_EQ(read[i], written[i]);
    }
  }
}

TEST(TrajectoryRoundTrip, MessagesOfMoveItHoldBases) {
  const test::TemporaryFolder folder;
  const auto file = folder.path() / "t.yaml";
  int bases = 0, rates = 0;
  forMany(
      13, 20,
      [&](const Robot& robot, const Group& group, JointTrajectory written, RandomTrajectories&) {
        for (TrajectoryPoint& point : written.points) {
          // A message has no rates of floating joints, and of bases and joints both or none.
          if (robot.name() == "drifter") point.velocities = point.accelerations = {};
          // Further away, an angle is no angle within a turn.
          for (double& value : point.positions)
            if (std::abs(value) > 1e3) value = 1e3;
        }
        for (const TrajectoryMessage message :
             {TrajectoryMessage::Joint, TrajectoryMessage::Robot, TrajectoryMessage::Display}) {
          SCOPED_TRACE(robot.name() + " " + group.name);
          writeTrajectory(file, written, robot, message);
          const auto read = readTrajectories(file, robot, group);
          ASSERT_EQ(read.size(), 1U);
          ASSERT_EQ(read[0].points.size(), written.points.size());
          for (std::size_t i = 0; i < written.points.size(); ++i) {
            expectNear(robot, group, read[0].points[i].positions, written.points[i].positions);
            EXPECT_EQ(read[0].points[i].velocities, written.points[i].velocities);
            EXPECT_EQ(read[0].points[i].accelerations, written.points[i].accelerations);
            rates += !written.points[i].velocities.empty();
          }
          bases += written.variables.front().find('/') != std::string::npos;
        }
      });
  EXPECT_GT(bases, 40);
  EXPECT_GT(rates, 200);
}

TEST(TrajectoryRoundTrip, AMessageIsAPathToo) {
  const test::TemporaryFolder folder;
  const auto robot = test::modelRobot("rook6_cart");
  const Group& group = *robot->findGroup("whole_body");
  JointTrajectory written;
  for (const int v : group.variables) written.variables.push_back(robot->variables()[v].name);
  TrajectoryPoint point;
  point.positions = {1.0, 2.0, 0.5, 0.0, -0.6, 1.2, -0.6, 0.0, 0.0};
  written.points = {point};
  for (const TrajectoryMessage message :
       {TrajectoryMessage::Joint, TrajectoryMessage::Robot, TrajectoryMessage::Display}) {
    writeTrajectory(folder.path() / "t.yaml", written, *robot, message);
    const auto path = readPath(folder.path() / "t.yaml", *robot, group);
    ASSERT_EQ(path.size(), 1U);
    for (std::size_t i = 0; i < point.positions.size(); ++i)
      EXPECT_NEAR(path[0][i], point.positions[i], 1e-15);
  }
}

}  // namespace
}  // namespace swept
