// SPDX-License-Identifier: BSD-3-Clause
// Which pairs of links can collide: pairs that are known by construction, and a refuter that looks
// for contacts of pairs said never to have any.
#include "swept/robot_model/allowed_collision_matrix.hpp"
#include "model_robots.hpp"
#include "models_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "data_folder.hpp"
#include "input_files.hpp"
#include "matrix_robots.hpp"
#include "swept/core/tolerances.hpp"
#include "swept/robot_model/checker.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using matrix_test::ball;
using matrix_test::jointText;
using matrix_test::linkText;
using matrix_test::reportOf;
using matrix_test::robotOf;

/// A ball of 0.1 m that circles at 0.5 m about z, and one that stands `gap` outside its orbit's
/// reach, a radian on. The empty link between keeps the two from being adjacent.
std::shared_ptr<const Robot> orbit(double gap, const std::string& joint) {
  const double far = 0.7 + gap;
  return robotOf(linkText("base", ball(0.1), {far * std::cos(1.0), far * std::sin(1.0), 0.0}) +
                 linkText("arm", "") + linkText("hand", ball(0.1), {0.5, 0.0, 0.0}) + joint +
                 jointText("wrist", "fixed", "arm", "hand"));
}

PairStatus statusOf(const Robot& robot, const std::string& a, const std::string& b,
                    const AllowedCollisionMatrixOptions& options = {}) {
  return reportOf(robot, computeAllowedCollisionMatrix(robot, options), a, b).status;
}

/// The witness is within the limits, keeps what does not matter, and is in contact.
void expectWitness(const Robot& robot, const LinkPairReport& report, double margin = 0.0) {
  const std::string names =
      robot.links()[report.linkA].name + " - " + robot.links()[report.linkB].name;
  ASSERT_TRUE(report.witness) << names;
  const Eigen::VectorXd& q = *report.witness;
  ASSERT_EQ(q.size(), static_cast<Eigen::Index>(robot.variables().size()));
  const std::set<int> relevant(report.variables.begin(), report.variables.end());
  for (std::size_t v = 0; v < robot.variables().size(); ++v) {
    const double value = q[static_cast<Eigen::Index>(v)];
    EXPECT_GE(value, robot.variables()[v].lower) << names;
    EXPECT_LE(value, robot.variables()[v].upper) << names;
    if (!relevant.contains(static_cast<int>(v))) {
      EXPECT_EQ(value, robot.defaultState()[static_cast<Eigen::Index>(v)]) << names;
    }
  }
  EXPECT_LE(matrix_test::linkDistance(robot, report.linkA, report.linkB, q), margin) << names;
}

TEST(CollisionMatrix, BallsOnAnOrbit) {
  const std::string turns = jointText("turn", "continuous", "base", "arm");
  for (const double gap : {0.1, 1e-3, 1e-5}) {
    const auto robot = orbit(gap, turns);
    const auto report = reportOf(*robot, computeAllowedCollisionMatrix(*robot), "base", "hand");
    EXPECT_EQ(report.status, PairStatus::Never) << gap;
    EXPECT_EQ(report.proven, 1.0);
    EXPECT_FALSE(report.witness);
    EXPECT_THAT(report.variables, testing::ElementsAre(0));
    // With a margin that the gap does not keep they are within it somewhere.
    const auto near = reportOf(
        *robot, computeAllowedCollisionMatrix(*robot, {.margin = gap + 1e-5}), "base", "hand");
    EXPECT_EQ(near.status, PairStatus::MayCollide) << gap;
    expectWitness(*robot, near, gap + 1e-5);
    EXPECT_EQ(statusOf(*robot, "base", "hand", {.margin = 0.5 * gap}), PairStatus::Never);
  }
  for (const double depth : {0.05, 1e-3, 1e-5}) {
    const auto robot = orbit(-depth, turns);
    const auto report = reportOf(*robot, computeAllowedCollisionMatrix(*robot), "base", "hand");
    EXPECT_EQ(report.status, PairStatus::MayCollide) << depth;
    expectWitness(*robot, report);
  }
}

TEST(CollisionMatrix, LimitsCount) {
  const auto turned = [](double lower, double upper) {
    const std::string limits = std::to_string(lower) + " " + std::to_string(upper);
    const auto robot = orbit(-0.05, jointText("turn", "revolute", "base", "arm", limits));
    return statusOf(*robot, "base", "hand");
  };
  // Balls of 0.1 m, 0.65 m and 0.5 m from the axis, meet at this angle between them.
  const double meet = std::acos((0.65 * 0.65 + 0.5 * 0.5 - 0.2 * 0.2) / (2.0 * 0.65 * 0.5));
  // A hair beyond a limit is a configuration, too, though none to show.
  const double beyond = tolerance::kLimit + 1e-5;
  EXPECT_EQ(turned(-3.0, 1.0 - meet - beyond), PairStatus::Never);
  EXPECT_EQ(turned(-3.0, 1.0 - meet - 5e-6), PairStatus::Unknown);
  EXPECT_EQ(turned(-3.0, 1.0 - meet + 1e-5), PairStatus::MayCollide);
  EXPECT_EQ(turned(1.0 + meet + beyond, 6.0), PairStatus::Never);
  EXPECT_EQ(turned(1.0 + meet + 5e-6, 6.0), PairStatus::Unknown);
  EXPECT_EQ(turned(1.0 + meet - 1e-5, 6.0), PairStatus::MayCollide);
  EXPECT_EQ(turned(9.0, 13.0), PairStatus::Never);         // a turn and a half on
  EXPECT_EQ(turned(-40.0, 40.0), PairStatus::MayCollide);  // many turns are one
  EXPECT_EQ(turned(-2000.0, 2000.0), PairStatus::MayCollide);
}

TEST(CollisionMatrix, KnownByConstruction) {
  const auto robot = robotOf(
      linkText("base", "<box size='0.2 0.2 0.2'/>") + linkText("turret", "") +
      linkText("core", ball(0.05)) + linkText("tab", "<box size='0.3 0.02 0.02'/>") +
      linkText("mast", ball(0.02), {0.0, 0.0, 0.5}) +
      linkText("flag", ball(0.05), {0.0, 0.0, 0.55}) +
      linkText("lamp", ball(0.01), {0.0, 0.0, 0.9}) +
      jointText("turn", "continuous", "base", "turret") +
      jointText("in", "fixed", "turret", "core") +
      jointText("rise", "prismatic", "turret", "tab", "0 1") +
      jointText("post", "fixed", "base", "mast") + jointText("stick", "fixed", "mast", "flag") +
      jointText("top", "fixed", "flag", "lamp"));
  const auto reports = computeAllowedCollisionMatrix(*robot);
  EXPECT_EQ(reports.size(), 15u);  // of 6 links; the turret has nothing to collide with
  const auto expect = [&](const char* a, const char* b, PairStatus status) {
    const LinkPairReport report = reportOf(*robot, reports, a, b);
    EXPECT_EQ(report.status, status) << a << " - " << b << ": " << toString(report.status);
    const bool touches = status != PairStatus::Adjacent && status != PairStatus::Never;
    EXPECT_EQ(report.witness.has_value(), touches);
    if (touches) expectWitness(*robot, report);
  };
  expect("base", "core", PairStatus::Always);  // inside it, however it turns
  expect("base", "tab", PairStatus::Default);  // rises out of it
  expect("core", "tab", PairStatus::Default);
  expect("base", "mast", PairStatus::Adjacent);
  expect("base", "flag", PairStatus::Never);  // rigidly attached, apart
  expect("mast", "flag", PairStatus::Adjacent);
  expect("mast", "lamp", PairStatus::Never);
  expect("core", "mast", PairStatus::Never);
  expect("tab", "mast", PairStatus::MayCollide);  // at 0.49 m
  expect("tab", "lamp", PairStatus::MayCollide);
  EXPECT_EQ(reportOf(*robot, reports, "base", "mast").joint, *robot->findJoint("post"));
  EXPECT_TRUE(reportOf(*robot, reports, "base", "flag").variables.empty());
  EXPECT_EQ(reportOf(*robot, reports, "core", "tab").variables.size(),
            1u);  // what turns both is none
  EXPECT_EQ(statusOf(*robot, "base", "core", {.samples = 0}), PairStatus::Default);
}

/// What a checker of all pairs says at the witnesses; a pair that nothing moves is among its
/// standing contacts.
int witnessesFound(const std::shared_ptr<const Robot>& robot,
                   const std::vector<LinkPairReport>& reports) {
  const Checker checker(robot, robot->groups().front().name, std::make_shared<const World>());
  Workspace workspace(checker);
  int witnesses = 0;
  for (const LinkPairReport& report : reports) {
    if (!report.witness) continue;
    ++witnesses;
    const std::string& a = robot->links()[report.linkA].name;
    const std::string& b = robot->links()[report.linkB].name;
    const auto isPair = [&](const auto& pair) {
      return (pair.bodyA == a && pair.bodyB == b) || (pair.bodyA == b && pair.bodyB == a);
    };
    const std::vector<double> q(report.witness->begin(), report.witness->end());
    const StateReport state = checker.reportState(q, workspace);
    EXPECT_TRUE(std::ranges::any_of(state.contacts, isPair) ||
                (report.variables.empty() && std::ranges::any_of(checker.staticContacts(), isPair)))
        << a << " - " << b;
  }
  return witnesses;
}

TEST(CollisionMatrix, ACheckerFindsTheWitnesses) {
  std::mt19937 random(5);
  int onChains = 0;
  for (int i = 0; i < 5; ++i) {
    const auto robot = robotOf(matrix_test::randomChain(random));
    onChains += witnessesFound(
        robot, computeAllowedCollisionMatrix(*robot, {.budget = 1000, .samples = 100}));
  }
  EXPECT_GT(onChains, 5);
  for (const char* name : {"rook6", "rook7"}) {
    const std::string files = modelsDir() + "/robots/" + name + "/" + name;
    const auto robot = Robot::load(files + ".urdf");
    EXPECT_GT(witnessesFound(
                  robot, computeAllowedCollisionMatrix(*robot, {.budget = 1000, .samples = 100})),
              8);
  }
  const auto rigid = robotOf(
      linkText("a", ball(0.1)) + linkText("b", "") + linkText("c", ball(0.1)) +
      jointText("one", "fixed", "a", "b", "", "0.15 0 0") + jointText("two", "fixed", "b", "c") +
      linkText("d", "") + jointText("three", "continuous", "a", "d"));
  EXPECT_EQ(
      witnessesFound(rigid, computeAllowedCollisionMatrix(*rigid, {.budget = 1000, .samples = 0})),
      1);
}

TEST(CollisionMatrix, RigidlyAttachedContactsAreAlways) {
  const auto robot = robotOf(
      linkText("a", ball(0.1)) + linkText("b", "") + linkText("c", ball(0.1)) +
      jointText("one", "fixed", "a", "b", "", "0.15 0 0") + jointText("two", "fixed", "b", "c"));
  EXPECT_EQ(statusOf(*robot, "a", "c", {.samples = 0}), PairStatus::Always);
}

/// Two fingers on a hand; one mimics the other. They meet, or stop `gap` short of it.
std::shared_ptr<const Robot> gripper(double gap, double multiplier) {
  const std::string mimic = "<mimic joint='left' multiplier='" + std::to_string(multiplier) + "'/>";
  return robotOf(
      linkText("hand", "") + linkText("l", "<box size='0.02 0.02 0.1'/>") +
      linkText("r", "<box size='0.02 0.02 0.1'/>") +
      jointText("left", "prismatic", "hand", "l", "0 0.04", std::to_string(-0.05 - gap) + " 0 0",
                "1 0 0") +
      jointText("right", "prismatic", "hand", "r", "0 0.08", "0.05 0 0", "-1 0 0", mimic));
}

TEST(CollisionMatrix, MimicsFollowTheirMasters) {
  // Each stops 0.01 m before the middle, so that the boxes just meet.
  EXPECT_EQ(statusOf(*gripper(1e-4, 1.0), "l", "r"), PairStatus::Never);
  EXPECT_EQ(statusOf(*gripper(-1e-4, 1.0), "l", "r"), PairStatus::MayCollide);
  EXPECT_EQ(statusOf(*gripper(-0.019, 0.5), "l", "r"), PairStatus::Never);
  EXPECT_EQ(statusOf(*gripper(-0.021, 0.5), "l", "r"), PairStatus::MayCollide);
  EXPECT_EQ(statusOf(*gripper(0.041, 2.0), "l", "r"), PairStatus::Never);
  EXPECT_EQ(statusOf(*gripper(0.039, 2.0), "l", "r"), PairStatus::MayCollide);
}

TEST(CollisionMatrix, WhatCannotBeBoundedIsUnknown) {
  const auto between = [](const std::string& joint,
                          const AllowedCollisionMatrixOptions& options = {}) {
    const auto robot =
        robotOf(linkText("base", ball(0.1)) + linkText("arm", "") +
                linkText("hand", ball(0.1), {1.0, 0.0, 0.0}) + linkText("wheel", "") + joint +
                jointText("spin", "continuous", "base", "wheel") +
                jointText("wrist", "fixed", "arm", "hand"));
    const auto report =
        reportOf(*robot, computeAllowedCollisionMatrix(*robot, options), "base", "hand");
    EXPECT_EQ(report.proven, report.status == PairStatus::Never ? 1.0 : 0.0);
    return report.status;
  };
  EXPECT_EQ(between(jointText("free", "floating", "base", "arm")), PairStatus::Unknown);
  EXPECT_EQ(between(jointText("free", "planar", "base", "arm")), PairStatus::Unknown);
  EXPECT_EQ(between(jointText("wide", "prismatic", "base", "arm", "0 1e9")), PairStatus::Unknown);
  const auto geared = [](const std::string& type, const std::string& limits, const char* gear) {
    return jointText("geared", type, "base", "arm", limits, "0 0 0", "0 0 1",
                     std::string("<mimic joint='spin' multiplier='") + gear + "'/>");
  };
  EXPECT_EQ(between(geared("continuous", "", "2")), PairStatus::Never);
  // These would be elsewhere after a turn: what they follow has limits.
  EXPECT_EQ(between(geared("continuous", "", "0.5")), PairStatus::Never);
  EXPECT_EQ(between(geared("prismatic", "0 1", "0.01")), PairStatus::Never);
  // No budget, no proof.
  EXPECT_EQ(between(jointText("turn", "continuous", "base", "arm")), PairStatus::Never);
  EXPECT_EQ(between(jointText("turn", "continuous", "base", "arm"), {.budget = 0}),
            PairStatus::Unknown);
}

TEST(CollisionMatrix, RefusesWhatMeansNothing) {
  const auto robot = orbit(0.1, jointText("turn", "continuous", "base", "arm"));
  const auto refusal = [&](const AllowedCollisionMatrixOptions& options) {
    return test::messageOf([&] { computeAllowedCollisionMatrix(*robot, options); });
  };
  EXPECT_EQ(refusal({.margin = -1e-9}),
            "computeAllowedCollisionMatrix: margin -1e-09 m must be a finite number that is not "
            "negative");
  EXPECT_EQ(
      refusal({.margin = std::nan("")}),
      "computeAllowedCollisionMatrix: margin nan m must be a finite number that is not negative");
  EXPECT_EQ(refusal({.budget = -1}),
            "computeAllowedCollisionMatrix: budget -1 must not be negative");
  EXPECT_EQ(refusal({.samples = -2}),
            "computeAllowedCollisionMatrix: samples -2 must not be negative");
}

void expectSame(const std::vector<LinkPairReport>& a, const std::vector<LinkPairReport>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].status, b[i].status);
    EXPECT_EQ(a[i].witness, b[i].witness);
    EXPECT_EQ(a[i].proven, b[i].proven);
    EXPECT_EQ(a[i].effort, b[i].effort);
  }
}

TEST(CollisionMatrix, IsTheSameOnAnyNumberOfThreadsAndEachTime) {
  std::mt19937 random(8);
  int unknown = 0;
  for (int i = 0; i < 5; ++i) {
    const auto robot = robotOf(matrix_test::randomChain(random));
    // So little that some pairs are left open.
    const AllowedCollisionMatrixOptions options{.budget = 200, .samples = 20, .threads = 1};
    const auto one = computeAllowedCollisionMatrix(*robot, options);
    expectSame(one, computeAllowedCollisionMatrix(*robot, options));
    AllowedCollisionMatrixOptions many = options;
    many.threads = 5;
    expectSame(one, computeAllowedCollisionMatrix(*robot, many));
    for (const LinkPairReport& report : one) {
      unknown += report.status == PairStatus::Unknown ? 1 : 0;
      EXPECT_GE(report.proven, 0.0);
      EXPECT_LE(report.proven, 1.0);
    }
  }
  EXPECT_GT(unknown, 0);
}

/// m; the least distance that random configurations and steps downhill from the nearest of them
/// find.
double refute(const Robot& robot, const LinkPairReport& report, int samples, std::mt19937& random) {
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd nearest = robot.defaultState();
  for (int i = 0; i < samples; ++i) {
    const Eigen::VectorXd q = matrix_test::randomState(robot, random);
    const double distance = matrix_test::linkDistance(robot, report.linkA, report.linkB, q);
    if (!(distance < least)) continue;
    least = distance;
    nearest = q;
  }
  std::normal_distribution<double> normal;
  double step = 0.2;
  for (int i = 0; i < samples; ++i) {
    Eigen::VectorXd q = nearest;
    for (const int v : report.variables) {
      const Variable& variable = robot.variables()[v];
      q[v] = std::clamp(q[v] + step * normal(random) * (variable.upper - variable.lower),
                        variable.lower, variable.upper);
    }
    const double distance = matrix_test::linkDistance(robot, report.linkA, report.linkB, q);
    step *= distance < least ? 1.5 : 0.95;
    if (!(distance < least)) continue;
    least = distance;
    nearest = q;
  }
  return least;
}

struct Tally {
  int never = 0, several = 0, mayCollide = 0;
  std::vector<double> least;  ///< m, per report; 0 where it is not Never
};

Tally refuteAll(const Robot& robot, const std::vector<LinkPairReport>& reports, int samples,
                std::mt19937& random) {
  Tally tally;
  for (const LinkPairReport& report : reports) {
    const std::string names =
        robot.links()[report.linkA].name + " - " + robot.links()[report.linkB].name;
    if (report.witness) expectWitness(robot, report);
    tally.mayCollide += report.status == PairStatus::MayCollide ? 1 : 0;
    tally.least.push_back(0.0);
    if (report.status != PairStatus::Never) continue;
    tally.least.back() = refute(robot, report, samples, random);
    EXPECT_GT(tally.least.back(), 0.0) << names;
    ++tally.never;
    tally.several += report.variables.size() > 1 ? 1 : 0;
  }
  return tally;
}

TEST(CollisionMatrix, NothingRefutesNeverOnRandomChains) {
  std::mt19937 random(21);
  int never = 0, several = 0, mayCollide = 0, within = 0, found = 0, beyond = 0, proven = 0;
  for (int i = 0; i < 25; ++i) {
    const auto robot = robotOf(matrix_test::randomChain(random));
    AllowedCollisionMatrixOptions options{.budget = 100'000, .samples = 100};
    const Tally tally =
        refuteAll(*robot, computeAllowedCollisionMatrix(*robot, options), 300, random);
    never += tally.never;
    several += tally.several;
    mayCollide += tally.mayCollide;
    // A margin that some of the pairs do not keep, by a little: what the refuter came within is
    // not Never any more; and of the rest most is.
    for (const double some : tally.least) {
      if (some == 0.0) continue;
      options.margin = some;
      const auto reports = computeAllowedCollisionMatrix(*robot, options);
      for (std::size_t k = 0; k < reports.size(); ++k) {
        if (tally.least[k] == 0.0) continue;
        const bool near = tally.least[k] <= options.margin;
        const PairStatus status = reports[k].status;
        EXPECT_FALSE(near && status == PairStatus::Never) << tally.least[k];
        if (reports[k].witness) expectWitness(*robot, reports[k], options.margin);
        within += near ? 1 : 0;
        found += near && status == PairStatus::MayCollide ? 1 : 0;
        const bool far = tally.least[k] > 1.2 * options.margin + 0.005;
        beyond += far ? 1 : 0;
        proven += far && status == PairStatus::Never ? 1 : 0;
      }
      break;
    }
  }
  EXPECT_GT(never, 100);
  EXPECT_GT(several, 80);
  EXPECT_GT(mayCollide, 20);
  EXPECT_GT(within, 40);
  EXPECT_GT(found, within / 2);
  EXPECT_GT(beyond, 30);
  EXPECT_GT(proven, beyond / 2);
}

class OwnRobots : public testing::TestWithParam<const char*> {};

/// The models' generator proved its pairs with other covers and bounds.
TEST_P(OwnRobots, AgreeWithTheirSrdf) {
  const std::string name = GetParam();
  const auto robot = test::modelRobot(name);
  const auto reports = computeAllowedCollisionMatrix(*robot, {.budget = 100'000, .samples = 200});
  std::mt19937 random(4);
  const Tally tally = refuteAll(*robot, reports, 60, random);
  std::map<std::pair<int, int>, PairStatus> found;
  for (const LinkPairReport& report : reports) found[{report.linkA, report.linkB}] = report.status;
  ASSERT_GT(robot->disabledPairs().size(), 10u);
  for (const DisabledPair& pair : robot->disabledPairs()) {
    const auto status = found.at(std::minmax(pair.linkA, pair.linkB));
    const std::string names =
        robot->links()[pair.linkA].name + " - " + robot->links()[pair.linkB].name;
    if (pair.reason == "Default") {
      EXPECT_TRUE(status == PairStatus::Default || status == PairStatus::Always) << names;
    } else {
      EXPECT_EQ(status, pair.reason == "Never" ? PairStatus::Never : PairStatus::Adjacent) << names;
    }
  }
  EXPECT_GT(tally.never, 4);
  EXPECT_GT(tally.mayCollide, 9);
}

INSTANTIATE_TEST_SUITE_P(Models, OwnRobots, testing::Values("rook6", "rook7"),
                         [](const auto& each) { return std::string(each.param); });

class Published : public testing::TestWithParam<const char*> {};

/// Every pair that the file disables is proven apart, in contact where it begins, or has a witness.
TEST_P(Published, AgreesExceptWhereThereIsAWitness) {
  const auto data = dataFolder();
  if (!data) GTEST_SKIP() << "skipped: SWEPT_DATA is not set";
  const std::string name = GetParam();
  const auto files = *data / "robots" / name / name;
  const auto robot = Robot::load(files.string() + ".urdf", files.string() + ".srdf");
  const auto reports = computeAllowedCollisionMatrix(*robot, {.budget = 2'000'000, .samples = 200});
  std::map<std::pair<int, int>, const LinkPairReport*> found;
  for (const LinkPairReport& report : reports) found[{report.linkA, report.linkB}] = &report;
  int agreed = 0, witnessed = 0;
  for (const DisabledPair& pair : robot->disabledPairs()) {
    const auto known = found.find(std::minmax(pair.linkA, pair.linkB));
    if (known == found.end()) continue;  // a link without collision geometry
    const LinkPairReport& report = *known->second;
    EXPECT_NE(report.status, PairStatus::Unknown)
        << robot->links()[pair.linkA].name << " - " << robot->links()[pair.linkB].name;
    if (report.status == PairStatus::MayCollide) {
      expectWitness(*robot, report);
      ++witnessed;
    } else {
      ++agreed;
    }
  }
  EXPECT_GE(agreed, 30);
  EXPECT_LE(witnessed, 2);
}

INSTANTIATE_TEST_SUITE_P(Robots, Published, testing::Values("panda", "ur5"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace swept
