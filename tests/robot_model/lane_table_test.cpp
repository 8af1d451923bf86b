// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "lane_robots.hpp"
#include "lanes/joint_table.hpp"
#include "swept/core/distance.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::lane_test {
namespace {

using detail::CheckerModel;
using detail::JointTable;
using detail::LaneBodyPair;
using Values = std::array<float, JointTable::kMostJoints>;

std::string triple(Random& random, double size) {
  const Eigen::Vector3d v = random.vector(size);
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}

/// A forearm, a wrist of two joints that turn about any axes, and a hand with a finger.
std::string randomWrist(Random& random) {
  return R"(<robot name="wrist">
  <link name="fore"><collision><origin xyz="0 0 -0.12"/>
    <geometry><box size="0.08 0.06 0.2"/></geometry></collision></link>
  <link name="bend"><collision><origin xyz="0 0.05 0.03"/>
    <geometry><cylinder radius="0.02" length="0.12"/></geometry></collision></link>
  <link name="hand"><collision><origin xyz="0.07 0 0" rpy="0.1 0.2 0.3"/>
    <geometry><box size="0.14 0.05 0.04"/></geometry></collision>
    <collision><origin xyz="0.16 0.03 0"/><geometry><sphere radius="0.03"/></geometry></collision></link>
  <link name="finger"><collision><origin xyz="0.05 0 0"/>
    <geometry><box size="0.08 0.01 0.01"/></geometry></collision></link>
  <joint name="swing" type="revolute"><parent link="fore"/><child link="bend"/>
    <origin xyz="0 0 0.02" rpy=")" +
         triple(random, 0.5) + R"("/><axis xyz=")" + triple(random, 1.0) + R"("/>
    <limit lower="-2.2" upper="2.6" effort="1" velocity="1"/></joint>
  <joint name="twist" type="continuous"><parent link="bend"/><child link="hand"/>
    <origin xyz=")" +
         triple(random, 0.06) + R"("/><axis xyz=")" + triple(random, 1.0) + R"("/></joint>
  <joint name="pinch" type="revolute"><parent link="hand"/><child link="finger"/>
    <origin xyz="0.12 -0.02 0.01"/><axis xyz=")" +
         triple(random, 1.0) + R"("/>
    <limit lower="-4" upper="6" effort="1" velocity="1"/></joint>
</robot>)";
}

struct Named {
  std::string name;
  std::shared_ptr<const CheckerModel> model;
};

std::vector<Named> robotsWithTables() {
  const auto compile = [](std::shared_ptr<const Robot> robot, const char* group) {
    const Group& known = *robot->findGroup(group);
    return detail::compileChecker(robot, known, std::make_shared<World>(), {});
  };
  const std::string folder = std::string(SWEPT_MODELS_DIR) + "/robots/";
  const auto load = [&](const std::string& name) {
    return Robot::load(folder + name + "/" + name + ".urdf", folder + name + "/" + name + ".srdf");
  };
  Random random(40);
  const auto wrist = [&] {
    return compile(Robot::parse(randomWrist(random), "wrist.urdf"), "all");
  };
  return {{"wrist", wrist()},
          {"second_wrist", wrist()},
          {"third_wrist", wrist()},
          {"rook6", compile(load("rook6"), "arm_with_tool")},
          {"rook7", compile(load("rook7"), "arm_with_gripper")},
          {"rook6_cart", compile(load("rook6_cart"), "whole_body")}};
}

/// Poses of both bodies at these values of the table's joints, all others at rest.
class Poses {
 public:
  Poses(const CheckerModel& model, const JointTable& table) : model_(model), table_(table) {}

  Eigen::Isometry3d between(int bodyA, int bodyB, const std::array<double, 2>& values) const {
    const Pose pose = world(bodyA, values).inverse() * world(bodyB, values);
    Eigen::Isometry3d result(pose.matrix().cast<double>());
    return result;
  }

 private:
  Pose world(int body, const std::array<double, 2>& values) const {
    Pose pose = Pose::Identity();
    for (int b = body; b > 0; b = model_.kinematics.bodies[b].parent) {
      const detail::MovingBody& moving = model_.kinematics.bodies[b];
      Pose joint(moving.parent_from_joint.cast<Real>());
      for (int k = 0; k < table_.joints; ++k)
        if (table_.axes[k].body == b)
          joint.rotate(Eigen::AngleAxis<Real>(values[k], moving.axis.cast<Real>()));
      pose = joint * pose;
    }
    return pose;
  }

  const CheckerModel& model_;
  const JointTable& table_;
};

/// Whether every checked pair of geometry of the two bodies is apart in exact geometry.
bool apart(const CheckerModel& model, const LaneBodyPair& bodies,
           const std::array<double, 2>& values) {
  const Eigen::Isometry3d a_from_b =
      Poses(model, *bodies.table).between(bodies.bodyA, bodies.bodyB, values);
  for (const detail::GeometryPair& pair : model.pairs) {
    if (!pair.self) continue;
    const detail::RobotGeometry& a = model.robotGeometry[pair.a];
    const detail::RobotGeometry& b = model.robotGeometry[pair.b];
    if (a.body != bodies.bodyA || b.body != bodies.bodyB) continue;
    const Eigen::Isometry3d between = a.body_from_shape.inverse() * a_from_b * b.body_from_shape;
    if (collide(a.shape, b.shape, between) != Contact::Separate) return false;
  }
  return true;
}

/// A box of joint values within the table's range, from a point to a fifth of it.
void randomBox(Random& random, const JointTable& table, Values& lower, Values& upper) {
  for (int k = 0; k < table.joints; ++k) {
    const JointTable::Axis& axis = table.axes[k];
    const auto range = static_cast<double>(axis.upper - axis.lower);
    const double width = random.chance(0.3) ? 0.0 : range * random.scale(1e-4, 0.2);
    const double begin = static_cast<double>(axis.lower) + random.uniform(0.0, range - width);
    lower[k] = std::max(axis.lower, static_cast<float>(begin));
    upper[k] = std::min(axis.upper, static_cast<float>(begin + width));
  }
}

/// Wider and wider about its middle for as long as the table says that it is free: what it ends
/// with borders on what is not.
void growWhileFree(const JointTable& table, Values& lower, Values& upper) {
  for (int step = 0; step < 400; ++step) {
    Values low = lower;
    Values high = upper;
    for (int k = 0; k < table.joints; ++k) {
      const JointTable::Axis& axis = table.axes[k];
      const float cell = 0.25F / axis.cellsPerUnit;
      low[k] = std::max(axis.lower, low[k] - cell);
      high[k] = std::min(axis.upper, high[k] + cell);
    }
    if (!table.free(low, high)) return;
    lower = low;
    upper = high;
  }
}

struct Share {
  int asked = 0;
  int free = 0;
};

void tryToRefute(Random& random, const CheckerModel& model, const LaneBodyPair& bodies,
                 Share& share) {
  const JointTable& table = *bodies.table;
  for (int box = 0; box < 400; ++box) {
    Values lower{};
    Values upper{};
    randomBox(random, table, lower, upper);
    ++share.asked;
    if (!table.free(lower, upper)) continue;
    ++share.free;
    growWhileFree(table, lower, upper);
    for (int sample = 0; sample < 6; ++sample) {
      std::array<double, 2> values{};
      for (int k = 0; k < table.joints; ++k) {
        // Corners and edges too.
        const int where = random.below(4);
        const auto low = static_cast<double>(lower[k]);
        const auto high = static_cast<double>(upper[k]);
        values[k] = where == 0 ? low : where == 1 ? high : random.uniform(low, high);
      }
      ASSERT_TRUE(apart(model, bodies, values)) << "bodies " << bodies.bodyA << ", " << bodies.bodyB
                                                << " at " << values[0] << ", " << values[1];
    }
  }
}

TEST(LaneTable, NothingMeetsInCellsThatAreFree) {
  Random random(41);
  int single = 0;
  int twofold = 0;
  for (const Named& robot : robotsWithTables()) {
    SCOPED_TRACE(robot.name);
    Share share;
    for (const LaneBodyPair& bodies : robot.model->lanes.bodyPairs) {
      if (bodies.table == nullptr) continue;
      ++(bodies.table->joints == 1 ? single : twofold);
      tryToRefute(random, *robot.model, bodies, share);
      if (HasFatalFailure()) return;
    }
    const double free = static_cast<double>(share.free) / share.asked;
    RecordProperty("free_" + robot.name, std::to_string(free));
    EXPECT_GT(free, 0.2);
    EXPECT_GT(share.asked, 100);
  }
  EXPECT_GT(twofold, 4);
  // Neighbours along an arm are not checked, so few tables are of one joint.
  EXPECT_GE(single, 1);
}

/// Where bodies do meet, the table says so.
TEST(LaneTable, NoContactIsInAFreeCell) {
  Random random(42);
  int contacts = 0;
  for (const Named& robot : robotsWithTables()) {
    SCOPED_TRACE(robot.name);
    for (const LaneBodyPair& bodies : robot.model->lanes.bodyPairs) {
      if (bodies.table == nullptr) continue;
      const JointTable& table = *bodies.table;
      for (int i = 0; i < 400; ++i) {
        Values at{};
        std::array<double, 2> values{};
        for (int k = 0; k < table.joints; ++k) {
          const JointTable::Axis& axis = table.axes[k];
          values[k] =
              random.uniform(static_cast<double>(axis.lower), static_cast<double>(axis.upper));
          at[k] = static_cast<float>(values[k]);
        }
        if (apart(*robot.model, bodies, values)) continue;
        ++contacts;
        EXPECT_FALSE(table.free(at, at));
      }
    }
  }
  EXPECT_GT(contacts, 200);
}

TEST(LaneTable, NothingIsKnownOutsideTheLimitsOrOfWhatIsNoNumber) {
  const float bad = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  Random random(43);
  int asked = 0;
  for (const Named& robot : robotsWithTables()) {
    for (const LaneBodyPair& bodies : robot.model->lanes.bodyPairs) {
      if (bodies.table == nullptr) continue;
      const JointTable& table = *bodies.table;
      for (int i = 0; i < 200; ++i) {
        Values lower{};
        Values upper{};
        randomBox(random, table, lower, upper);
        if (!table.free(lower, upper)) continue;
        ++asked;
        const int k = random.below(table.joints);
        const auto spoil = [&](float low, float high) {
          Values from = lower;
          Values to = upper;
          from[k] = low;
          to[k] = high;
          return table.free(from, to);
        };
        EXPECT_FALSE(spoil(bad, upper[k]));
        EXPECT_FALSE(spoil(lower[k], bad));
        EXPECT_FALSE(spoil(bad, bad));
        EXPECT_FALSE(spoil(std::nextafter(table.axes[k].lower, -infinity), upper[k]));
        EXPECT_FALSE(spoil(lower[k], std::nextafter(table.axes[k].upper, infinity)));
        EXPECT_FALSE(spoil(-infinity, infinity));
      }
    }
  }
  EXPECT_GT(asked, 500);
}

}  // namespace
}  // namespace swept::lane_test
