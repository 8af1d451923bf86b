// SPDX-License-Identifier: BSD-3-Clause
// Balls inside two bodies by which joint tables know of contacts.
#include <gtest/gtest.h>

#include "swept/core/distance.hpp"
#include "table_robots.hpp"

namespace swept::simd_test {
namespace {

using detail::RobotGeometry;
using detail::SimdBodyPair;
using InnerBall = PairSeparationTable::InnerBall;

bool isIn(const CheckerModel& model, int index, const Eigen::Vector3d& point) {
  const RobotGeometry& geometry = model.robotGeometry[index];
  const Eigen::Vector3d inShape =
      geometry.body_from_shape.inverse() * (model.simd.bodyFromLane[geometry.body] * point);
  return collide(Sphere{0.0}, geometry.shape, Eigen::Isometry3d(Eigen::Translation3d(-inShape))) !=
         Contact::Separate;
}

/// Points on its border and in it.
void tryToLeave(Random& random, const CheckerModel& model, int geometry, const InnerBall& ball) {
  ASSERT_GT(ball.inside, 0.0F);
  const Eigen::Vector3d center(ball.center[0], ball.center[1], ball.center[2]);
  for (int i = 0; i < 6; ++i) {
    // Poses are not known better by the lanes than by this.
    const double radius = static_cast<double>(ball.inside) - 1e-7;
    const double share = i == 0 ? random.uniform(0.0, 1.0) : 1.0;
    const Eigen::Vector3d point = center + share * radius * random.direction();
    ASSERT_TRUE(isIn(model, geometry, point))
        << "geometry " << geometry << ", ball of " << ball.inside;
  }
}

TEST(SimdMeeting, BallsAreInsideTheLinks) {
  Random random(45);
  int asked = 0;
  double small = 1.0;
  double large = 0.0;
  for (const Named& robot : robotsWithTables()) {
    SCOPED_TRACE(robot.name);
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      if (bodies.table == nullptr || bodies.table->meetings.empty()) continue;
      const PairSeparationTable& table = *bodies.table;
      for (int i = 0; i < 100; ++i) {
        const PairSeparationTable::Meeting& meeting =
            table.meetings[random.below(static_cast<int>(table.meetings.size()))];
        const PairSeparationTable::Geometries& pair = table.pairs[meeting.pair];
        tryToLeave(random, *robot.model, pair.a, meeting.a);
        tryToLeave(random, *robot.model, pair.b, meeting.b);
        if (HasFatalFailure()) return;
        ++asked;
        for (const InnerBall* ball : {&meeting.a, &meeting.b}) {
          small = std::min(small, static_cast<double>(ball->inside));
          large = std::max(large, static_cast<double>(ball->inside));
        }
      }
    }
  }
  EXPECT_GT(asked, 1000);
  // From contacts that are hardly any to the middle of links.
  EXPECT_LT(small, 1e-3);
  EXPECT_GT(large, 0.02);
}

/// What a table knows of a contact is so in most of the cell, and it knows of most.
TEST(SimdMeeting, CellsInContactHaveOne) {
  Random random(46);
  int touching = 0;
  int known = 0;
  int inContact = 0;
  for (const Named& robot : robotsWithTables()) {
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      if (bodies.table == nullptr) continue;
      const PairSeparationTable& table = *bodies.table;
      const Poses poses(*robot.model, table.axes, table.joints);
      for (int i = 0; i < 4000; ++i) {
        const int index = random.below(static_cast<int>(table.cells.size()));
        const PairSeparationTable::Cell& cell = table.cells[index];
        if (!cell.touching) continue;
        ++touching;
        if (cell.meeting < 0) continue;
        ++known;
        const int steps[] = {index / table.axes[1].cells, index % table.axes[1].cells};
        std::array<double, 2> values{};
        for (int k = 0; k < table.joints; ++k)
          values[k] = static_cast<double>(table.axes[k].lower) +
                      (steps[k] + random.uniform(0.0, 1.0)) * PairSeparationTable::kParts /
                          static_cast<double>(table.axes[k].partsPerUnit);
        const PairSeparationTable::Meeting& meeting = table.meetings[cell.meeting];
        const RobotGeometry& a = robot.model->robotGeometry[table.pairs[meeting.pair].a];
        const RobotGeometry& b = robot.model->robotGeometry[table.pairs[meeting.pair].b];
        const Eigen::Isometry3d between = poses.between(bodies.bodyA, bodies.bodyB, values);
        inContact +=
            collide(a.shape, b.shape, a.body_from_shape.inverse() * between * b.body_from_shape) !=
            Contact::Separate;
      }
    }
  }
  EXPECT_GT(touching, 2000);
  EXPECT_GT(known, 0.8 * touching);
  EXPECT_GT(inContact, 0.95 * known);
}

}  // namespace
}  // namespace swept::simd_test
