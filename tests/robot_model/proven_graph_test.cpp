// SPDX-License-Identifier: BSD-3-Clause
// Motions of a graph while the world changes, each against a checker that was made from nothing.
#include "swept/robot_model/proven_graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numbers>
#include <random>
#include <set>
#include <stop_token>
#include <string>
#include <thread>

#include "models_dir.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using test::at;
using test::messageOf;

/// What the changes of a test gave.
struct Tally {
  std::size_t compared = 0, free = 0, blocked = 0, more = 0;
  std::size_t freed = 0, lost = 0, arithmetic = 0, asked = 0;
};

/// A copy of the checker's world with the bodies in another order: nothing is shared.
Checker fromNothing(const Checker& checker, const std::shared_ptr<const Robot>& robot) {
  World world;
  const std::vector<WorldBody>& bodies = checker.world().bodies();
  for (auto body = bodies.rbegin(); body != bodies.rend(); ++body) world.add(*body);
  return Checker(robot, checker.group().name, test::shared(std::move(world)), checker.options());
}

void compareWithRecheck(const ProvenGraph& graph, const std::shared_ptr<const Robot>& robot,
                        Tally& tally) {
  const Checker fresh = fromNothing(*graph.checker(), robot);
  Workspace workspace(fresh);
  for (std::size_t i = 0; i < graph.motions(); ++i) {
    const ConfigurationView from = graph.state(graph.motion(i).from);
    const ConfigurationView to = graph.state(graph.motion(i).to);
    const Verdict verdict =
        fresh.certifyMotion(from, to, workspace, MotionQuery::VerdictOnly).verdict;
    ++tally.compared;
    ++(graph.isFree(i) ? tally.free : tally.blocked);
    ASSERT_EQ(graph.isFree(i), graph.verdict(i) == Verdict::Free);
    ASSERT_EQ(graph.isFree(i), graph.blockedBy(i).empty());
    if (graph.isFree(i)) {
      ASSERT_NE(verdict, Verdict::Collision) << "motion " << i << " is not free";
      tally.more += verdict == Verdict::Undecided ? 1 : 0;
    } else {
      ASSERT_NE(verdict, Verdict::Free) << "motion " << i << " is lost";
    }
    for (const std::string& name : graph.blockedBy(i))
      ASSERT_NE(fresh.world().find(name), nullptr) << name;
  }
}

std::vector<double> nearTo(const Checker& checker, const std::vector<double>& q, double share,
                           std::mt19937& random) {
  std::vector<double> to = test::randomConfiguration(checker, random);
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = q[i] + share * (to[i] - q[i]);
  return to;
}

ProvenGraph randomGraph(const std::shared_ptr<const Checker>& checker, std::size_t states,
                        std::mt19937& random) {
  ProvenGraph graph(checker);
  std::vector<ProvenGraph::Motion> motions;
  for (std::size_t i = 0; i < states; ++i) {
    const std::vector<double> q = test::randomConfiguration(*checker, random);
    const std::uint32_t from = graph.addState(q);
    for (const double share : {0.15, 0.4}) {
      const std::uint32_t to = graph.addState(nearTo(*checker, q, share, random));
      motions.push_back({from, to});
    }
  }
  EXPECT_GT(graph.addMotions(motions), motions.size() / 3);
  return graph;
}

class Changes {
 public:
  Changes(unsigned seed, double reach) : random_(seed), reach_(reach) {}

  /// One to three bodies added, removed, moved, or of another shape.
  Checker next(const Checker& checker) {
    Checker changed = checker;
    const int count = 1 + static_cast<int>(random_() % 3);
    for (int i = 0; i < count; ++i) changed = one(changed);
    return changed;
  }
  std::mt19937& random() { return random_; }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Eigen::Isometry3d anywhere() {
    Eigen::Isometry3d pose =
        at(uniform(-reach_, reach_), uniform(-reach_, reach_), uniform(0.0, 1.3 * reach_));
    pose.rotate(Eigen::AngleAxisd(uniform(-3.0, 3.0),
                                  Eigen::Vector3d(uniform(-1, 1), uniform(-1, 1), 1).normalized()));
    return pose;
  }
  Shape anyShape() {
    const double size = 0.15 * reach_;
    switch (random_() % 8) {
      case 0:
        return Sphere{uniform(0.3 * size, size)};
      case 1:
        return Capsule{uniform(0.2 * size, 0.6 * size), uniform(0.0, size)};
      case 2:
        return Cylinder{uniform(0.2 * size, size), uniform(0.1 * size, size)};
      case 3: {
        std::vector<Eigen::Vector3d> points;
        for (int i = 0; i < 200; ++i)
          points.emplace_back(uniform(-size, size), uniform(-size, size), uniform(0.0, 0.2 * size));
        return PointCloud::build(points, 0.01);
      }
      case 4: {
        const std::vector<Eigen::Vector3d> corners{
            {0, 0, 0}, {2 * size, 0, 0}, {0, 2 * size, 0}, {0, 0, 2 * size}};
        const std::vector<TriangleMesh::Triangle> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
        return TriangleMesh::build(corners, faces);
      }
      case 5:
        return makeHalfSpace({uniform(-1, 1), uniform(-1, 1), 2.0}, -1.4 * reach_);
      default:
        return Box{
            {uniform(0.2 * size, size), uniform(0.2 * size, size), uniform(0.2 * size, size)}};
    }
  }
  WorldBody anyBody(const std::string& name) {
    WorldBody body{.name = name};
    const Eigen::Isometry3d pose = anywhere();
    const std::size_t parts = random_() % 10 == 0 ? 40 : 1 + random_() % 2;
    for (std::size_t i = 0; i < parts; ++i) {
      Shape shape = anyShape();
      const bool isFlat = std::holds_alternative<HalfSpace>(shape);
      body.parts.push_back({std::move(shape), isFlat      ? Eigen::Isometry3d::Identity()
                                              : parts > 2 ? anywhere() * pose
                                                          : pose});
    }
    return body;
  }
  Checker one(const Checker& checker) {
    const std::vector<WorldBody>& bodies = checker.world().bodies();
    const std::size_t kind = bodies.size() < 3 ? 0 : bodies.size() > 14 ? 1 : random_() % 4;
    if (kind == 0) return checker.withBody(anyBody("new" + std::to_string(count_++)));
    WorldBody body = bodies[random_() % bodies.size()];
    if (kind == 1) return checker.withoutBody(body.name);
    if (kind == 2) return checker.withReplaced(anyBody(body.name));
    const Eigen::Isometry3d moved = at(0.1 * reach_ * uniform(-1, 1), 0.1 * reach_, 0.0);
    for (WorldBody::Part& part : body.parts) part.world_from_shape = moved * part.world_from_shape;
    return checker.withReplaced(std::move(body));
  }

  std::mt19937 random_;
  double reach_;
  int count_ = 0;
};

void changeAndCompare(const std::shared_ptr<const Robot>& robot, const std::string& group,
                      const CheckerOptions& options, World world, unsigned seed, double reach,
                      std::size_t states, int rounds, unsigned threads, Tally& tally) {
  Changes changes(seed, reach);
  auto checker =
      std::make_shared<const Checker>(robot, group, test::shared(std::move(world)), options);
  ProvenGraph graph = randomGraph(checker, states, changes.random());
  compareWithRecheck(graph, robot, tally);
  for (int round = 0; round < rounds && !testing::Test::HasFatalFailure(); ++round) {
    const auto next = std::make_shared<const Checker>(changes.next(*graph.checker()));
    std::vector<char> before;
    for (std::size_t i = 0; i < graph.motions(); ++i) before.push_back(graph.isFree(i) ? 1 : 0);
    const ProvenGraph::Change change = graph.update(next, threads);
    ASSERT_FALSE(change.everything);
    std::size_t freed = 0, blocked = 0;
    for (std::size_t i = 0; i < graph.motions(); ++i) {
      freed += before[i] == 0 && graph.isFree(i) ? 1 : 0;
      blocked += before[i] != 0 && !graph.isFree(i) ? 1 : 0;
    }
    ASSERT_EQ(change.freed, freed);
    ASSERT_EQ(change.blocked, blocked);
    ASSERT_EQ(change.byArithmetic + change.asked, change.bodiesNew * graph.motions());
    ASSERT_LE(change.motionsAsked, change.asked);
    tally.freed += freed;
    tally.lost += blocked;
    tally.arithmetic += change.byArithmetic;
    tally.asked += change.asked;
    compareWithRecheck(graph, robot, tally);
  }
}

void expectRepresentative(const Tally& tally) {
  EXPECT_GT(20 * tally.free, tally.compared);
  EXPECT_GT(20 * tally.blocked, tally.compared);
  EXPECT_GT(100 * tally.freed, tally.compared / 10);
  EXPECT_GT(100 * tally.lost, tally.compared / 10);
  EXPECT_GT(5 * tally.arithmetic, tally.asked);
  EXPECT_GT(50 * tally.asked, tally.arithmetic);
  EXPECT_LT(100 * tally.more, tally.compared);
}

TEST(ProvenGraph, IsAsARecheckAfterAnyChanges) {
  Tally tally;
  const auto robot = test::parseArm(test::armUrdf({}));
  for (unsigned seed = 0; seed < 12; ++seed) {
    CheckerOptions options;
    options.margin = seed % 3 == 1 ? 0.02 : 0.0;
    if (seed % 4 == 2) options.worldMargin = 0.03;
    if (seed % 4 == 3)
      options.attached = {{"tool", "hand", {{Box{{0.02, 0.02, 0.1}}, at(0, 0, 0.1)}}, {"fore"}}};
    if (seed % 6 == 4) options.tracking.rotation = 0.01;
    if (seed % 6 == 5) options.constraints = TaskConstraint::upright("hand", 2.5);
    changeAndCompare(robot, "all", options, test::clutter(seed, 6), seed, 0.6, 30, 15,
                     seed % 2 == 0 ? 1 : 2, tally);
  }
  expectRepresentative(tally);
}

TEST(ProvenGraph, OfArmsWithMeshesIsAsARecheck) {
  const std::filesystem::path robots = std::filesystem::path(modelsDir()) / "robots";
  Tally tally;
  for (const char* name : {"rook7", "rook6_cart"}) {
    const std::filesystem::path urdf = robots / name / (std::string(name) + ".urdf");
    const auto robot = Robot::load(urdf, Robot::srdfBeside(urdf));
    changeAndCompare(robot, robot->groups().front().name, {}, World(), 5, 0.7, 40, 15, 1, tally);
  }
  expectRepresentative(tally);
}

/// Rules about bodies, links' names for bodies, and scaled bodies.
TEST(ProvenGraph, FollowsRules) {
  const auto robot = test::parseArm(test::armUrdf({}));
  World world = test::clutter(3, 5);
  world.add("fore", Sphere{0.1}, at(0.3, 0.3, 0.5));
  CheckerOptions options;
  options.rules.allow("hand", "body0").margin("fore", "body1", 0.1).pad("body2", 0.05);
  options.rules.scale("body3", 1.5).pad("upper", 0.02).check("*", "body4");
  Tally tally;
  changeAndCompare(robot, "all", options, world, 8, 0.6, 60, 15, 1, tally);
  expectRepresentative(tally);

  // Another rule about one body asks about that body; one about links asks about everything.
  auto checker = std::make_shared<const Checker>(robot, "all", test::shared(world), options);
  std::mt19937 random(4);
  ProvenGraph graph = randomGraph(checker, 60, random);
  CollisionRules rules = options.rules;
  rules.margin("hand", "body0", 0.2);
  const auto nearer = std::make_shared<const Checker>(checker->withRules(rules));
  ProvenGraph::Change change = graph.update(nearer);
  EXPECT_FALSE(change.everything);
  EXPECT_EQ(change.bodiesNew, 1U);
  EXPECT_EQ(change.bodiesGone, 1U);
  compareWithRecheck(graph, robot, tally);
  rules.pad("hand", 0.05);
  change = graph.update(std::make_shared<const Checker>(checker->withRules(rules)));
  EXPECT_TRUE(change.everything);
  compareWithRecheck(graph, robot, tally);
}

TEST(ProvenGraph, TellsWhatBlocksAMotion) {
  const auto robot = test::parseArm(test::armUrdf({}));
  World world;
  world.add("wall", makeBox({2.0, 0.05, 2.0}), at(0.0, 0.4, 0.8));
  world.add("post", makeBox({0.05, 0.05, 2.0}), at(0.0, 0.5, 0.8));
  const auto checker = std::make_shared<const Checker>(robot, "all", test::shared(world));
  ProvenGraph graph(checker);
  const std::uint32_t from = graph.addState({0.0, 1.2}), to = graph.addState({3.0, 1.2});
  const std::vector<ProvenGraph::Motion> motions{{from, to}};
  ASSERT_EQ(graph.addMotions(motions), 1U);
  std::vector<std::string> names = graph.blockedBy(0);
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"post", "wall"}));
  EXPECT_EQ(graph.verdict(0), Verdict::Collision);
  const ProvenGraph before = graph;
  ProvenGraph::Change change =
      graph.update(std::make_shared<const Checker>(checker->withoutBody("wall")));
  EXPECT_EQ(change.asked, 0U);
  EXPECT_EQ(graph.blockedBy(0), std::vector<std::string>{"post"});
  change = graph.update(std::make_shared<const Checker>(graph.checker()->withoutBody("post")));
  EXPECT_EQ(change.freed, 1U);
  EXPECT_TRUE(graph.isFree(0));
  EXPECT_EQ(before.blockedBy(0).size(), 2U);
}

TEST(ProvenGraph, LeavesOutWhatNoWorldAllows) {
  const auto robot = test::parseArm(test::armUrdf({}));
  const auto checker = std::make_shared<const Checker>(robot, "all", std::make_shared<World>());
  ProvenGraph graph(checker);
  Workspace workspace(*checker);
  std::mt19937 random(9);
  std::vector<ProvenGraph::Motion> motions;
  std::size_t free = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<double> from = test::randomConfiguration(*checker, random);
    const std::vector<double> to = test::randomConfiguration(*checker, random);
    motions.push_back({graph.addState(from), graph.addState(to)});
    free += checker->certifyMotion(from, to, workspace).verdict == Verdict::Free ? 1 : 0;
  }
  EXPECT_EQ(graph.addMotions(motions), free);
  EXPECT_GT(free, 20U);
  EXPECT_LT(free, 180U);
  // Half a turn may go either way.
  const double half = 0.5 * std::numbers::pi;
  motions = {{graph.addState({-half, 0.0}), graph.addState({half, 0.0})},
             {graph.addState({-half, 0.0}), graph.addState({half - 1e-6, 0.0})}};
  EXPECT_EQ(graph.addMotions(motions), 1U);
}

TEST(ProvenGraph, WhoeverStopsItGetsWhatIsProvenByThen) {
  const auto robot = test::parseArm(test::armUrdf({}));
  World world;
  world.add("wall", makeBox({2.0, 0.05, 2.0}), at(0.0, 0.4, 0.8));
  const auto checker = std::make_shared<const Checker>(robot, "all", test::shared(world));
  std::mt19937 random(10);
  ProvenGraph whole(checker);
  std::vector<ProvenGraph::Motion> motions;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<double> q = test::randomConfiguration(*checker, random);
    const std::uint32_t from = whole.addState(q);
    motions.push_back({from, whole.addState(nearTo(*checker, q, 0.4, random))});
  }
  const ProvenGraph none = whole;
  const std::size_t all = whole.addMotions(motions);

  std::stop_source stopped;
  stopped.request_stop();
  ProvenGraph graph = none;
  EXPECT_EQ(graph.addMotions(motions, 1, stopped.get_token()), 0U);
  Tally tally;
  int partly = 0;
  for (int i = 0; i < 200 && partly < 3; ++i) {
    graph = none;
    std::stop_source own;
    const std::jthread stopper([&own, i] {
      std::this_thread::sleep_for(std::chrono::microseconds(100 * i));
      own.request_stop();
    });
    const std::size_t added = graph.addMotions(motions, 1, own.get_token());
    EXPECT_EQ(added, graph.motions());
    EXPECT_LE(added, all);
    if (added == 0 || added == all) continue;
    ++partly;
    compareWithRecheck(graph, robot, tally);
  }
  EXPECT_EQ(partly, 3);
  EXPECT_GT(tally.compared, 10U);

  // An update changes nothing then, be it of the world or of everything.
  const auto walled = std::make_shared<const Checker>(
      checker->withBody("post", makeBox({0.3, 0.3, 3.0}), at(0.0, -0.5, 0.8)));
  CheckerOptions wide = checker->options();
  wide.margin = 0.03;
  const auto everything = std::make_shared<const Checker>(robot, "all", test::shared(world), wide);
  for (const auto& changed : {walled, everything}) {
    graph = whole;
    EXPECT_TRUE(graph.update(changed, 1, stopped.get_token()).stopped);
    EXPECT_EQ(graph.checker(), checker);
    ASSERT_EQ(graph.motions(), whole.motions());
    for (std::size_t i = 0; i < graph.motions(); ++i)
      EXPECT_EQ(graph.blockedBy(i), whole.blockedBy(i));
    EXPECT_FALSE(graph.update(changed).stopped);
    EXPECT_EQ(graph.checker(), changed);
  }
}

TEST(ProvenGraph, RefusesWhatItCannotHold) {
  const auto robot = test::parseArm(test::armUrdf({}));
  const auto checker = std::make_shared<const Checker>(robot, "all", std::make_shared<World>());
  EXPECT_EQ(messageOf([] { ProvenGraph graph(nullptr); }),
            "ProvenGraph: the checker must not be null");
  MovingObstacle cart{
      .name = "cart", .parts = {{Sphere{0.1}, at(0, 0, 0)}}, .waypoints = {{0.0, at(1, 0, 0)}}};
  const auto timed = std::make_shared<const Checker>(checker->withObstacle(cart));
  const std::string message =
      "ProvenGraph: the world has the moving obstacle 'cart', beside which a motion depends on the "
      "time";
  EXPECT_EQ(messageOf([&] { ProvenGraph graph(timed); }), message);
  ProvenGraph graph(checker);
  EXPECT_EQ(messageOf([&] { graph.update(timed); }), message);
  EXPECT_EQ(messageOf([&] { graph.addState({0.0}); }),
            "ProvenGraph: a state has 1 values; a configuration of group 'all' has 2");
  EXPECT_EQ(messageOf([&] {
              graph.addState({0.0, std::nan("")});
            }),
            "ProvenGraph: value 1 of a state is nan, which must be finite");
  const std::vector<ProvenGraph::Motion> motions{{0, 7}};
  EXPECT_EQ(messageOf([&] { graph.addMotions(motions); }),
            "ProvenGraph: a motion from state 0 to 7; there are 0 states");
  const auto other = std::make_shared<const Checker>(test::parseArm(test::armUrdf({})), "all",
                                                     std::make_shared<World>());
  EXPECT_EQ(messageOf([&] { graph.update(other); }),
            "ProvenGraph: the checker is of group 'all' of robot 'arm'; the motions are of group "
            "'all' of the robot 'arm' that was loaded before");
  EXPECT_EQ(graph.checker(), checker);
}

}  // namespace
}  // namespace swept
