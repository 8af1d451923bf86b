// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "depth_sensor.hpp"
#include "recorded_task.hpp"
#include "swept/core/triangle_mesh.hpp"
#include "swept/robot_model/self_filter.hpp"
#include "swept/robot_model/sensed_world.hpp"

/// A thing that is moved from one side of a table to the other.
struct Thing {
  std::string name;
  int sides;                 ///< of the prism that it is
  double radius;             ///< m
  double height;             ///< m
  Eigen::Vector2d from, to;  ///< m, on the table
};

/// A robot's hand, as far as a grasp from above needs it.
struct Hand {
  std::string arm, gripper;                ///< groups; the gripper has one variable
  std::string palm;                        ///< link that carries what the hand holds
  swept::ConstraintFrame tool;             ///< between the fingers, z away from the palm
  std::vector<std::string> fingers;        ///< links that touch what they hold
  double open;                             ///< value of the gripper's variable
  std::function<double(double)> closedOn;  ///< the same, by the radius of what it holds (m)
};

/// A robot at the table, and another arm of it.
struct Worker {
  std::shared_ptr<const swept::Robot> robot;
  Hand hand;
  std::string otherArm;
  std::vector<double> start, other, otherLater;  ///< of the hand's arm, of the other one
  Eigen::Isometry3d model_from_table;            ///< the middle of an edge of its top, x across it
};

/// An upright prism with its foot at the origin, as a mesh.
inline swept::Shape prism(int sides, double radius, double height) {
  std::vector<Eigen::Vector3d> vertices{{0, 0, 0}, {0, 0, height}};
  std::vector<swept::TriangleMesh::Triangle> triangles;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    for (const double z : {0.0, height})
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    const int low = 2 + 2 * i, next = 2 + 2 * ((i + 1) % sides);
    triangles.insert(
        triangles.end(),
        {{0, next, low}, {1, low + 1, next + 1}, {low, next, next + 1}, {low, next + 1, low + 1}});
  }
  return swept::TriangleMesh::build(vertices, triangles);
}

inline Eigen::Isometry3d standing(const Worker& worker, const Eigen::Vector2d& at) {
  return worker.model_from_table * Eigen::Translation3d(at.x(), at.y(), 0);
}

/// What is known: a table, and the things on it.
inline swept::World knownWorld(const Worker& worker, std::span<const Thing> things) {
  swept::World world;
  world.add("table", swept::makeBox({0.6, 1.0, 0.04}),
            worker.model_from_table * Eigen::Translation3d(0.3, 0, -0.02));
  for (const Thing& thing : things)
    world.add(thing.name, prism(thing.sides, thing.radius, thing.height),
              standing(worker, thing.from));
  return world;
}

/// Senses all that is not known: a post on the table and a crate, which no planner is told of.
/// Points on what is known, the robot included, belong to no map.
inline swept::WorldBody sensedMap(const RecordedTask& task, const Worker& worker,
                                  std::mt19937& random) {
  constexpr double kNear = 0.02, kVoxel = 0.02;  // m
  swept::World all = task.world();
  all.remove("map");
  const swept::World known = all;
  const auto on = [&](double x, double y, double z) {
    return worker.model_from_table * Eigen::Translation3d(x, y, z);
  };
  all.add("post", swept::makeCylinder(0.03, 0.3), Eigen::Isometry3d(on(0.2, 0, 0.15)));
  all.add("crate", swept::makeBox({0.2, 0.15, 0.2}), Eigen::Isometry3d(on(0.48, 0.1, 0.1)));
  DepthSensor sensor{.world_from_sensor = Eigen::Isometry3d(on(-0.1, -0.9, 1.1))};
  sensor.world_from_sensor.rotate(Eigen::Quaterniond::FromTwoVectors(
      Eigen::Vector3d::UnitZ(), Eigen::Vector3d(0.4, 0.9, -1.0)));
  std::vector<Eigen::Vector3d> points = sensor.points(all, random);
  std::erase_if(points, [&](const Eigen::Vector3d& point) {
    return DepthSensor::nearest(known, point, kNear) < kNear;
  });
  points = swept::withoutRobot(points, *task.robot(), task.state(), kNear);
  return swept::occupiedBody("map", voxels(points, kVoxel), Eigen::Isometry3d::Identity());
}

/// A configuration with the tool at a pose from which it can go straight to another one.
inline std::vector<double> reach(const RecordedTask& task, const Hand& hand,
                                 const Eigen::Isometry3d& above, const Eigen::Isometry3d& below,
                                 const swept::CollisionRules& rules, std::mt19937& random) {
  const auto checker = task.checker(hand.arm, rules, {}, RecordedTask::kRoom);
  swept::Workspace workspace(*checker);
  const swept::InverseKinematics kinematics(task.robot(), hand.arm, hand.tool.body, task.state(),
                                            hand.tool.body_from_frame);
  swept::InverseKinematics::Workspace scratch(kinematics);
  const swept::ToolLinePlanner lines(checker, hand.tool);
  std::vector<double> seed = task.values(hand.arm);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> q = seed;
    Eigen::Isometry3d turned = above;  // the things are round enough for any direction
    turned.rotate(
        Eigen::AngleAxisd(i == 0 ? 0.0 : std::uniform_real_distribution(-3.1, 3.1)(random),
                          Eigen::Vector3d::UnitZ()));
    Eigen::Isometry3d end = below;
    end.linear() = turned.linear();
    if (kinematics.solve(turned, q, {}, scratch) &&
        checker->checkState(q, workspace) == swept::Verdict::Free &&
        lines.plan(q, end, workspace).complete())
      return q;
    for (std::size_t k = 0; k < seed.size(); ++k) {
      const swept::Variable& own =
          task.robot()->variables()[std::size_t(checker->group().variables[k])];
      seed[k] = std::uniform_real_distribution(own.cyclic ? -M_PI : own.lower,
                                               own.cyclic ? M_PI : own.upper)(random);
    }
  }
  throw std::runtime_error("the hand does not get there");
}

/// Moves a thing: to it, down, grasp, up, over to its place, upright, down, release, up.
inline void move(RecordedTask& task, const Thing& thing, const Worker& worker,
                 std::mt19937& random) {
  const Hand& hand = worker.hand;
  const double grip = thing.height - 0.03;  // m, above its foot
  const auto tool = [&](const Eigen::Vector2d& at, double height) {
    Eigen::Isometry3d pose = standing(worker, at) * Eigen::Translation3d(0, 0, grip + height);
    pose.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
    return pose;
  };
  /// Straight along the vertical, as the tool is turned now.
  const auto vertical = [&](const std::string& name, const Eigen::Vector2d& at, double height,
                            const swept::CollisionRules& rules) {
    Eigen::Isometry3d goal = tool(at, height);
    goal.linear() = task.pose(hand.arm, hand.tool).linear();
    task.line(name + " " + thing.name, hand.arm, hand.tool, goal, rules);
  };
  swept::CollisionRules none, onTable, inHand;
  onTable.allow(thing.name, "table", "it stands on it");
  for (const std::string& finger : hand.fingers) inHand.allow(finger, thing.name, "held");
  const auto fingers = [&](const std::string& name, double value) {
    const auto checker = task.checker(hand.gripper, inHand);
    task.follow(name + " " + thing.name, checker, {task.values(hand.gripper), {value}});
  };

  task.plan("to " + thing.name, hand.arm,
            reach(task, hand, tool(thing.from, 0.1), tool(thing.from, 0), none, random));
  vertical("down to", thing.from, 0.0, none);
  fingers("grasp", hand.closedOn(thing.radius));
  task.attach(thing.name, hand.arm, hand.palm, hand.fingers);
  vertical("lift", thing.from, 0.1, onTable);
  task.plan("carry " + thing.name, hand.arm,
            reach(task, hand, tool(thing.to, 0.1), tool(thing.to, 0), onTable, random),
            swept::TaskConstraint::upright(hand.tool.body, 0.2,
                                           -hand.tool.body_from_frame.linear().col(2)));
  vertical("lower", thing.to, 0.0, onTable);
  task.place(thing.name, hand.arm);
  fingers("release", hand.open);
  vertical("up from", thing.to, 0.1, none);
  task.sense(sensedMap(task, worker, random));
}
