// SPDX-License-Identifier: BSD-3-Clause
// Both queries of a motion give one verdict, near the tolerance too. They differed there, about
// once in a thousand such motions: only one of them looked at the ends of a motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "model_robots.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

using Configuration = std::vector<double>;

struct Case {
  const char* name;
  CheckerOptions options;
  bool moving;  ///< an obstacle, too
};

void PrintTo(const Case& value, std::ostream* out) {
  *out << value.name;
}

class MotionQueries : public testing::TestWithParam<Case> {
 protected:
  MotionQueries()
      : random_(17),
        checker_(test::modelRobot("rook7"), "arm", world(), GetParam().options),
        workspace_(checker_) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::shared_ptr<const World> world() {
    auto result = std::make_shared<World>();
    for (int i = 0; i < 12; ++i) {
      const Eigen::Isometry3d place(
          Eigen::Translation3d(uniform(-0.8, 0.8), uniform(-0.8, 0.8), uniform(0.0, 1.1)));
      const std::string name = "obstacle " + std::to_string(i);
      if (i % 2 == 0)
        result->add(name, Sphere{uniform(0.02, 0.1)}, place);
      else
        result->add(name, Box{{uniform(0.02, 0.1), uniform(0.02, 0.1), uniform(0.02, 0.1)}}, place);
    }
    if (!GetParam().moving) return result;
    MovingObstacle ball{.name = "ball", .parts = {{Sphere{0.1}, Eigen::Isometry3d::Identity()}}};
    for (int i = 0; i < 6; ++i)
      ball.waypoints.push_back({0.2 * i, Eigen::Isometry3d(Eigen::Translation3d(
                                             uniform(-0.7, 0.7), uniform(-0.7, 0.7), 0.6))});
    result->add(std::move(ball));
    return result;
  }

  Configuration anywhere() {
    Configuration q(static_cast<std::size_t>(checker_.dimension()));
    for (double& value : q) value = uniform(-2.5, 2.5);
    if (GetParam().moving) q.back() = uniform(0.0, 1.0);
    return q;
  }

  MotionCertificate certify(const Configuration& from, const Configuration& to, MotionQuery query) {
    return checker_.certifyMotion(from, to, workspace_, query);
  }

  std::mt19937 random_;
  Checker checker_;
  Workspace workspace_;
};

TEST_P(MotionQueries, GiveOneVerdict) {
  std::array<int, 3> verdicts{};
  int moved = 0;
  for (int round = 0; round < 4000; ++round) {
    SCOPED_TRACE(round);
    const Configuration from = anywhere();
    Configuration to = anywhere();
    // About half of them end where something is about to touch.
    const MotionCertificate whole = certify(from, to, MotionQuery::FirstContact);
    if (whole.witness && whole.witness->t > 0.0 && round % 4 != 0) {
      const double off = std::pow(10.0, uniform(-6.0, -2.0)) * (round % 2 == 0 ? 1.0 : -1.0);
      const Eigen::VectorXd end =
          checker_.interpolate(from, to, std::clamp(whole.witness->t + off, 0.0, 1.0));
      to.assign(end.begin(), end.end());
    }
    const MotionCertificate first = certify(from, to, MotionQuery::FirstContact);
    const MotionCertificate any = certify(from, to, MotionQuery::VerdictOnly);
    ASSERT_EQ(first.verdict, any.verdict);
    ++verdicts[static_cast<std::size_t>(first.verdict)];
    ASSERT_EQ(first.witness.has_value(), any.witness.has_value());
    if (first.witness) {
      ASSERT_LE(first.witness->t, any.witness->t);
      moved += first.witness->t < any.witness->t ? 1 : 0;
      continue;
    }
    // Without a contact both take the same steps.
    EXPECT_EQ(first.undecidedAt, any.undecidedAt);
    EXPECT_EQ(first.effort.intervals, any.effort.intervals);
    EXPECT_EQ(first.effort.distances, any.effort.distances);
    EXPECT_EQ(first.effort.culled, any.effort.culled);
    EXPECT_EQ(first.effort.lanes, any.effort.lanes);
  }
  for (const int count : verdicts) EXPECT_GT(count, 20);
  EXPECT_GT(moved, 200) << "first contacts that are not any contact";
}

INSTANTIATE_TEST_SUITE_P(
    , MotionQueries,
    testing::Values(Case{"CoarseTolerance", {.tolerance = 5e-3}, false},
                    Case{"Margin", {.margin = 0.01, .tolerance = 2e-3}, false},
                    Case{"FewIntervals", {.maxIntervals = 12}, false},
                    Case{"ExactAlone", {.tolerance = 5e-3, .maxIntervals = 7}, false},
                    Case{"MovingObstacle", {.tolerance = 5e-3}, true}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace swept
