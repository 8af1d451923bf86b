// SPDX-License-Identifier: BSD-3-Clause
// A link's motion as continuousCollide sees it is that of the oracle's arm, and its first contacts
// are those that the checker finds another way.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>

#include "models_under_test.hpp"
#include "random_motions.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace {

using Eigen::Vector3d;
using swept::LinkMotion;

class LinkMotions : public testing::TestWithParam<Model> {
 protected:
  static Scenario scenario() { return clutterScenario(filesOf(GetParam()), 3); }
};

TEST_P(LinkMotions, ArePlacedAsTheOracleSays) {
  const Scenario s = scenario();
  RandomMotions motions(s, 15, 1.0);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto& links = s.oracle->arm().links();
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 200; ++i) {
    const auto [from, to] = motions.next();
    const double t = i % 10 == 0 ? i % 20 / 10.0 : unit(random);
    const auto& link = links[random() % links.size()];
    const LinkMotion motion(s.checker->robot(), s.group, link.name, s.groupOf(from), s.groupOf(to));
    s.oracle->arm().poses(s.oracle->arm().between(from, to, t), poses);
    const auto& expected = poses[static_cast<size_t>(s.oracle->arm().link(link.name))];
    EXPECT_LT((motion.at(t).matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-10)
        << link.name << " at " << t;
  }
}

/// All but one joint of the group stand still, before the one that moves, after it, or both.
TEST_P(LinkMotions, OfOneJointArePlacedAsTheOracleSays) {
  const Scenario s = scenario();
  RandomMotions motions(s, 17, 1.0);
  std::mt19937_64 random(3);
  const auto& arm = s.oracle->arm();
  int moved = 0;
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 200; ++i) {
    const auto [from, other] = motions.next();
    auto to = from;
    const size_t chosen = random() % to.size();
    to[chosen] = other[chosen];
    const auto& link = arm.links()[random() % arm.links().size()];
    const LinkMotion motion(s.checker->robot(), s.group, link.name, s.groupOf(from), s.groupOf(to));
    for (const double t : {0.0, 0.3, 1.0}) {
      arm.poses(arm.between(from, to, t), poses);
      const auto& expected = poses[static_cast<size_t>(arm.link(link.name))];
      EXPECT_LT((motion.at(t).matrix() - expected.matrix()).cwiseAbs().maxCoeff(), 1e-10)
          << link.name << " at " << t;
      const swept::MotionState state = motion.state(t);
      EXPECT_EQ(state.pose.matrix(), motion.at(t).matrix());
      EXPECT_EQ(state.twist.linear, motion.velocity(t).linear);
      EXPECT_EQ(state.twist.angular, motion.velocity(t).angular);
    }
    moved += motion.rates(0, 1).speed > 0 || motion.rates(0, 1).angularSpeed > 0;
  }
  EXPECT_GT(moved, 40);
}

/// Velocities are the derivatives of the poses, and the rates bound both, not by much more than the
/// arms' folding explains.
TEST_P(LinkMotions, HaveTheirVelocitiesAndRates) {
  const Scenario s = scenario();
  RandomMotions motions(s, 16, 1.0);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto& links = s.checker->robot().links();
  double fastest = 0, fastestBound = 0;
  for (int i = 0; i < 200; ++i) {
    const auto [from, to] = motions.next();
    const LinkMotion motion(s.checker->robot(), s.group, links[random() % links.size()].name,
                            s.groupOf(from), s.groupOf(to));
    const swept::MotionRates rates = motion.rates(0, 1);
    const double step = 1e-4;
    const double t = step + (1 - 2 * step) * unit(random);
    const auto before = motion.at(t - step), at = motion.at(t), after = motion.at(t + step);
    const swept::Twist twist = motion.velocity(t);
    const Vector3d difference = (after.translation() - before.translation()) / (2 * step);
    EXPECT_LT((difference - twist.linear).norm(), 1e-6 * (1 + rates.speed + rates.acceleration));
    const Eigen::Matrix3d turned = (after.linear() - before.linear()) / (2 * step);
    const Vector3d& w = twist.angular;
    Eigen::Matrix3d cross;
    cross << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    EXPECT_LT((turned - cross * at.linear()).cwiseAbs().maxCoeff(),
              1e-6 * (1 + rates.angularSpeed + rates.angularAcceleration));
    const swept::Twist later = motion.velocity(t + step), earlier = motion.velocity(t - step);
    EXPECT_LE(twist.linear.norm(), rates.speed);
    EXPECT_LE(twist.angular.norm(), rates.angularSpeed);
    EXPECT_LE((later.linear - earlier.linear).norm() / (2 * step), rates.acceleration + 1e-6);
    EXPECT_LE((later.angular - earlier.angular).norm() / (2 * step),
              rates.angularAcceleration + 1e-6);
    fastest += twist.linear.norm();
    fastestBound += rates.speed;
  }
  EXPECT_GT(fastest, 0.1 * fastestBound);
}

/// The first contact of a motion from all its pairs of pieces, one query for each.
struct FirstContact {
  double freeUntil = 1.0;
  double contactBy = 2.0;

  void add(const swept::ContinuousResult& found) {
    freeUntil = std::min(freeUntil, found.freeUntil);
    if (found.verdict == swept::Verdict::Collision)
      contactBy = std::min(contactBy, found.contactBy);
  }
};

class PairByPair {
 public:
  PairByPair(const Scenario& s, const std::vector<double>& from, const std::vector<double>& to)
      : checker_(*s.checker), still_(swept::UniformMotion::still(Eigen::Isometry3d::Identity())) {
    for (const swept::Link& link : checker_.robot().links())
      links_.emplace_back(checker_.robot(), s.group, link.name, from, to);
  }
  FirstContact find() {
    for (const auto& pair : checker_.checkedPairs()) {
      const auto a = pieces(pair.bodyA), b = pieces(pair.bodyB);
      for (const Piece& first : a)
        for (const Piece& second : b)
          found_.add(swept::continuousCollide(*first.shape, *first.motion, *second.shape,
                                              *second.motion, options_, workspace_));
    }
    return found_;
  }

 private:
  struct Piece {
    const swept::Shape* shape;
    const swept::Motion* motion;
  };
  std::vector<Piece> pieces(const std::string& name) {
    std::vector<Piece> all;
    if (const auto index = checker_.robot().findLink(name)) {
      const auto link = static_cast<size_t>(*index);
      for (const auto& geometry : checker_.robot().links()[link].collision)
        all.push_back(
            {&geometry.shape, &frames_.emplace_back(links_[link], geometry.link_from_shape)});
      return all;
    }
    for (const auto& part : checker_.world().find(name)->parts)
      all.push_back({&part.shape, &frames_.emplace_back(still_, part.world_from_shape)});
    return all;
  }

  const swept::Checker& checker_;
  const swept::UniformMotion still_;
  std::deque<LinkMotion> links_;
  std::deque<swept::AttachedFrame> frames_;
  const swept::ContinuousOptions options_;
  swept::ContinuousWorkspace workspace_;
  FirstContact found_;
};

TEST_P(LinkMotions, MeetWhenTheCheckerSaysSo) {
  const Scenario s = scenario();
  RandomMotions motions(s, 17, 1.0);
  swept::Workspace workspace(*s.checker);
  int hits = 0, free = 0, late = 0;
  for (int i = 0; i < 60; ++i) {
    const auto motion = motions.next();
    const auto from = s.groupOf(motion.first), to = s.groupOf(motion.second);
    const swept::MotionCertificate certificate = s.checker->certifyMotion(from, to, workspace);
    const FirstContact found = PairByPair(s, from, to).find();
    if (certificate.verdict == swept::Verdict::Collision) {
      EXPECT_LE(found.freeUntil, certificate.witness->t + 1e-9);
      ++hits;
      late += certificate.freeUntil > 0;
    }
    if (certificate.verdict == swept::Verdict::Free) {
      EXPECT_EQ(found.contactBy, 2.0);
      ++free;
    }
    if (found.contactBy <= 1.0) {
      EXPECT_LE(certificate.freeUntil, found.contactBy + 1e-9);
    }
    if (found.freeUntil >= 1.0) {
      EXPECT_NE(certificate.verdict, swept::Verdict::Collision);
    }
  }
  EXPECT_GT(hits, 10);
  EXPECT_GT(late, 5);
  EXPECT_GT(free, 10);
}

TEST(LinkMotion, SaysWhatIsWrong) {
  const Scenario s = clutterScenario(filesOf({"rook6", "arm"}), 3);
  const swept::Robot& robot = s.checker->robot();
  const std::vector<double> q(6, 0.0), five(5, 0.0);
  const auto message = [&](auto&& make) -> std::string {
    try {
      make();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  const std::string link = robot.links().back().name;
  EXPECT_EQ(message([&] { LinkMotion(robot, "leg", link, q, q); }),
            "LinkMotion: robot 'rook6' has no group 'leg'");
  EXPECT_EQ(message([&] { LinkMotion(robot, "arm", "nose", q, q); }),
            "LinkMotion: robot 'rook6' has no link 'nose'");
  EXPECT_EQ(message([&] { LinkMotion(robot, "arm", link, q, five); }),
            "LinkMotion: the last configuration has 5 values instead of 6");
  const std::vector<double> odd(6, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(
      message([&] { LinkMotion(robot, "arm", link, odd, q); }),
      "LinkMotion: a value is not finite, a quaternion has no direction, or a prismatic value "
      "is outside its limits");
  EXPECT_EQ(message([&] { LinkMotion(robot, "arm", link, q, q, Eigen::VectorXd::Zero(1)); }),
            "LinkMotion: the reference has 1 values instead of " +
                std::to_string(robot.variables().size()));
}

INSTANTIATE_TEST_SUITE_P(Models, LinkMotions, modelsUnderTest(), modelName);

}  // namespace
