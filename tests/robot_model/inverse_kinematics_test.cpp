// SPDX-License-Identifier: BSD-3-Clause
// Inverse kinematics against the forward kinematics of LinkMotion, which it shares no chain with,
// and against arms whose answers are known.
#include "swept/robot_model/inverse_kinematics.hpp"
#include "model_robots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "heap_counter.hpp"
#include "message_of.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "urdf_text.hpp"

namespace swept {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Translation3d;
using Eigen::Vector3d;
using test::joint;
using test::limited;
using test::messageOf;

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Chain {
  std::shared_ptr<const Robot> robot;
  std::string group, link;

  std::string name() const { return robot->name() + " " + group + " " + link; }
  const Group& variables() const { return *robot->findGroup(group); }
  Isometry3d place(const std::vector<double>& q,
                   const std::optional<Eigen::VectorXd>& reference = {}) const {
    return LinkMotion(*robot, group, link, q, q, reference).at(0.0);
  }
};

std::string links(int count) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text.append("<link name='l").append(std::to_string(i)).append("'/>");
  return text;
}

Chain chainOf(const std::string& name, int count, const std::string& joints) {
  const std::string urdf = "<?xml version='1.0'?>\n<robot name='" + name + "'>\n" + links(count) +
                           "\n" + joints + "</robot>\n";
  return {Robot::parse(urdf, name + ".urdf"), "all",
          std::string("l").append(std::to_string(count - 1))};
}

/// Every type of joint on the way to the last link, and two followers of the first revolute one.
Chain everyJoint() {
  return chainOf(
      "every_joint", 9,
      joint("cart", "planar", "l0", "l1", "<origin rpy='0.3 0 0'/><axis xyz='0 0.6 0.8'/>") +
          joint("slide", "prismatic", "l1", "l2", limited("0 1 1", -0.5, 1.5)) +
          joint("turn", "continuous", "l2", "l3", "<origin xyz='0 0.1 0'/><axis xyz='0 1 0'/>") +
          joint("elbow", "revolute", "l3", "l4",
                "<origin xyz='0.3 0 0'/>" + limited("0 0 1", -2, 2)) +
          joint("follower", "revolute", "l4", "l5",
                "<origin xyz='0.2 0 0'/>" + limited("0 1 0", -2, 2) +
                    "<mimic joint='elbow' multiplier='-0.7' offset='0.2'/>") +
          joint("pusher", "prismatic", "l5", "l6",
                limited("1 0 0", -1, 1) + "<mimic joint='elbow' multiplier='0.1'/>") +
          joint("wrist", "revolute", "l6", "l7",
                "<origin xyz='0.2 0 0'/>" + limited("1 0 0", -1, 1)) +
          joint("body", "floating", "l7", "l8", "<origin xyz='0 0.1 0' rpy='0 0.4 0'/>"));
}

/// Three prismatic joints along x, y and z in [-1, 1] m.
Chain gantry() {
  return chainOf("gantry", 4,
                 joint("x", "prismatic", "l0", "l1", limited("1 0 0", -1, 1)) +
                     joint("y", "prismatic", "l1", "l2", limited("0 1 0", -1, 1)) +
                     joint("z", "prismatic", "l2", "l3", limited("0 0 1", -1, 1)));
}

/// Two arms of 1 m in the x-y plane; the tip at (x, y) fixes the elbow up to its sign.
Chain elbowArm(const std::string& shoulder) {
  return chainOf("elbow_arm", 4,
                 joint("shoulder", shoulder, "l0", "l1", limited("0 0 1", -3, 3)) +
                     joint("elbow", "revolute", "l1", "l2",
                           "<origin xyz='1 0 0'/>" + limited("0 0 1", -2.5, 2.5)) +
                     joint("tip", "fixed", "l2", "l3", "<origin xyz='1 0 0'/>"));
}

/// A slide whose follower goes half as far on top of it.
Chain telescope() {
  return chainOf("telescope", 3,
                 joint("slide", "prismatic", "l0", "l1", limited("1 0 0", 0, 1)) +
                     joint("follower", "prismatic", "l1", "l2",
                           limited("1 0 0", 0, 1) + "<mimic joint='slide' multiplier='0.5'/>"));
}

/// All groups of the models, to their tips.
std::vector<Chain> modelChains() {
  std::vector<Chain> chains;
  for (const char* name : {"rook7", "rook6", "rook6_cart", "drifter"}) {
    const auto robot = test::modelRobot(name);
    for (const Group& group : robot->groups()) {
      if (group.tipLink >= 0)
        chains.push_back({robot, group.name, robot->links()[group.tipLink].name});
    }
  }
  return chains;
}

std::vector<Chain> allChains() {
  std::vector<Chain> chains = modelChains();
  for (const Chain& chain : {everyJoint(), gantry(), elbowArm("continuous"), telescope()}) {
    chains.push_back(chain);
  }
  return chains;
}

class Configurations {
 public:
  Configurations(const Chain& chain, unsigned seed) : chain_(chain), random_(seed) {}

  /// Uniform within the limits; within 2 m where there are none.
  std::vector<double> next() {
    std::vector<double> q;
    for (const int index : chain_.variables().variables) {
      const Variable& variable = chain_.robot->variables()[index];
      const double lower = variable.cyclic ? -kPi : std::max(variable.lower, -2.0 * kPi);
      const double upper = variable.cyclic ? kPi : std::min(variable.upper, 2.0 * kPi);
      q.push_back(std::uniform_real_distribution<double>(lower, upper)(random_));
    }
    for (const std::size_t first : quaternions()) {
      Eigen::Map<Eigen::Vector4d>(&q[first]).normalize();
    }
    return q;
  }

  /// Indices of the quaternions' first values in a configuration.
  std::vector<std::size_t> quaternions() const {
    std::vector<std::size_t> firsts;
    const auto& variables = chain_.variables().variables;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const std::string& name = chain_.robot->variables()[variables[i]].name;
      if (name.ends_with("/rot_x")) firsts.push_back(i);
    }
    return firsts;
  }

 private:
  const Chain& chain_;
  std::mt19937_64 random_;
};

Isometry3d someTool() {
  return Translation3d(0.02, -0.05, 0.11) * AngleAxisd(0.8, Vector3d(1, 2, -1).normalized());
}

double largestDifference(const Isometry3d& a, const Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

void expectWithinLimits(const Chain& chain, const std::vector<double>& q) {
  const auto& variables = chain.variables().variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Variable& variable = chain.robot->variables()[variables[i]];
    EXPECT_GE(q[i], variable.cyclic ? -kPi : variable.lower) << variable.name;
    EXPECT_LE(q[i], variable.cyclic ? kPi : variable.upper) << variable.name;
  }
}

TEST(InverseKinematics, KnowsWhereTheToolIs) {
  for (const Chain& chain : allChains()) {
    SCOPED_TRACE(chain.name());
    const Isometry3d tool = someTool();
    const InverseKinematics kinematics(chain.robot, chain.group, chain.link, {}, tool);
    Configurations random(chain, 1);
    for (int i = 0; i < 50; ++i) {
      const std::vector<double> q = random.next();
      EXPECT_LT(largestDifference(kinematics.pose(q), chain.place(q) * tool), 1e-12);
      EXPECT_EQ(kinematics.findPose(q)->matrix(), kinematics.pose(q).matrix());
    }
  }
}

/// Joints outside the group stand where the reference has them.
TEST(InverseKinematics, KeepsTheReferenceOutsideTheGroup) {
  const Chain chain{test::modelRobot("rook6_cart"), "arm", "wrist_3"};
  Eigen::VectorXd reference = chain.robot->defaultState();
  reference[*chain.robot->findVariable("floor/x")] = 0.7;
  reference[*chain.robot->findVariable("floor/theta")] = 1.1;
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link, reference);
  const InverseKinematics still(chain.robot, chain.group, chain.link);
  Configurations random(chain, 2);
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> q = random.next();
    EXPECT_LT(largestDifference(kinematics.pose(q), chain.place(q, reference)), 1e-12);
    EXPECT_GT(largestDifference(kinematics.pose(q), still.pose(q)), 0.1);
  }
}

/// The configuration with one degree of freedom moved on by `step`.
std::vector<double> moved(const Configurations& of, std::vector<double> q, int degree,
                          double step) {
  const auto quaternions = of.quaternions();
  int passed = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (std::find(quaternions.begin(), quaternions.end(), i) == quaternions.end()) {
      if (passed++ == degree) q[i] += step;
      continue;
    }
    if (degree >= passed && degree < passed + 3) {
      Eigen::Map<Quaterniond> turn(&q[i]);
      turn = AngleAxisd(step, Vector3d::Unit(degree - passed)) * Quaterniond(turn);
    }
    passed += 3;
    i += 3;
  }
  return q;
}

TEST(InverseKinematics, HasTheJacobianOfFiniteDifferences) {
  for (const Chain& chain : allChains()) {
    SCOPED_TRACE(chain.name());
    const Isometry3d tool = someTool();
    const InverseKinematics kinematics(chain.robot, chain.group, chain.link, {}, tool);
    Configurations random(chain, 3);
    constexpr double kStep = 1e-5;
    for (int i = 0; i < 20; ++i) {
      std::vector<double> q = random.next();
      // The steps stay within the limits of prismatic joints.
      for (double& value : q) value *= 0.99;
      if (chain.robot->name() == "telescope" || chain.group == "gripper") q[0] += 2e-5;
      const auto jacobian = kinematics.jacobian(q);
      ASSERT_EQ(jacobian.cols(), kinematics.degreesOfFreedom());
      for (int k = 0; k < kinematics.degreesOfFreedom(); ++k) {
        const Isometry3d before = chain.place(moved(random, q, k, -kStep)) * tool;
        const Isometry3d after = chain.place(moved(random, q, k, kStep)) * tool;
        const Vector3d linear = (after.translation() - before.translation()) / (2 * kStep);
        const AngleAxisd turn(after.linear() * before.linear().transpose());
        const Vector3d angular = turn.angle() / (2 * kStep) * turn.axis();
        EXPECT_LT((jacobian.col(k).head<3>() - linear).norm(), 1e-7) << k;
        EXPECT_LT((jacobian.col(k).tail<3>() - angular).norm(), 1e-7) << k;
      }
    }
  }
}

TEST(InverseKinematics, CountsThreeDegreesForAnOrientation) {
  const Chain every = everyJoint();
  const InverseKinematics kinematics(every.robot, every.group, every.link);
  EXPECT_EQ(kinematics.dimension(), 3 + 1 + 1 + 1 + 1 + 7);
  EXPECT_EQ(kinematics.degreesOfFreedom(), 3 + 1 + 1 + 1 + 1 + 6);
}

struct Tries {
  int reached = 0;
  int first = 0;   ///< from the first seed
  int failed = 0;  ///< seeds
};

/// Targets of random configurations, each from up to 20 random seeds. What is found is checked
/// without the class under test.
Tries reach(const Chain& chain, int targets) {
  const Isometry3d tool = someTool();
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link, {}, tool);
  InverseKinematics::Workspace workspace(kinematics);
  const InverseKinematicsOptions options;
  Configurations goals(chain, 4), seeds(chain, 5);
  Tries tries;
  for (int i = 0; i < targets; ++i) {
    const Isometry3d target = chain.place(goals.next()) * tool;
    for (int k = 0; k < 20; ++k) {
      std::vector<double> q = seeds.next();
      const bool solved = kinematics.solve(target, q, options, workspace);
      expectWithinLimits(chain, q);
      if (!solved) {
        ++tries.failed;
        continue;
      }
      const Isometry3d actual = chain.place(q) * tool;
      EXPECT_LE((actual.translation() - target.translation()).norm(),
                options.positionTolerance + 1e-12);
      EXPECT_LE(AngleAxisd(actual.linear().transpose() * target.linear()).angle(),
                options.orientationTolerance + 1e-7);
      ++tries.reached;
      tries.first += k == 0;
      break;
    }
  }
  return tries;
}

TEST(InverseKinematics, ReachesWhatCanBeReached) {
  int hard = 0;
  for (const Chain& chain : allChains()) {
    SCOPED_TRACE(chain.name());
    constexpr int kTargets = 100;
    const Tries tries = reach(chain, kTargets);
    EXPECT_GE(tries.reached, kTargets * 95 / 100);
    hard += tries.failed;
  }
  // The targets are not all easy: some seeds lead nowhere.
  EXPECT_GT(hard, 100);
}

TEST(InverseKinematics, AnswersNoWhereNothingReaches) {
  for (const Chain& chain : allChains()) {
    SCOPED_TRACE(chain.name());
    const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
    InverseKinematics::Workspace workspace(kinematics);
    Configurations random(chain, 6);
    const Isometry3d far(Translation3d(0, 0, 50));
    const bool flies = chain.robot->name() == "drifter" || chain.robot->name() == "every_joint";
    for (int i = 0; i < 10; ++i) {
      std::vector<double> q = random.next();
      EXPECT_EQ(kinematics.solve(far, q, {}, workspace), flies);
      expectWithinLimits(chain, q);
    }
  }
}

/// A box of reachable points: the nearest to a target outside is the target's projection onto it.
TEST(InverseKinematics, StopsAtTheLimitsThatAreNearest) {
  const Chain chain = gantry();
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
  InverseKinematics::Workspace workspace(kinematics);
  Configurations seeds(chain, 7);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> wide(-2, 2);
  int inside = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d wanted(wide(random), wide(random), wide(random));
    const bool reachable = wanted.cwiseAbs().maxCoeff() <= 1.0;
    std::vector<double> q = seeds.next();
    EXPECT_EQ(kinematics.solve(Isometry3d(Translation3d(wanted)), q, {}, workspace), reachable);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(q[k], std::clamp(wanted[k], -1.0, 1.0), 1e-5);
    inside += reachable;
  }
  EXPECT_GT(inside, 10);
  EXPECT_LT(inside, 100);
}

TEST(InverseKinematics, MovesFollowersWithTheirJoint) {
  const Chain chain = telescope();
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
  InverseKinematics::Workspace workspace(kinematics);
  std::vector<double> q{0.9};
  ASSERT_TRUE(kinematics.solve(Isometry3d(Translation3d(0.6, 0, 0)), q, {}, workspace));
  EXPECT_NEAR(q[0], 0.4, 1e-6);
  // Both at their ends.
  EXPECT_FALSE(kinematics.solve(Isometry3d(Translation3d(1.6, 0, 0)), q, {}, workspace));
  EXPECT_EQ(q[0], 1.0);
}

/// By the law of cosines; narrower limits leave one of the two elbows.
TEST(InverseKinematics, KeepsNarrowerLimits) {
  const Chain chain = elbowArm("revolute");
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
  const InverseKinematics bent =
      kinematics.within(std::vector<double>{-10, 0.1}, std::vector<double>{10, 10});
  InverseKinematics::Workspace workspace(bent);
  InverseKinematicsOptions anyTurn;
  anyTurn.orientationTolerance = kInfinity;
  Configurations seeds(chain, 9);
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> radius(1.0, 1.9), direction(-1.5, 1.5);
  int solved = 0, negativeSeeds = 0, negativeElbows = 0;
  for (int i = 0; i < 100; ++i) {
    const double r = radius(random), at = direction(random);
    const Isometry3d target(Translation3d(r * std::cos(at), r * std::sin(at), 0));
    const double elbow = std::acos(r * r / 2 - 1);
    std::vector<double> q = seeds.next(), free = q;
    negativeSeeds += q[1] < 0;
    if (bent.solve(target, q, anyTurn, workspace)) {
      EXPECT_NEAR(q[1], elbow, 1e-5);
      EXPECT_NEAR(q[0], at - elbow / 2, 1e-5);
      ++solved;
    }
    EXPECT_GE(q[1], 0.1);
    if (kinematics.solve(target, free, anyTurn, workspace)) {
      EXPECT_NEAR(std::abs(free[1]), elbow, 1e-5);
      negativeElbows += free[1] < 0;
    }
  }
  EXPECT_GT(solved, 80);
  EXPECT_GT(negativeSeeds, 30);
  EXPECT_GT(negativeElbows, 30);
}

TEST(InverseKinematics, LeavesOutAnErrorWithoutTolerance) {
  const Chain chain{test::modelRobot("rook7"), "arm", "link7"};
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
  InverseKinematics::Workspace workspace(kinematics);
  Configurations goals(chain, 11), seeds(chain, 12);
  int positions = 0, orientations = 0, both = 0;
  for (int i = 0; i < 50; ++i) {
    const Isometry3d target = chain.place(goals.next());
    std::vector<double> q = seeds.next(), r = q, s = q;
    InverseKinematicsOptions somewhere, anyhow;
    somewhere.positionTolerance = kInfinity;
    anyhow.orientationTolerance = kInfinity;
    both += kinematics.solve(target, s, {}, workspace);
    if (kinematics.solve(target, q, anyhow, workspace)) {
      EXPECT_LT((chain.place(q).translation() - target.translation()).norm(), 1.1e-6);
      ++positions;
    }
    if (kinematics.solve(target, r, somewhere, workspace)) {
      EXPECT_LT((chain.place(r).linear() - target.linear()).norm(), 2e-6);
      ++orientations;
    }
  }
  EXPECT_GT(positions, both);
  EXPECT_GT(orientations, both);
}

TEST(InverseKinematics, WrapsCyclicJoints) {
  const Chain chain = elbowArm("continuous");
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
  InverseKinematics::Workspace workspace(kinematics);
  // Behind the arm, from both sides of the seam and from turns away.
  for (const double seed : {3.0, -3.0, 3.0 + 6 * kPi, -3.0 - 4 * kPi}) {
    for (const double angle : {3.1, -3.1}) {
      std::vector<double> q{seed, 0.5};
      const Isometry3d target = chain.place({angle, 1.0});
      ASSERT_TRUE(kinematics.solve(target, q, {}, workspace));
      EXPECT_NEAR(q[0], angle, 1e-5);
      EXPECT_NEAR(q[1], 1.0, 1e-5);
    }
  }
}

/// The seed is the solution, or not: no steps are taken.
TEST(InverseKinematics, TakesNoMoreStepsThanAllowed) {
  const Chain chain{test::modelRobot("rook6"), "arm", "wrist_3"};
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
  InverseKinematics::Workspace workspace(kinematics);
  Configurations random(chain, 13);
  InverseKinematicsOptions none;
  none.maxIterations = 0;
  const std::vector<double> goal = random.next(), other = random.next();
  std::vector<double> q = goal;
  EXPECT_TRUE(kinematics.solve(chain.place(goal), q, none, workspace));
  EXPECT_EQ(q, goal);
  q = other;
  EXPECT_FALSE(kinematics.solve(chain.place(goal), q, none, workspace));
  EXPECT_EQ(q, other);
}

TEST(InverseKinematics, RepeatsItselfAndAllocatesNothing) {
  for (const Chain& chain : allChains()) {
    SCOPED_TRACE(chain.name());
    const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
    InverseKinematics::Workspace fresh(kinematics), used(kinematics);
    Configurations goals(chain, 14), seeds(chain, 15);
    for (int i = 0; i < 20; ++i) {
      const Isometry3d target = chain.place(goals.next());
      std::vector<double> q = seeds.next(), again = q;
      const long before = test::allocations;
      const bool solved = kinematics.solve(target, q, {}, used);
      EXPECT_EQ(test::allocations, before);
      fresh = InverseKinematics::Workspace(kinematics);
      EXPECT_EQ(kinematics.solve(target, again, {}, fresh), solved);
      EXPECT_EQ(q, again);
    }
  }
}

TEST(PoseError, IsADistanceAndAnAngle) {
  const Isometry3d here = someTool();
  const Vector3d axis = Vector3d(2, -1, 3).normalized();
  for (const double angle : {0.0, 1e-15, 1e-9, 1e-3, 1.0, 3.0, kPi - 1e-7, kPi}) {
    Isometry3d there = here;
    there.linear() = AngleAxisd(angle, axis) * here.linear();
    there.translation() += Vector3d(0.3, 0, -0.4);
    const PoseError error = poseError(there, here);
    EXPECT_NEAR(error.position, 0.5, 1e-15);
    EXPECT_NEAR(error.angle, angle, 1e-15 + 1e-15 * angle);
    EXPECT_NEAR(poseError(here, there).angle, error.angle, 1e-14);
  }
}

TEST(InverseKinematics, SaysWhatCannotBeBuilt) {
  const auto robot = test::modelRobot("rook6");
  const auto build = [&](const std::string& group, const std::string& link,
                         const std::optional<Eigen::VectorXd>& reference = {},
                         const Isometry3d& tool = Isometry3d::Identity()) {
    return messageOf([&] { InverseKinematics(robot, group, link, reference, tool); });
  };
  EXPECT_EQ(messageOf([] { InverseKinematics({}, "arm", "tool"); }),
            "InverseKinematics: no robot given");
  EXPECT_EQ(build("leg", "tool"), "InverseKinematics: robot 'rook6' has no group 'leg'");
  EXPECT_EQ(build("arm", "nose"), "InverseKinematics: robot 'rook6' has no link 'nose'");
  EXPECT_EQ(build("arm", "base_link"),
            "InverseKinematics: group 'arm' does not move link 'base_link'");
  EXPECT_EQ(build("arm", "tool", Eigen::VectorXd::Zero(1)),
            "InverseKinematics: the reference has 1 values instead of 6");
  EXPECT_EQ(
      build("arm", "tool", Eigen::VectorXd::Constant(6, kInfinity)),
      "InverseKinematics: '" + robot->variables()[0].name + "' of the reference is not finite");
  Isometry3d bent = Isometry3d::Identity();
  bent.linear() *= 2.0;
  EXPECT_EQ(build("arm", "tool", {}, bent), "InverseKinematics: the tool is not a rigid transform");
}

TEST(InverseKinematics, SaysWhichLimitsLeaveNothing) {
  const InverseKinematics kinematics(test::modelRobot("rook6"), "arm", "tool");
  std::vector<double> lower(6, -1.0), upper(6, 1.0);
  const auto narrow = [&] { return messageOf([&] { kinematics.within(lower, upper); }); };
  EXPECT_EQ(narrow(), "");
  lower[2] = 5.0, upper[2] = 6.0;
  EXPECT_EQ(narrow(), "InverseKinematics: the limits leave no value to variable 'elbow'");
  lower[2] = std::nan("");
  EXPECT_EQ(narrow(), "InverseKinematics: the limits leave no value to variable 'elbow'");
  lower.pop_back();
  EXPECT_EQ(narrow(), "InverseKinematics: the lower limit has 5 values instead of 6");
}

TEST(InverseKinematics, SaysWhatCannotBeSolved) {
  const Chain chain = everyJoint();
  const InverseKinematics kinematics(chain.robot, chain.group, chain.link);
  const InverseKinematics other(test::modelRobot("rook6"), "arm", "tool");
  InverseKinematics::Workspace workspace(kinematics), wrong(other);
  std::vector<double> q = Configurations(chain, 16).next();
  InverseKinematicsOptions options;
  Isometry3d target = Isometry3d::Identity();
  const auto solve = [&](InverseKinematics::Workspace& scratch) {
    return messageOf([&] { kinematics.solve(target, q, options, scratch); });
  };
  EXPECT_EQ(solve(workspace), "");
  EXPECT_EQ(solve(wrong), "InverseKinematics: the workspace is of another object");
  options.positionTolerance = std::nan("");
  EXPECT_EQ(solve(workspace),
            "InverseKinematics: the position tolerance is nan m; it must be above 0");
  options = {.orientationTolerance = 0.0};
  EXPECT_EQ(solve(workspace),
            "InverseKinematics: the orientation tolerance is 0 rad; it must be above 0");
  options = {.firstDamping = 0.0};
  EXPECT_EQ(solve(workspace), "InverseKinematics: the first damping is 0; it must be above 0");
  options = {.maxIterations = -1};
  EXPECT_EQ(solve(workspace),
            "InverseKinematics: the number of iterations is -1; it must be at least 0");
  options = {};
  target.translation().x() = kInfinity;
  EXPECT_EQ(solve(workspace), "InverseKinematics: the target is not a rigid transform");
  target = Isometry3d::Identity();
  for (std::size_t i = q.size() - 4; i < q.size(); ++i) q[i] = 0.0;
  EXPECT_EQ(solve(workspace), "InverseKinematics: the seed has a quaternion without direction");
  EXPECT_FALSE(kinematics.findPose(q));
  const std::string unusable =
      "InverseKinematics: a value is not finite, a quaternion has no direction, or a prismatic "
      "value is outside its limits";
  EXPECT_EQ(messageOf([&] { kinematics.pose(q); }), unusable);
  EXPECT_EQ(messageOf([&] { kinematics.jacobian(q); }), unusable);
  q[0] = std::nan("");
  EXPECT_EQ(solve(workspace), "InverseKinematics: the seed has a value that is not finite");
  EXPECT_EQ(messageOf([&] { kinematics.pose(q); }), unusable);
  q.pop_back();
  EXPECT_EQ(solve(workspace), "InverseKinematics: the seed has 13 values instead of 14");
  EXPECT_EQ(messageOf([&] { kinematics.findPose(q); }),
            "InverseKinematics: the configuration has 13 values instead of 14");
}

}  // namespace
}  // namespace swept
