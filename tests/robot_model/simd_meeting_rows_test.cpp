// SPDX-License-Identifier: BSD-3-Clause
// Balls inside links, and points of them, by which states are found in contact.
#include "simd/compile/meeting_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "version_arms.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

std::vector<MeetingBall> randomBalls(std::mt19937& random, int count) {
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  std::vector<MeetingBall> balls;
  for (int i = 0; i < count; ++i)
    balls.push_back({{unit(random), unit(random), 3.0F * unit(random)}, unit(random) + 1.0F});
  return balls;
}

MeetingBall ballOf(const SimdModel::Probes& row, int lane) {
  return {{row.x.lane[lane], row.y.lane[lane], row.z.lane[lane]}, row.inside.lane[lane]};
}

bool same(const MeetingBall& a, const MeetingBall& b) {
  return a.center == b.center && a.inside == b.inside;
}

TEST(MeetingRows, HoldEachBallInTheBallAroundItsRow) {
  std::mt19937 random(1);
  for (const int count : {0, 1, 7, 8, 9, 23, 63, 64, 65, 200}) {
    const std::vector<MeetingBall> balls = randomBalls(random, count);
    const int kept = std::min(count, kMostMeetingBalls);
    std::vector<SimdModel::Probes> rows(3);
    const SimdModel::InnerBalls added = addMeetingRows(balls, rows);
    EXPECT_EQ(added.first, 3);
    ASSERT_EQ(added.count, (kept + kLanes - 1) / kLanes);
    ASSERT_EQ(static_cast<int>(rows.size()), added.count == 0 ? 3 : 4 + added.count);
    std::vector<int> seen(balls.size());
    for (int i = 0; i < added.count; ++i) {
      const MeetingBall around = ballOf(rows[3], i);
      for (int lane = 0; lane < kLanes; ++lane) {
        const MeetingBall ball = ballOf(rows[4 + i], lane);
        EXPECT_LE((ball.center - around.center).norm() + ball.inside, around.inside + 1e-5F);
        const auto found = std::ranges::find_if(
            balls, [&](const MeetingBall& given) { return same(given, ball); });
        ASSERT_NE(found, balls.end());
        ++seen[found - balls.begin()];
      }
    }
    for (int i = 0; i < count; ++i) EXPECT_EQ(seen[i] > 0, i < kept) << i << " of " << count;
  }
}

TEST(MeetingRows, PointsAreSpreadOverTheSurface) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vector3d> points;
  for (int i = 0; i < 500; ++i) points.push_back({unit(random), unit(random), 0.1 * unit(random)});
  const std::vector<Vector3d> chosen = spreadPoints(points, 40);
  ASSERT_EQ(chosen.size(), 40U);
  const auto toChosen = [&](const Vector3d& p, std::size_t without) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (i != without) least = std::min(least, (p - chosen[i]).norm());
    return least;
  };
  double apart = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    EXPECT_NE(std::ranges::find(points, chosen[i]), points.end());
    apart = std::min(apart, toChosen(chosen[i], i));
  }
  for (const Vector3d& point : points) EXPECT_LE(toChosen(point, chosen.size()), apart);
  EXPECT_EQ(spreadPoints({points.data(), 1}, 40).size(), 1U);
  EXPECT_TRUE(spreadPoints({}, 40).empty());
}

/// A bowl without a lid: nothing is inside it, and only points of it tell of contacts.
Shape bowl(double radius) {
  std::vector<Vector3d> vertices{{0, 0, -radius}};
  std::vector<TriangleMesh::Triangle> triangles;
  constexpr int kAround = 16, kRings = 4;
  for (int ring = 1; ring <= kRings; ++ring) {
    const double tilt = 0.5 * std::numbers::pi * ring / kRings;
    for (int i = 0; i < kAround; ++i) {
      const double turn = 2.0 * std::numbers::pi * i / kAround;
      vertices.push_back(radius * Vector3d(std::sin(tilt) * std::cos(turn),
                                           std::sin(tilt) * std::sin(turn), -std::cos(tilt)));
      const int here = 1 + (ring - 1) * kAround + i;
      const int next = 1 + (ring - 1) * kAround + (i + 1) % kAround;
      if (ring == 1) {
        triangles.emplace_back(0, here, next);
      } else {
        triangles.emplace_back(here - kAround, here, next);
        triangles.emplace_back(here - kAround, next, next - kAround);
      }
    }
  }
  return TriangleMesh::build(vertices, triangles);
}

/// The report looks at exact geometry alone.
TEST(MeetingRows, StatesOfOpenMeshesAreWhatTheReportSays) {
  CheckerOptions options;
  AttachedBody held{.name = "bowl", .link = "fore", .parts = {}};
  held.parts.push_back({bowl(0.1), test::at(0, 0.1, 0.25)});
  options.attached.push_back(held);
  const Checker checker(test::parseArm(test::armUrdf({})), "all", std::make_shared<const World>(),
                        options);
  Workspace workspace(checker);
  std::mt19937 random(3);
  test::Agreement agreement;
  int byTheBowl = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<double> q = test::randomConfiguration(checker, random);
    const StateReport report = checker.reportState(q, workspace);
    test::compare(checker.checkState(q, workspace), report.verdict, agreement);
    byTheBowl += !report.contacts.empty() &&
                 std::ranges::all_of(report.contacts, [](const Witness& contact) {
                   return contact.bodyA == "bowl" || contact.bodyB == "bowl";
                 });
  }
  agreement.expectRepresentative(100);
  EXPECT_GT(byTheBowl, 50);
}

}  // namespace
}  // namespace swept::detail
