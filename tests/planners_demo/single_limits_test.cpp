// SPDX-License-Identifier: BSD-3-Clause
// Limits in single precision, as messages of ROS carry them, are where a robot may be: for all that
// the program does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <random>
#include <sstream>

#include "models_dir.hpp"
#include "program.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::test {
namespace {

std::string exact(double value) {
  std::ostringstream text;
  text << std::setprecision(17) << value;
  return text.str();
}

/// As a message of ROS carries it.
std::string single(double value) {
  return exact(static_cast<double>(static_cast<float>(value)));
}

/// Every limit of every robot, in single precision, is where the robot may be: the answer is that
/// of the limit, or of what is rounded to the inside of it.
TEST(SingleLimits, OfOurRobotsAreAccepted) {
  int states = 0, remarks = 0;
  for (const std::string name : {"rook6", "rook6_cart", "rook7", "drifter"}) {
    const std::string urdf = modelsDir() + "/robots/" + name + "/" + name + ".urdf";
    const auto robot = Robot::load(urdf, Robot::srdfBeside(urdf));
    for (const Group& group : robot->groups()) {
      if (group.variables.empty()) continue;
      std::vector<std::string> rounded, limits;
      for (const bool above : {false, true}) {
        std::string a, b;
        for (const int v : group.variables) {
          const Variable& variable = robot->variables()[v];
          const double limit = above ? variable.upper : variable.lower;
          const bool rotates = variable.name.find("/rot_") != std::string::npos;
          const double value = rotates ? (variable.name.ends_with("_w") ? 1.0 : 0.0)
                               : std::isfinite(limit) && !variable.cyclic ? limit
                                                                          : 0.0;
          const char* comma = a.empty() ? "" : ",";
          a += comma + single(value);
          b += comma + exact(std::clamp(std::stod(single(value)), variable.lower, variable.upper));
        }
        if (group.variables.size() == 1) continue;  // a single value needs no comma
        rounded.push_back(a);
        limits.push_back(b);
      }
      if (rounded.empty()) continue;
      for (const std::string command : {"check", "motion"}) {
        const auto run = [&](const std::vector<std::string>& ends) {
          return runSwept({command, urdf, ends[0], ends[1], "--group", group.name});
        };
        const Outcome got = run(rounded), wanted = run(limits);
        EXPECT_NE(got.exitCode, 3) << name << " " << group.name << ": " << got.err;
        EXPECT_EQ(got.exitCode, wanted.exitCode);
        EXPECT_EQ(got.out, wanted.out) << name << " " << group.name;
        remarks += got.err.find("taken to the limit") != std::string::npos ? 1 : 0;
        ++states;
      }
    }
  }
  EXPECT_GE(states, 8);
  EXPECT_GE(remarks, 4);
}

/// The same for limits drawn at random, in all that a plan goes through: from one end of all
/// limits to the other, proven and verified, and within the limits exactly.
TEST(SingleLimits, DrawnAtRandomCanBePlannedBetween) {
  const TemporaryFolder folder;
  std::mt19937 random(5);
  int beyond = 0;
  for (int i = 0; i < 12; ++i) {
    std::string urdf = "<robot name='r'><link name='l0'/>", from, to, names;
    std::vector<double> lower, upper, first, last;
    for (int k = 0; k < 4; ++k) {
      const bool slides = k % 2 == 0;
      const double half = std::uniform_real_distribution(0.1, slides ? 0.5 : 3.0)(random);
      const double middle = std::uniform_real_distribution(-0.3, 0.3)(random);
      lower.push_back(middle - half);
      upper.push_back(middle + half);
      const std::string n = std::to_string(k + 1);
      urdf += "<link name='l" + n + "'>" +
              (k == 3 ? "<collision><origin xyz='0.2 0 0'/><geometry><box size='0.1 0.1 "
                        "0.1'/></geometry></collision>"
                      : "") +
              "</link><joint name='j" + n + "' type='" + (slides ? "prismatic" : "revolute") +
              "'><parent link='l" + std::to_string(k) + "'/><child link='l" + n +
              "'/><axis xyz='0 0 1'/><limit lower='" + exact(lower.back()) + "' upper='" +
              exact(upper.back()) + "'/></joint>";
      const std::string comma = k == 0 ? "" : ",";
      from += comma + single(lower.back());
      to += comma + single(upper.back());
      names += comma + "\"j" + n + "\"";
      const double low = std::stod(single(lower.back())), high = std::stod(single(upper.back()));
      beyond += (low < lower.back() ? 1 : 0) + (high > upper.back() ? 1 : 0);
      first.push_back(std::max(low, lower.back()));
      last.push_back(std::min(high, upper.back()));
    }
    const std::string robot = folder.write("r.urdf", urdf + "</robot>");
    const std::string problems = folder.write(
        "p.json",
        R"({"s": [{"index": 0, "world": {"sphere": [{"name": "ball", "position": [0, 0, 3], "radius": 0.1}]}, "start": [)" +
            from + R"(], "goals": [[)" + to + R"(]], "joint_names": [)" + names + "]}]}");
    EXPECT_EQ(runSwept({"check", robot, from, to}).exitCode, 0);
    EXPECT_EQ(runSwept({"motion", robot, from, to}).exitCode, 0);
    EXPECT_EQ(runSwept({"plan", robot, "--problems", problems}).exitCode, 0);
    const std::string path = folder.path("path.json");
    const Outcome run = runSwept(
        {"plan", robot, "--problems", problems, "--set", "s", "--index", "0", "-o", path, "-q"});
    EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
    const auto states = nlohmann::json::parse(folder.read("path.json"))["states"];
    EXPECT_EQ(states.front().get<std::vector<double>>(), first);
    EXPECT_EQ(states.back().get<std::vector<double>>(), last);
    const Outcome verified = runSwept({"verify", path, "-q"});
    EXPECT_EQ(verified.exitCode, 0) << verified.out;
  }
  EXPECT_GE(beyond, 24);
}

}  // namespace
}  // namespace swept::test
