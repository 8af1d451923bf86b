// SPDX-License-Identifier: BSD-3-Clause
// Random robots with frames up to 1000 km out, axes that are nearly parallel or nearly point down,
// followers with large factors, bases that turn by half a turn and motions of next to nothing: a
// ball that the path touches by little more than its coordinates round is never missed.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "simd_robots.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

using simd_test::Random;
using simd_test::Real;
using simd_test::Vector;

std::string three(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text.precision(17);
  text << v.x() << " " << v.y() << " " << v.z();
  return text.str();
}

/// A chain of up to four joints with a ball at its end.
class RandomRobot {
 public:
  RandomRobot(Random& random, double radius) : random_(random) {
    text_.precision(17);
    text_ << "<robot name='r'><link name='l0'/>";
    const int joints = 1 + random.below(4);
    for (int i = 1; i <= joints; ++i) addJoint(i, i == joints ? radius : 0.0);
    text_ << "</robot>";
    robot = Robot::parse(text_.str(), "r.urdf");
  }

  std::shared_ptr<const Robot> robot;

  std::string text() const { return text_.str(); }

 private:
  /// m. Often far out, and then often back.
  Eigen::Vector3d offset() {
    if (!away_.isZero() && random_.chance(0.5)) {
      const Eigen::Vector3d back = -away_ + random_.vector(0.3);
      away_.setZero();
      return back;
    }
    if (!random_.chance(0.4)) return random_.vector(0.4);
    away_ = std::pow(10.0, random_.below(7)) * random_.direction();
    if (random_.chance(0.5)) away_ = Eigen::Vector3d(0.0, 0.0, away_.z());
    return away_;
  }

  Eigen::Vector3d axis() {
    const int kind = random_.below(5);
    if (kind == 0) return Eigen::Vector3d::UnitZ();
    if (kind == 1) return random_.direction();
    const double tilt = random_.scale(1e-4, 1e-1);
    const Eigen::Vector3d near = tilt * random_.direction();
    return (near + Eigen::Vector3d(0.0, 0.0, kind == 2 ? 1.0 : -1.0)).normalized();
  }

  std::string typeOf(int index) {
    static const char* const kTypes[] = {"continuous", "continuous", "revolute",
                                         "prismatic",  "planar",     "floating"};
    return kTypes[random_.below(index == 1 ? 6 : 4)];
  }

  void addJoint(int index, double radius) {
    const std::string type = typeOf(index);
    text_ << "<joint name='j" << index << "' type='" << type << "'><parent link='l" << index - 1
          << "'/><child link='l" << index << "'/><origin xyz='" << three(offset()) << "'";
    if (random_.chance(0.3)) text_ << " rpy='" << three(random_.vector(3.0)) << "'";
    text_ << "/>";
    if (type != "floating") text_ << "<axis xyz='" << three(axis()) << "'/>";
    if (type == "revolute") text_ << "<limit lower='-400' upper='400' effort='1' velocity='1'/>";
    if (type == "prismatic") {
      const double limit = std::pow(10.0, random_.below(7));
      text_ << "<limit lower='" << -limit << "' upper='" << limit << "' effort='1' velocity='1'/>";
    }
    const bool turns = type == "continuous" || type == "revolute";
    if (turns && !master_.empty() && random_.chance(0.4)) {
      const double factor = std::pow(10.0, random_.below(6) - 2) * (random_.chance(0.5) ? 1 : -1);
      text_ << "<mimic joint='" << master_ << "' multiplier='" << factor << "' offset='"
            << random_.uniform(-1.0, 1.0) << "'/>";
    } else if (turns) {
      master_ = "j" + std::to_string(index);
    }
    text_ << "</joint><link name='l" << index << "'>";
    if (radius > 0.0)
      text_ << "<collision><origin xyz='" << three(offset()) << "'/><geometry><sphere radius='"
            << radius << "'/></geometry></collision>";
    text_ << "</link>";
  }

  Random& random_;
  std::ostringstream text_;
  Eigen::Vector3d away_ = Eigen::Vector3d::Zero();
  std::string master_;
};

/// Ends of a motion: of any size down to the smallest.
void makeMotion(Random& random, const Robot& robot, std::vector<double>& from,
                std::vector<double>& to) {
  const double size = random.chance(0.2) ? 0.0 : random.scale(1e-12, 1.0);
  const bool tiny = random.chance(0.1);
  for (const Variable& variable : robot.variables()) {
    const bool cyclic = variable.cyclic || !(std::abs(variable.upper) < 1e300);
    const double most = cyclic ? (random.chance(0.2) ? 300.0 : 3.0) : variable.upper;
    from.push_back(random.uniform(-most, most));
    const double way = tiny ? 5e-324 : size * random.uniform(-most, most);
    to.push_back(cyclic ? from.back() + way : std::clamp(from.back() + way, -most, most));
  }
  for (const Joint& joint : robot.joints()) {
    if (joint.type != JointType::Floating) continue;
    const Eigen::Quaterniond first = random.turn();
    const double angle = random.chance(0.3) ? std::numbers::pi * (1.0 - random.scale(1e-12, 1e-3))
                                            : random.scale(1e-9, 3.0);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, random.direction()));
    const Eigen::Quaterniond second = tiny ? first : turn * first;
    for (int i = 0; i < 4; ++i) {
      from[static_cast<std::size_t>(joint.firstVariable) + 3 + i] = first.coeffs()[i];
      to[static_cast<std::size_t>(joint.firstVariable) + 3 + i] = second.coeffs()[i];
    }
  }
}

/// The ball's middle at t, in extended precision.
Vector middleAt(const detail::KinematicModel& model, const Robot& robot,
                const std::vector<double>& from, const std::vector<double>& to, Real t) {
  const std::size_t last = robot.links().size() - 1;
  const Eigen::Vector3d inLink =
      robot.links()[last].collision.front().link_from_shape.translation();
  return simd_test::exactPoint(model, from, to, t, model.bodyOfLink[last], 0, inLink.cast<Real>());
}

TEST(FarMotions, WhatThePathTouchesIsNeverMissed) {
  Random random(90);
  int free = 0;
  constexpr int kRounds = 1500;
  for (int round = 0; round < kRounds; ++round) {
    const double radius = random.scale(1e-3, 0.5);
    const RandomRobot made(random, radius);
    const Robot& robot = *made.robot;
    std::vector<double> from, to;
    makeMotion(random, robot, from, to);
    const Group& group = *robot.findGroup("all");
    const auto model = detail::compileKinematics(robot, group, robot.defaultState());
    const Real t = random.chance(0.3) ? 1.0L : static_cast<Real>(random.uniform(0.0, 1.0));
    const Vector there = middleAt(model, robot, from, to, t);
    const Vector way = middleAt(model, robot, from, to, 1.0L) - there;
    // Most beside the path.
    Vector beside = random.direction().cast<Real>();
    if (way.norm() > 0 && random.chance(0.7)) beside -= beside.dot(way) / way.squaredNorm() * way;
    beside.normalize();
    const double ulp = 0x1p-52 * (static_cast<double>(there.norm()) + radius);
    const double depth = random.scale(2.0, 1e4) * ulp;
    if (!(depth < radius)) continue;
    const Vector place = there + (2.0L * radius - static_cast<Real>(depth)) * beside;
    const Eigen::Vector3d at = place.cast<double>();
    ASSERT_LT((at.cast<Real>() - there).norm(), 2.0L * radius);
    for (const int maxIntervals : {4, 3000}) {
      World world;
      world.add("ball", makeSphere(radius), Eigen::Isometry3d(Eigen::Translation3d(at)));
      CheckerOptions options;
      options.maxIntervals = maxIntervals;
      const Checker checker(made.robot, "all", std::make_shared<const World>(world), options);
      Workspace workspace(checker);
      for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
        const MotionCertificate found = checker.certifyMotion(from, to, workspace, query);
        EXPECT_NE(found.verdict, Verdict::Free) << "round " << round << ", t " << t << ", depth "
                                                << depth << ", " << maxIntervals << " intervals\n"
                                                << made.text();
      }
      // A follower of a cyclic joint that went the shorter way ends elsewhere.
      const Vector end = middleAt(model, robot, to, to, 0.0L);
      if ((at.cast<Real>() - end).norm() < 2.0L * radius) {
        EXPECT_NE(checker.checkState(to, workspace), Verdict::Free) << round;
      }
      free += checker.certifyMotion(from, from, workspace).verdict == Verdict::Free ? 1 : 0;
    }
  }
  EXPECT_GT(free, kRounds / 4);
}

}  // namespace
}  // namespace swept
