// SPDX-License-Identifier: BSD-3-Clause
// Frames far out from which the next ones come back: what is rounded is as large as they are far,
// not as the robot reaches. It was counted by the reach: 1 km out, the lanes were off by 0.05 mm
// where 2e-5 m was allowed for, and doubles by 1e-13 m where 1e-14 m was.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace swept {
namespace {

constexpr double kRadius = 0.0625;  // m

/// A ball that is the last link of joints along z.
class Tower {
 public:
  Tower() {
    text_.precision(17);
    text_ << "<robot name='tower'><link name='l0'/>";
  }

  static std::string prismatic(double from, double to) {
    std::ostringstream text;
    text.precision(17);
    text << "<axis xyz='0 0 1'/><limit lower='" << from << "' upper='" << to
         << "' effort='1' velocity='1'/>";
    return text.str();
  }

  Tower& joint(const std::string& type, double height, const std::string& rest = "") {
    const int parent = count_++;
    if (parent > 0) text_ << "<link name='l" << parent << "'/>";
    text_ << "<joint name='j" << count_ << "' type='" << type << "'><parent link='l" << parent
          << "'/><child link='l" << count_ << "'/><origin xyz='0 0 " << height << "'/>" << rest
          << "</joint>";
    return *this;
  }

  std::shared_ptr<const Robot> build(double height = 0.0) {
    text_ << "<link name='l" << count_ << "'><collision><origin xyz='0 0 " << height
          << "'/><geometry><sphere radius='" << kRadius
          << "'/></geometry></collision></link></robot>";
    return Robot::parse(text_.str(), "tower.urdf");
  }
  std::string last() const { return "l" + std::to_string(count_); }

 private:
  std::ostringstream text_;
  int count_ = 0;
};

struct Case {
  const char* name;
  std::shared_ptr<const Robot> robot;
  std::string link;
  long double above;      ///< m, of the ball, plus the first value
  double first;           ///< m, in the middle of the first value's range
  std::size_t dimension;  ///< of a configuration
};

const std::string kTurns = "<axis xyz='0 0 1'/>";

std::vector<Case> towers(double far) {
  std::vector<Case> cases;
  const std::string slides = Tower::prismatic(-1.0, 1.0);
  Tower base;
  base.joint("prismatic", far, slides).joint("continuous", -far, kTurns);
  cases.push_back({"base", base.build(), base.last(), 0.0L, 0.0, 2});
  Tower mast;
  mast.joint("prismatic", 0.0, slides).joint("continuous", far, kTurns);
  mast.joint("continuous", -far, kTurns);
  cases.push_back({"mast", mast.build(), mast.last(), 0.0L, 0.0, 3});
  Tower slide;
  slide.joint("prismatic", 0.0, Tower::prismatic(far - 1.0, far + 1.0));
  cases.push_back(
      {"slide", slide.build(-far), slide.last(), -static_cast<long double>(far), far, 1});
  Tower bridge;
  bridge.joint("prismatic", 0.0, Tower::prismatic(far - 1.0, far + 1.0));
  bridge.joint("continuous", -far, kTurns);
  cases.push_back(
      {"bridge", bridge.build(), bridge.last(), -static_cast<long double>(far), far, 2});
  Tower folded;
  folded.joint("fixed", far).joint("fixed", 0.1).joint("fixed", -far);
  folded.joint("prismatic", 0.0, slides);
  cases.push_back({"folded", folded.build(), folded.last(), 0.1L, 0.0, 1});
  Tower behind;
  behind.joint("prismatic", 0.0, slides);
  behind.joint("fixed", far).joint("fixed", 0.1).joint("fixed", -far);
  cases.push_back({"behind", behind.build(), behind.last(), 0.1L, 0.0, 1});
  return cases;
}

Checker beside(const Case& which, double height, int maxIntervals) {
  World world;
  world.add("ball", makeSphere(kRadius), Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, height)));
  CheckerOptions options;
  options.maxIntervals = maxIntervals;
  return {which.robot, "all", std::make_shared<const World>(std::move(world)), options};
}

/// With a ball above that the robot's reaches into by `depth` (m).
void expectNothingIsFree(const Case& which, double value, double depth) {
  std::vector<double> q(which.dimension, 0.0);
  q.front() = value;
  const long double ball = which.above + static_cast<long double>(value);
  const auto height = static_cast<double>(ball + 2.0L * kRadius - depth);
  ASSERT_LT(static_cast<long double>(height) - ball, 2.0L * kRadius);
  std::vector<double> below = q;
  below.front() -= 0.01;
  for (const int maxIntervals : {4, 1 << 20}) {  // with 4 the lanes are not asked
    const Checker checker = beside(which, height, maxIntervals);
    Workspace workspace(checker);
    EXPECT_NE(checker.checkState(q, workspace), Verdict::Free) << value;
    EXPECT_NE(checker.certifyMotion(q, q, workspace).verdict, Verdict::Free) << value;
    EXPECT_NE(checker.certifyMotion(below, q, workspace).verdict, Verdict::Free) << value;
    EXPECT_EQ(checker.clearance(q, workspace), 0.0) << value;
    EXPECT_EQ(checker.motionClearance(q, q, 1e-3, workspace).lower, 0.0) << value;
    std::vector<Verdict> verdicts(2);
    std::vector<double> both = q;
    both.insert(both.end(), q.begin(), q.end());
    checker.checkStates(both, verdicts, workspace);
    EXPECT_NE(verdicts.front(), Verdict::Free) << value;
  }
}

TEST(FarFrames, NothingIsFreeThatIsNot) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> near(-0.9, 0.9);
  for (const double far : {1e3 + 0.1, 1e4 + 0.3, 1e6 + 0.7}) {
    const double ulp = std::nextafter(far, INFINITY) - far;
    for (const Case& which : towers(far)) {
      SCOPED_TRACE(testing::Message() << which.name << " " << far);
      for (int i = 0; i < 30; ++i) {
        const double value = which.first + near(random);
        expectNothingIsFree(which, value, 0.1 * ulp);
        expectNothingIsFree(which, value, 0.1 * far * 0x1p-24);
      }
    }
  }
}

TEST(FarFrames, LinkMotionStatesItsRounding) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> near(-0.9, 0.9);
  for (const double far : {1e3 + 0.1, 1e6 + 0.7}) {
    for (const Case& which : towers(far)) {
      for (int i = 0; i < 30; ++i) {
        std::vector<double> q(which.dimension, 0.0);
        q.front() = which.first + near(random);
        const LinkMotion motion(*which.robot, "all", which.link, q, q);
        const bool inLink = std::string(which.name) == "slide";
        const Eigen::Vector3d ball(0.0, 0.0, inLink ? -far : 0.0);
        const long double height = which.above + static_cast<long double>(q.front());
        const Eigen::Vector3d place = motion.at(0.0) * ball;
        EXPECT_LE(std::abs(place.z() - height), motion.rounding(ball.norm())) << which.name;
      }
    }
  }
}

/// What is counted stays small where nothing is far.
TEST(FarFrames, WhatKeepsItsDistanceIsFree) {
  for (const Case& which : towers(1e3)) {
    std::vector<double> from(which.dimension, 0.0), to(which.dimension, 0.0);
    from.front() = which.first - 0.5;
    to.front() = which.first;
    const auto height = static_cast<double>(which.above + to.front() + 2.0L * kRadius + 1e-3L);
    const Checker checker = beside(which, height, 1 << 20);
    Workspace workspace(checker);
    EXPECT_EQ(checker.certifyMotion(from, to, workspace).verdict, Verdict::Free) << which.name;
    EXPECT_EQ(checker.checkState(to, workspace), Verdict::Free) << which.name;
    EXPECT_NEAR(checker.clearance(to, workspace), 1e-3, 1e-6) << which.name;
  }
}

}  // namespace
}  // namespace swept
