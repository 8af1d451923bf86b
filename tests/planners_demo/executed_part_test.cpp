// SPDX-License-Identifier: BSD-3-Clause
// What the report counts of executed curves, for paths whose distances are known by hand.
#include "report/executed_part.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "robot_model/sliding_cube.hpp"

namespace swept {
namespace {

constexpr double kGap = 0.008;  // m

/// A cube of 0.2 m that slides along x and z, and blocks of 0.2 m.
class CubeAmongBlocks {
 public:
  explicit CubeAmongBlocks(const std::vector<Eigen::Vector2d>& blocks) {
    auto world = std::make_shared<World>();
    for (const Eigen::Vector2d& at : blocks) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() = Eigen::Vector3d(at.x(), 0.0, at.y());
      world->add(WorldBody{.name = "block " + std::to_string(world->bodies().size()),
                           .parts = {{makeBox({0.2, 0.2, 0.2}), pose}}});
    }
    const Checker truth(robot_, "all", world, {.tolerance = 1e-6});
    checkers_.truth = std::make_shared<const Checker>(truth);
    for (const double tube : kTubes)
      checkers_.tubes.push_back(std::make_shared<const Checker>(
          truth.withTracking({{.rotation = 0.0, .translation = tube}})));
  }

  ExecutedPaths ask(const std::vector<Eigen::MatrixXd>& paths) {
    ExecutedPart part(*robot_, robot_->groups()[0], 2);
    EXPECT_TRUE(part.applies());
    part.add(checkers_, paths, Stopwatch(), [](std::size_t) {});
    return part.found();
  }

 private:
  std::shared_ptr<const Robot> robot_ = test::slidingCube();
  ReportCheckers checkers_;
};

/// Right, then up, a metre each.
Eigen::MatrixXd rightAngle() {
  Eigen::MatrixXd path(2, 3);
  path << 0, 1, 1, 0, 0, 1;
  return path;
}

struct Expected {
  std::string name;
  int free, collisions, undecided;
  std::optional<std::size_t> missed;
};

void expectRows(const ExecutedPaths& found, const std::vector<Expected>& rows) {
  EXPECT_EQ(found.leftOut, "");
  ASSERT_EQ(found.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ExecutedRow& row = found.rows[i];
    EXPECT_EQ(row.name(), rows[i].name);
    EXPECT_EQ(row.free, rows[i].free) << row.name();
    EXPECT_EQ(row.collisions, rows[i].collisions) << row.name();
    EXPECT_EQ(row.undecided, rows[i].undecided) << row.name();
    EXPECT_EQ(row.missed, rows[i].missed) << row.name();
    EXPECT_GT(row.median, 0.0);
    EXPECT_EQ(row.relativeTime, row.mean / found.rows[0].mean);
  }
}

/// One block is inside of the corner: in both directions a blend of deviation d goes inwards by d /
/// sqrt(2). The other is above the end.
TEST(ExecutedPart, ABlockInsideOfTheCorner) {
  const double deep = 0.03 / std::numbers::sqrt2;  // reached by blends of more than 0.03
  CubeAmongBlocks cube({{0.8 - deep, 0.2 + deep}, {1.0, 1.2 + kGap}});
  const ExecutedPaths found = cube.ask({rightAngle()});
  EXPECT_EQ(found.paths, 1u);
  EXPECT_EQ(found.corners, 1u);
  expectRows(found, {{"polyline", 1, 0, 0, {}},
                     {"blends:0.1", 0, 1, 0, 0},
                     {"blends:0.05", 0, 1, 0, 0},
                     {"blends:0.01", 1, 0, 0, 0},
                     {"spline", 1, 0, 0, 0},
                     {"tube:0.01", 0, 1, 0, {}},
                     {"tube:0.005", 1, 0, 0, {}},
                     {"proven blends:0.1", 1, 0, 0, {}}});
}

/// The blend of 0.1 goes 1e-6 m into the block, for less than a hundredth of a metre.
TEST(ExecutedPart, StatesMissAShortContact) {
  const double deep = 0.1 / std::numbers::sqrt2 - 1e-6;
  CubeAmongBlocks cube({{0.8 - deep, 0.2 + deep}});
  const ExecutedPaths found = cube.ask({rightAngle(), rightAngle()});
  EXPECT_EQ(found.paths, 2u);
  ASSERT_EQ(found.rows.size(), 8u);
  EXPECT_EQ(found.rows[1].collisions, 2u);
  EXPECT_EQ(found.rows[1].missed, 2u);
  EXPECT_EQ(found.rows[1].missedRate(), 1.0);
  EXPECT_EQ(found.rows[1].collisionRate(), 1.0);
  EXPECT_EQ(found.rows[2].collisions, 0u);
  EXPECT_EQ(found.rows[2].missedRate(), std::nullopt);
}

/// The spline swings beyond a corner.
TEST(ExecutedPart, ABlockBeyondTheCorner) {
  CubeAmongBlocks cube({{1.2 + 0.03, -0.1}});
  expectRows(cube.ask({rightAngle()}), {{"polyline", 1, 0, 0, {}},
                                        {"blends:0.1", 1, 0, 0, 0},
                                        {"blends:0.05", 1, 0, 0, 0},
                                        {"blends:0.01", 1, 0, 0, 0},
                                        {"spline", 0, 1, 0, 0},
                                        {"tube:0.01", 1, 0, 0, {}},
                                        {"tube:0.005", 1, 0, 0, {}},
                                        {"proven blends:0.1", 1, 0, 0, {}}});
}

TEST(ExecutedPart, WithoutAPathThereAreNoRows) {
  CubeAmongBlocks cube({});
  const ExecutedPaths found = cube.ask({});
  EXPECT_TRUE(found.rows.empty());
  EXPECT_EQ(found.leftOut,
            "Left out: between pairs of random free states, no path with a corner was found.");
}

}  // namespace
}  // namespace swept
