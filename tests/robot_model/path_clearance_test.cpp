// SPDX-License-Identifier: BSD-3-Clause
// The clearance of a path is the least of its motions' and of the states on them, for less work.
#include "swept/robot_model/path_clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/named_states.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector2d;
using test::messageOf;
using Path = std::vector<std::vector<double>>;

constexpr double kAccuracy = 1e-4;  // m
/// m: to so much of the accuracy are distances measured on the way.
constexpr double kMeasured = 0.25 * kAccuracy + 1e-8;
constexpr double kRounding = 1e-8;  // m, of poses and distances
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Checker armIn(const std::string& scene) {
  const std::string models = modelsDir();
  const std::string arm = models + "/robots/rook7/rook7";
  return {Robot::load(arm + ".urdf", arm + ".srdf"), "arm",
          std::make_shared<const World>(World::load(models + "/scenes/" + scene))};
}

/// Small steps from a state on, so that paths are of all kinds: free, near and in contact.
Path randomPath(std::mt19937& random, const Checker& checker, std::size_t size, double most) {
  std::uniform_real_distribution<double> step(-most, most);  // rad
  Path path{namedConfiguration(checker.robot(), checker.group(), "home")};
  while (path.size() < size) {
    path.push_back(path.back());
    for (double& value : path.back()) value += step(random);
  }
  return path;
}

/// What a loop over the motions finds, and what it takes.
MotionClearance loopOver(const Checker& checker, const Path& path, ClearanceQuery query,
                         Workspace& workspace) {
  MotionClearance loop;
  loop.lower = loop.world.lower = loop.self.lower = kInfinity;
  const auto add = [](const ClearanceInterval& own, ClearanceInterval& all) {
    all.lower = std::min(all.lower, own.lower);
    all.upper = std::min(all.upper, own.upper);
  };
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const auto own = checker.motionClearance(path[i], path[i + 1], kAccuracy, workspace, query);
    add(own, loop);
    add(own.world, loop.world);
    add(own.self, loop.self);
    loop.intervals += own.intervals;
  }
  return loop;
}

/// Whether the two intervals hold one number, and this one is as narrow as was asked for.
void expectLeast(const PathClearanceInterval& found, const ClearanceInterval& loop) {
  EXPECT_LE(found.lower, loop.upper + kRounding);
  EXPECT_LE(loop.lower, found.upper + kRounding);
  EXPECT_LE(found.lower, found.upper);
  EXPECT_LE(found.upper - found.lower, kAccuracy + kRounding);
  EXPECT_TRUE(found.upper < kAccuracy / 50 || found.lower >= found.upper / 2);
  EXPECT_EQ(found.segment.has_value(), found.upper < kInfinity);
}

class PathClearances : public testing::TestWithParam<std::string> {
 protected:
  PathClearances() : checker_(armIn(GetParam())), workspace_(checker_) {}

  StateReport reportAt(const Path& path, std::size_t segment, double t) {
    return checker_.reportState(checker_.interpolate(path.at(segment), path.at(segment + 1), t),
                                workspace_);
  }
  /// It is attained where it says, and nowhere is it less.
  void expectAttained(const Path& path, const PathClearance& found) {
    ASSERT_TRUE(found.world.segment && found.self.segment && found.segment);
    const NearestPair world = reportAt(path, *found.world.segment, found.world.t).world;
    EXPECT_LE(world.clearance, found.world.upper + kRounding);
    EXPECT_GE(world.clearance, found.world.upper - kMeasured);
    const NearestPair self = reportAt(path, *found.self.segment, found.self.t).self;
    EXPECT_LE(self.clearance, found.self.upper + kRounding);
    EXPECT_GE(self.clearance, found.self.upper - kMeasured);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      for (const double t : {0.21, 0.5, 1.0}) {
        const StateReport state = reportAt(path, i, t);
        EXPECT_GE(state.world.clearance, found.world.lower - kRounding);
        EXPECT_GE(state.self.clearance, found.self.lower - kRounding);
      }
    }
  }

  Checker checker_;
  Workspace workspace_;
};
INSTANTIATE_TEST_SUITE_P(In, PathClearances, testing::Values("narrow_slot.yaml", "shelf.yaml"),
                         [](const auto& scene) {
                           return scene.param.substr(0, scene.param.find('.'));
                         });

TEST_P(PathClearances, AreTheLeastOfAllMotionsAndStates) {
  std::mt19937 random(7);
  std::int64_t spent = 0, spentByLoop = 0;
  int apart = 0, touching = 0, later = 0;
  for (std::size_t round = 0; round < 30; ++round) {
    const Path path = randomPath(random, checker_, 2 + round % 10, round % 2 == 0 ? 0.1 : 0.6);
    const PathClearance found = pathClearance(checker_, path, kAccuracy, workspace_);
    const MotionClearance loop = loopOver(checker_, path, ClearanceQuery::ByKind, workspace_);
    expectLeast(found, loop);
    expectLeast(found.world, loop.world);
    expectLeast(found.self, loop.self);
    expectAttained(path, found);
    // The whole is the nearer of the two.
    const PathClearanceInterval& nearer = found.selfPair ? found.self : found.world;
    EXPECT_EQ(found.upper, std::min(found.world.upper, found.self.upper));
    EXPECT_EQ(found.lower, std::min(found.world.lower, found.self.lower));
    EXPECT_EQ(found.segment, nearer.segment);
    EXPECT_EQ(found.bodyB, nearer.bodyB);

    const PathClearance least =
        pathClearance(checker_, path, kAccuracy, workspace_, ClearanceQuery::Least);
    expectLeast(least, loop);
    ASSERT_TRUE(least.segment);
    const StateReport state = reportAt(path, *least.segment, least.t);
    const double there = least.selfPair ? state.self.clearance : state.world.clearance;
    EXPECT_LE(there, least.upper + kRounding);
    EXPECT_GE(there, least.upper - kMeasured);
    EXPECT_EQ(least.world.upper, kInfinity);

    for (const auto query : {ClearanceQuery::World, ClearanceQuery::Self}) {
      const bool self = query == ClearanceQuery::Self;
      const PathClearance one = pathClearance(checker_, path, kAccuracy, workspace_, query);
      expectLeast(one, self ? loop.self : loop.world);
      EXPECT_EQ(one.selfPair, self);
      EXPECT_EQ(one.segment, (self ? one.self : one.world).segment);
      EXPECT_EQ((self ? one.world : one.self).upper, kInfinity);
    }

    spent += found.intervals;
    spentByLoop += loop.intervals;
    (found.world.upper > 0.0 ? apart : touching) += 1;
    later += *found.world.segment > 0 ? 1 : 0;
  }
  EXPECT_GE(apart, 10);
  EXPECT_GE(touching, 5);
  EXPECT_GE(later, 10);
  RecordProperty("intervals", static_cast<int>(spent));
  RecordProperty("intervals_of_a_loop", static_cast<int>(spentByLoop));
  EXPECT_LT(3 * spent, 2 * spentByLoop);
}

// A ball on two axes beside a post: what is known by hand.
constexpr const char* kUrdf = R"(<robot name='crane'>
  <link name='base'/><link name='carriage'/>
  <link name='ball'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <joint name='x' type='prismatic'><parent link='base'/><child link='carriage'/>
    <axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='1' velocity='1'/></joint>
  <joint name='y' type='prismatic'><parent link='carriage'/><child link='ball'/>
    <axis xyz='0 1 0'/><limit lower='-9' upper='9' effort='1' velocity='1'/></joint>
</robot>)";

class PathBesideAPost : public testing::Test {
 protected:
  static Checker checker() {
    World world;
    world.add("post", makeSphere(0.1), Isometry3d(Translation3d(0, 0, 0)));
    return {Robot::parse(kUrdf, "crane.urdf"), "all",
            std::make_shared<const World>(std::move(world))};
  }
  PathClearance of(const ConfigurationList& path, ClearanceQuery query = ClearanceQuery::ByKind) {
    return pathClearance(checker_, path, kAccuracy, workspace_, query);
  }

  Checker checker_ = checker();
  Workspace workspace_{checker_};
};

TEST_F(PathBesideAPost, IsNearestInTheMiddleOfASegment) {
  const std::vector<Vector2d> path{{-1, -2}, {-1, 2}, {0.6, 2}, {0.6, -2}};
  for (const auto query : {ClearanceQuery::ByKind, ClearanceQuery::Least}) {
    const PathClearance found = of(path, query);
    EXPECT_NEAR(found.upper, 0.4, kAccuracy);
    EXPECT_LE(found.lower, 0.4 + kRounding);
    EXPECT_GE(found.lower, 0.4 - kAccuracy);
    EXPECT_EQ(found.segment, 2u);
    EXPECT_NEAR(found.t, 0.5, 0.01);
    EXPECT_EQ(found.bodyA, "ball");
    EXPECT_EQ(found.bodyB, "post");
    EXPECT_FALSE(found.selfPair);
  }
  // There are no pairs of the robot's own.
  EXPECT_EQ(of(path).self.lower, kInfinity);
  EXPECT_EQ(of(path).self.upper, kInfinity);
  EXPECT_FALSE(of(path).self.segment);
}

TEST_F(PathBesideAPost, OneStateIsAMotionOnTheSpot) {
  const PathClearance found = of({{0.0, 0.5}});
  EXPECT_NEAR(found.upper, 0.3, kRounding);
  EXPECT_NEAR(found.lower, 0.3, kAccuracy);
  EXPECT_EQ(found.segment, 0u);
}

TEST_F(PathBesideAPost, StatesMayBeOfDifferentTypes) {
  const std::vector<double> vector{-1, 0.5};
  const Eigen::VectorXd eigen{{1, 0.5}};
  const std::array<double, 2> array{2, 2};
  EXPECT_NEAR(of({vector, eigen, array}).upper, 0.3, kAccuracy);
}

TEST_F(PathBesideAPost, ContactEndsTheSearch) {
  const Path through{{-1, 0}, {1, 0}, {1, 1}, {0, 0.5}};
  for (const auto query : {ClearanceQuery::ByKind, ClearanceQuery::Least}) {
    const PathClearance found = of(through, query);
    EXPECT_EQ(found.upper, 0.0);
    EXPECT_EQ(found.lower, 0.0);
    EXPECT_EQ(found.segment, 0u);
  }
}

// What is not finite is not known to keep away, whatever the other motions do.
TEST_F(PathBesideAPost, NothingIsProvenOfWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Path path{{-1, 0.5}, {1, 0.5}, {nan, 0.5}, {2, 2}, {2, 3}};
  const PathClearance found = of(path);
  EXPECT_EQ(found.lower, 0.0);
  EXPECT_EQ(found.world.lower, 0.0);
  EXPECT_NEAR(found.upper, 0.3, kAccuracy);
  EXPECT_EQ(found.segment, 0u);
  const PathClearance nothing = of({{nan, 0.0}});
  EXPECT_EQ(nothing.lower, 0.0);
  EXPECT_EQ(nothing.upper, kInfinity);
  EXPECT_FALSE(nothing.segment);
}

// Each motion is taken apart where the obstacle changes its way.
TEST_F(PathBesideAPost, ObstaclesMove) {
  const auto at = [](double x) { return Isometry3d(Translation3d(x, 2, 0)); };
  const Checker moving =
      checker_.withObstacle({.name = "truck",
                             .parts = {{makeSphere(0.1), Isometry3d::Identity()}},
                             .waypoints = {{0, at(-3)}, {1, at(-3)}, {2, at(3)}, {3, at(3)}}});
  Workspace workspace(moving);
  // The ball waits 1 m from the truck's way, which passes it at 1.5 s, in the second motion.
  const Path path{{0, 3, 0}, {0, 3, 1.25}, {0, 3, 3}};
  const PathClearance found = pathClearance(moving, path, kAccuracy, workspace);
  EXPECT_NEAR(found.world.upper, 0.8, kAccuracy);
  EXPECT_GE(found.world.lower, 0.8 - kAccuracy);
  EXPECT_EQ(found.world.segment, 1u);
  EXPECT_NEAR(1.25 + 1.75 * found.world.t, 1.5, 0.01);
  EXPECT_EQ(found.world.bodyB, "truck");
}

TEST_F(PathBesideAPost, BadArgumentsAreRefused) {
  EXPECT_EQ(messageOf([&] { (void)of(Path{}); }), "pathClearance: a path has at least one state");
  EXPECT_EQ(messageOf([&] {
              (void)of({{0, 0}, {1}});
            }),
            "Checker: a configuration of group 'all' has 2 values, not 1");
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(messageOf([&] { (void)pathClearance(checker_, {{0, 0}}, bad, workspace_); }), "");
}

}  // namespace
}  // namespace swept
