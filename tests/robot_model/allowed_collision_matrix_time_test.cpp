// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "message_of.hpp"
#include "swept/robot_model/allowed_collision_matrix.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::shared_ptr<const Robot> arm() {
  return test::parseArm(test::armUrdf({}));
}

/// What is open when the time is over stays checked; what needs no search is said all the same.
TEST(CollisionMatrixTime, WithoutTimeNothingIsProven) {
  const auto robot = arm();
  const std::vector<LinkPairReport> reports =
      computeAllowedCollisionMatrix(*robot, {.seconds = 1e-9});
  int open = 0;
  for (const LinkPairReport& report : reports) {
    EXPECT_EQ(report.outOfTime, report.status == PairStatus::Unknown);
    EXPECT_NE(report.status, PairStatus::Never);
    open += report.outOfTime ? 1 : 0;
  }
  ASSERT_GT(open, 0);
  EXPECT_EQ(reports.front().status, PairStatus::Adjacent);
  EXPECT_THAT(srdfWithPairs(*robot, reports), Not(HasSubstr("Never")));
}

TEST(CollisionMatrixTime, WithEnoughOfItReportsAreThoseWithoutALimit) {
  const auto robot = arm();
  const AllowedCollisionMatrixOptions unlimited{.budget = 200'000};
  AllowedCollisionMatrixOptions limited = unlimited;
  limited.seconds = 1e6;
  std::vector<std::size_t> done;
  limited.progress = [&](std::size_t one, std::size_t all) {
    done.push_back(one);
    EXPECT_EQ(all, 6U);
  };
  const auto expected = computeAllowedCollisionMatrix(*robot, unlimited);
  const auto found = computeAllowedCollisionMatrix(*robot, limited);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].status, expected[i].status) << i;
    EXPECT_FALSE(found[i].outOfTime);
  }
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3, 4, 5, 6}));
}

TEST(CollisionMatrixTime, NoTimeIsAnError) {
  EXPECT_EQ(test::messageOf([] { computeAllowedCollisionMatrix(*arm(), {.seconds = 0.0}); }),
            "computeAllowedCollisionMatrix: seconds 0 must be above 0");
}

}  // namespace
}  // namespace swept
