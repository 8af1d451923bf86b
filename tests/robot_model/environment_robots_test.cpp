// SPDX-License-Identifier: BSD-3-Clause
// Robots, worlds and checkers that are read, made and asked in any floating-point environment are
// the same, bit for bit; so are batches, whose threads begin in the environment of who starts them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "models_dir.hpp"
#include "swept/core/continuous/motion.hpp"
#include "swept/robot_model/allowed_collision_matrix.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/path_clearance.hpp"
#include "swept/robot_model/planning_request.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/self_filter.hpp"
#include "swept/robot_model/sensed_world.hpp"
#include "transcript.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::Transcript;

const std::filesystem::path kModels = modelsDir();
const auto kNoWarnings = LoadOptions{{}, {}, [](const std::string&) {}};

std::shared_ptr<const Robot> load(const std::string& name) {
  const auto folder = kModels / "robots" / name;
  return Robot::load(folder / (name + ".urdf"), folder / (name + ".srdf"), kNoWarnings);
}

void tell(Transcript& t, const Shape& shape) {
  const BoundingSphere ball = boundingSphere(shape);
  t.add(shape.index(), ball.center, ball.radius, boundingBox(shape).lower);
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) t.add(mesh->vertices());
  if (const auto* cloud = std::get_if<PointCloud>(&shape)) t.add(cloud->points());
}
void tell(Transcript& t, const Robot& robot) {
  for (const Link& link : robot.links()) {
    for (const CollisionGeometry& piece : link.collision) {
      t.add(piece.link_from_shape);
      tell(t, piece.shape);
      if (piece.cover == nullptr) continue;
      for (const SphereCover::Node& node : piece.cover->nodes)
        t.add(node.ball.center, node.ball.radius, node.overhang);
    }
  }
  for (const Joint& joint : robot.joints()) t.add(joint.parent_from_joint, joint.axis);
  for (const Variable& variable : robot.variables()) t.add(variable.lower, variable.upper);
  t.add(robot.defaultState());
}
void tell(Transcript& t, const World& world) {
  for (const WorldBody& body : world.bodies()) {
    for (const WorldBody::Part& part : body.parts) {
      t.add(body.name, part.world_from_shape);
      tell(t, part.shape);
    }
  }
}
void tell(Transcript& t, const Witness& w) {
  t.add(w.t, w.bodyA, w.bodyB, w.pointA, w.pointB, w.distance);
}
void tell(Transcript& t, const MotionCertificate& c) {
  t.add(c.verdict, c.freeUntil, c.undecidedAt, c.effort.intervals, c.effort.lanes,
        c.effort.distances);
  if (c.witness) tell(t, *c.witness);
}

std::vector<std::vector<double>> configurations(const Checker& checker, unsigned seed,
                                                std::size_t count, double reach = 2.0) {
  std::mt19937 random(seed);
  std::vector<std::vector<double>> all(count);
  for (std::vector<double>& q : all) {
    for (const int variable : checker.group().variables) {
      const Variable& v = checker.robot().variables()[static_cast<std::size_t>(variable)];
      q.push_back(std::uniform_real_distribution<double>(std::max(v.lower, -reach),
                                                         std::min(v.upper, reach))(random));
    }
    q.resize(static_cast<std::size_t>(checker.dimension()), 0.3);
  }
  return all;
}

void askStates(const Checker& checker, const std::vector<std::vector<double>>& states,
               Transcript& t) {
  Workspace workspace(checker);
  std::vector<double> flat, gradient(states.front().size());
  for (const std::vector<double>& q : states) {
    flat.insert(flat.end(), q.begin(), q.end());
    const StateReport report = checker.reportState(q, workspace);
    const SignedClearance depth = checker.signedClearance(q, workspace, gradient);
    t.add(checker.checkState(q, workspace), report.verdict, report.clearance, report.nearestA,
          checker.clearance(q, workspace), checker.withinLimits(q), depth.lower, depth.upper,
          depth.pointA, depth.normal, gradient);
    for (const Witness& witness : report.contacts) tell(t, witness);
  }
  std::vector<Verdict> verdicts(states.size());
  checker.checkStates(flat, verdicts, workspace);
  t.add(verdicts);
  for (const unsigned threads : {1U, 3U}) {
    checker.checkStates(flat, verdicts, threads);
    t.add(verdicts);
  }
}

void askMotions(const Checker& checker, const std::vector<std::vector<double>>& states,
                Transcript& t) {
  Workspace workspace(checker);
  std::vector<double> from, to;
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    from.insert(from.end(), states[i].begin(), states[i].end());
    to.insert(to.end(), states[i + 1].begin(), states[i + 1].end());
    tell(t, checker.certifyMotion(states[i], states[i + 1], workspace));
    tell(t, checker.certifyMotion(states[i], states[i + 1], workspace, MotionQuery::VerdictOnly));
    t.add(checker.interpolate(states[i], states[i + 1], 1.0 / 3.0));
    if (i > 1) continue;
    const MotionClearance clearance =
        checker.motionClearance(states[i], states[i + 1], 1e-2, workspace);
    t.add(clearance.lower, clearance.upper, clearance.t, clearance.intervals, clearance.world.lower,
          clearance.self.upper);
  }
  for (const unsigned threads : {1U, 3U}) {
    std::vector<MotionCertificate> certificates(states.size() - 1);
    for (const MotionQuery query : {MotionQuery::FirstContact, MotionQuery::VerdictOnly}) {
      checker.certifyMotions(from, to, certificates, query, threads);
      for (const MotionCertificate& certificate : certificates) tell(t, certificate);
    }
  }
}

void askPath(const Checker& checker, const std::vector<std::vector<double>>& states,
             Transcript& t) {
  Workspace workspace(checker);
  const PathClearance least = pathClearance(checker, states, 1e-2, workspace);
  t.add(least.lower, least.upper, least.t, least.segment.value_or(0), least.intervals, least.bodyA,
        least.bodyB);
  for (const unsigned threads : {1U, 3U}) {
    const PathCertificate path = certifyPath(checker, states, {.threads = threads});
    t.add(path.verdict());
    for (const CertifiedSegment& segment : path.segments) {
      tell(t, segment.certificate);
      if (segment.clearance) t.add(segment.clearance->world.lower, segment.clearance->self.upper);
    }
  }
}

/// The shelf, a mote that is denormal, and what a body that floats may meet.
std::shared_ptr<const World> shelf() {
  World world = World::load(kModels / "scenes" / "shelf.yaml", kNoWarnings);
  world.add("mote", makeSphere(1e-310), Isometry3d(Eigen::Translation3d(0.3, 1e-310, 0.6)));
  world.add("globe", makeSphere(0.4), Isometry3d(Eigen::Translation3d(-0.4, 0.3, 0.2)));
  return std::make_shared<const World>(std::move(world));
}

TEST(EnvironmentOfRobots, IsTheDefaultForFiles) {
  const Isometry3d pose(Eigen::AngleAxisd(0.3, Vector3d::UnitZ()));
  test::expectSameInEveryEnvironment(
      {{"robot", [](Transcript& t) { tell(t, *load("rook7")); }},
       {"scene",
        [](Transcript& t) {
          tell(t, World::load(kModels / "scenes" / "table_objects.yaml", kNoWarnings));
          tell(t, World::load(kModels / "scenes" / "table_objects.scene", kNoWarnings));
          tell(t, World::load(kModels / "robots" / "rook6" / "rook6.urdf", kNoWarnings));
        }},
       {"problems",
        [](Transcript& t) {
          const ProblemFile file = ProblemFile::load(kModels / "problems.json");
          for (const std::string& set : file.sets()) {
            const PlanningProblem problem = file.problem(set, file.indices(set).front());
            tell(t, problem.world);
            t.add(problem.start, problem.goals);
          }
        }},
       {"points",
        [](Transcript& t) { t.add(loadPoints(kModels / "clouds" / "shelf.pcd", kNoWarnings)); }},
       {"map", [=](Transcript& t) {
          const OccupancyMap map = loadOctomap(kModels / "clouds" / "shelf.bt", kNoWarnings);
          t.add(map.resolution);
          for (const OccupancyMap::Cube& cube : map.occupied) t.add(cube.center, cube.side);
          const WorldBody body = occupiedBody("map", map, pose);
          for (const WorldBody::Part& part : body.parts) t.add(part.world_from_shape);
        }}});
}

TEST(EnvironmentOfRobots, IsTheDefaultForNumbersInText) {
  const std::string urdf =
      "<robot name='r'><link name='a'/><link name='b'><collision><origin xyz='0.1 1e-310 "
      "0.12345678901234567' rpy='0.3 0.1 0.7'/><geometry><cylinder radius='0.30000000000000004' "
      "length='0.7'/></geometry></collision></link><joint name='j' type='revolute'><origin "
      "xyz='0.1 0.2 0.3' rpy='0.1 0.2 0.3'/><parent link='a'/><child link='b'/><axis xyz='1 2 3'/>"
      "<limit lower='-0.1' upper='2.2250738585072011e-308' effort='1' velocity='1'/></joint>"
      "</robot>";
  test::expectSameInEveryEnvironment(
      {{"urdf", [=](Transcript& t) { tell(t, *Robot::parse(urdf, "r.urdf")); }}});
  test::expectSameRefusals({{"no robot", [](Transcript&) { Robot::load("none.urdf"); }},
                            {"no scene", [](Transcript&) { World::load("none.yaml"); }},
                            {"no number", [=](Transcript&) {
                               std::string text = urdf;
                               text.replace(text.find("0.7'/>"), 3, "0,7");
                               Robot::parse(text, "r.urdf");
                             }}});
}

struct Moved {
  std::string robot, group;
  double reach;  ///< rad, m
};
class EnvironmentOfCheckers : public testing::TestWithParam<Moved> {};

TEST_P(EnvironmentOfCheckers, IsTheDefault) {
  const auto& [name, group, reach] = GetParam();
  const std::shared_ptr<const Robot> robot = load(name);
  const std::shared_ptr<const World> world = shelf();
  CheckerOptions options;
  options.rules.pad("*", 1e-3 / 3.0);
  const Checker there(robot, group, world, options);
  const auto states = configurations(there, 3, 30, reach);
  Workspace workspace(there);
  std::map<Verdict, int> seen;
  for (const auto& q : states) ++seen[there.checkState(q, workspace)];
  EXPECT_GT(seen[Verdict::Free], 2);
  EXPECT_GT(seen[Verdict::Collision], 2);
  test::expectSameInEveryEnvironment(
      {{"states", [&](Transcript& t) { askStates(there, states, t); }},
       {"motions", [&](Transcript& t) { askMotions(there, states, t); }},
       {"path",
        [&](Transcript& t) {
          askPath(there, {states.begin(), states.begin() + 4}, t);
        }},
       {"made", [&, group = group](Transcript& t) {
          const Checker checker(robot, group, world, options);
          askStates(checker, {states.begin(), states.begin() + 4}, t);
          askMotions(checker, {states.begin(), states.begin() + 4}, t);
        }}});
}

INSTANTIATE_TEST_SUITE_P(EnvironmentOfRobots, EnvironmentOfCheckers,
                         testing::Values(Moved{"rook7", "arm_with_gripper", 2.0},
                                         Moved{"rook6_cart", "whole_body", 1.5},
                                         Moved{"drifter", "body", 0.8}),
                         [](const auto& tested) { return tested.param.robot; });

TEST(EnvironmentOfRobots, IsTheDefaultForVersions) {
  const Checker first(load("rook7"), "arm", shelf());
  const auto states = configurations(first, 5, 5);
  const Isometry3d pose(Eigen::AngleAxisd(0.3, Vector3d(1, 2, 3).normalized()));
  const std::vector<Vector3d> points = loadPoints(kModels / "clouds" / "shelf.pcd", kNoWarnings);
  const MovingObstacle obstacle{
      "moving", {{makeSphere(0.1), pose}}, {{0.0, pose}, {1.0 / 3.0, pose * pose}, {0.7, pose}}};
  std::vector<std::vector<double>> timed = states;
  for (std::size_t i = 0; i < timed.size(); ++i) timed[i].push_back(0.2 * static_cast<double>(i));
  const auto ask = [states](const Checker& checker, Transcript& t) {
    askStates(checker, states, t);
    askMotions(checker, {states.begin(), states.begin() + 3}, t);
  };
  test::expectSameInEveryEnvironment(
      {{"bodies",
        [&](Transcript& t) {
          const Checker cloud =
              first.withBody({"cloud", {{PointCloud::build(points, 0.01), pose}}});
          ask(cloud, t);
          ask(cloud.withReplaced({"cloud", {{makeBox({0.1, 0.2, 0.3}), pose}}}), t);
          ask(cloud.withoutBody("cloud").withWorld(shelf()), t);
        }},
       {"attached",
        [&](Transcript& t) {
          const Checker held =
              first.withAttached({"rod", "hand", {{makeCapsule(0.02, 0.1), pose}}, {"finger*"}});
          ask(held, t);
          const WorldBody placed = held.detachedBody("rod", states.front());
          t.add(placed.parts.front().world_from_shape, held.explain("rod", "mote"));
          ask(held.withoutAttached("rod"), t);
        }},
       {"rules",
        [&](Transcript& t) {
          CollisionRules rules;
          rules.pad("hand", 0.01).scale("link5", 1.1).margin("hand", "mote", 0.1);
          ask(first.withRules(rules), t);
        }},
       {"obstacle", [&](Transcript& t) {
          t.add(obstacle.poseAt(0.1), obstacle.poseAt(0.5));
          askMotions(first.withObstacle(obstacle), timed, t);
        }}});
  test::expectSameRefusals({{"taken",
                             [&](Transcript&) {
                               (void)first.withBody({"mote", {}});
                             }},
                            {"size", [&](Transcript&) {
                               Workspace workspace(first);
                               (void)first.checkState(std::vector<double>(3), workspace);
                             }}});
}

TEST(EnvironmentOfRobots, IsTheDefaultForKinematics) {
  const std::shared_ptr<const Robot> robot = load("rook7");
  const Checker checker(robot, "arm", shelf());
  const auto states = configurations(checker, 7, 8);
  const Isometry3d tool(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  const InverseKinematics there(robot, "arm", "hand", {}, tool);
  const Isometry3d wanted = there.pose(states[1]);
  test::expectSameInEveryEnvironment(
      {{"inverse",
        [&](Transcript& t) {
          const InverseKinematics made(robot, "arm", "hand", {}, tool);
          std::vector<double> lower(states[0].size(), -2.0), upper(states[0].size(), 2.0);
          for (const InverseKinematics& kinematics : {there, made, made.within(lower, upper)}) {
            InverseKinematics::Workspace workspace(kinematics);
            std::vector<double> q = states[0];
            t.add(kinematics.solve(wanted, q, {}, workspace), q, kinematics.jacobian(states[2]),
                  kinematics.pose(states[3]), kinematics.findPose(states[4])->matrix());
            const PoseError error = poseError(kinematics.pose(q), wanted);
            t.add(error.position, error.angle);
          }
        }},
       {"forward", [&](Transcript& t) {
          const LinkMotion motion(*robot, "arm", "hand", states[0], states[1]);
          const MotionState state = motion.state(1.0 / 3.0);
          t.add(state.pose, state.twist.linear, motion.at(0.1), motion.velocity(0.1).angular,
                motion.rates(0.0, 1.0).speed, motion.rounding(0.3),
                linkPose(*robot, "arm", "hand", states[2]));
          t.add(namedConfiguration(*robot, checker.group(), "home"));
          for (const auto& [variable, value] :
               makeNamedState(checker.group(), "here", states[0]).values)
            t.add(variable, value);
        }}});
}

TEST(EnvironmentOfRobots, IsTheDefaultForWhatASensorSees) {
  const std::shared_ptr<const Robot> robot = load("rook7");
  const Eigen::VectorXd state = robot->defaultState();
  const std::span<const double> values(state.data(), static_cast<std::size_t>(state.size()));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.4, 0.8);
  Balls balls;
  OccupancyMap map{0.05, {}};
  for (int i = 0; i < 300; ++i) {
    balls.centers.emplace_back(unit(random), unit(random), unit(random));
    balls.radii.push_back(0.05);
    map.occupied.push_back({balls.centers.back(), 0.2});
  }
  const Isometry3d pose(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  test::expectSameInEveryEnvironment(
      {{"filters", [&](Transcript& t) {
          t.add(withoutRobot(balls.centers, *robot, values, 0.01));
          t.add(ballsWithoutRobot(balls, *robot, values, 0.01).centers);
          for (const auto& cube : mapWithoutRobot(map, pose, *robot, values, 0.01).occupied)
            t.add(cube.center, cube.side);
        }}});
}

TEST(EnvironmentOfRobots, IsTheDefaultForPairsThatNeverMeet) {
  const std::shared_ptr<const Robot> robot = load("rook6");
  test::expectSameInEveryEnvironment({{"matrix", [&](Transcript& t) {
                                         AllowedCollisionMatrixOptions options;
                                         options.budget = 20'000;
                                         options.samples = 50;
                                         const auto pairs =
                                             computeAllowedCollisionMatrix(*robot, options);
                                         for (const LinkPairReport& pair : pairs) {
                                           t.add(pair.status, pair.proven, pair.nearest);
                                           if (pair.witness) t.add(*pair.witness);
                                         }
                                         t.add(srdfWithPairs(*robot, pairs));
                                       }}});
}

TEST(EnvironmentOfRobots, IsTheDefaultForRequests) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / "environment_request.yaml";
  std::ofstream(file) << "group_name: arm\n"
                         "start_state: {joint_state: {name: [joint1, joint2], position: [0.1, "
                         "-0.30000000000000004]}}\n"
                         "goal_constraints: [{joint_constraints: [{joint_name: joint1, position: "
                         "0.7}]}]\n";
  const std::shared_ptr<const Robot> robot = load("rook7");
  test::expectSameInEveryEnvironment({{"request", [&](Transcript& t) {
                                         const auto request =
                                             PlanningRequest::load(file, kNoWarnings);
                                         for (const auto& [joint, value] : request.startOf(*robot))
                                           t.add(joint, value);
                                         for (const auto& [joint, value] : request.goals.front())
                                           t.add(joint, value);
                                       }}});
}

}  // namespace
}  // namespace swept
