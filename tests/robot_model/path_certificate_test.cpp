// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/path_certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

#include "sliding_cube.hpp"

namespace swept {
namespace {

using States = std::vector<std::vector<double>>;

/// m, on the segment, by sampling.
double leastDistance(const std::vector<double>& from, const std::vector<double>& to) {
  double least = INFINITY;
  for (int i = 0; i <= 2000; ++i) {
    const double t = i / 2000.0;
    least = std::min(least, test::cubeDistance(from[0] + t * (to[0] - from[0]),
                                               from[1] + t * (to[1] - from[1])));
  }
  return least;
}

States randomPath(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  States states(count, std::vector<double>(2));
  for (std::vector<double>& q : states)
    for (double& value : q) value = place(random);
  return states;
}

TEST(PathCertificate, ProvesWhatSamplesAgreeWith) {
  const Checker checker(test::slidingCube(), "all", test::worldWithCube());
  const States states = randomPath(1000);
  const PathCertificate path = certifyPath(checker, states);
  ASSERT_EQ(path.segments.size(), 999u);
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    SCOPED_TRACE(i);
    const CertifiedSegment& segment = path.segments[i];
    const double least = leastDistance(states[i], states[i + 1]);
    if (segment.certificate.verdict == Verdict::Free) {
      ASSERT_TRUE(segment.clearance.has_value());
      EXPECT_GT(least, 0.0);
      EXPECT_LE(segment.clearance->lower, least + 1e-12);
      EXPECT_GE(segment.clearance->upper, least - 2e-3);
    } else if (segment.certificate.verdict == Verdict::Collision) {
      EXPECT_FALSE(segment.clearance.has_value());
      EXPECT_LT(least, 2e-3);
    }
  }
  EXPECT_GT(path.count(Verdict::Free), 300u);
  EXPECT_GT(path.count(Verdict::Collision), 300u);
  EXPECT_EQ(path.verdict(), Verdict::Collision);
}

TEST(PathCertificate, DoesNotDependOnThreads) {
  const Checker checker(test::slidingCube(), "all", test::worldWithCube());
  const States states = randomPath(700);
  const PathCertificate one = certifyPath(checker, states, {.threads = 1});
  const PathCertificate four = certifyPath(checker, states, {.threads = 4});
  for (std::size_t i = 0; i < one.segments.size(); ++i) {
    const CertifiedSegment &a = one.segments[i], &b = four.segments[i];
    EXPECT_EQ(a.certificate.verdict, b.certificate.verdict);
    EXPECT_EQ(a.certificate.freeUntil, b.certificate.freeUntil);
    ASSERT_EQ(a.clearance.has_value(), b.clearance.has_value());
    if (a.clearance) {
      EXPECT_EQ(a.clearance->lower, b.clearance->lower);
    }
  }
}

TEST(PathCertificate, TheWorstSegmentIsThePaths) {
  const Checker checker(test::slidingCube(), "all", test::worldWithCube());
  const std::vector<double> left{-1, 0}, up{0, 1}, right{1, 0}, touching{0, 0.2};
  EXPECT_EQ(certifyPath(checker, States{left, {-1, 1}, up, {1, 1}, right}).verdict(),
            Verdict::Free);
  EXPECT_EQ(certifyPath(checker, States{left, right}).verdict(), Verdict::Collision);
  EXPECT_NE(certifyPath(checker, States{up, touching}).verdict(), Verdict::Free);
}

TEST(PathCertificate, OfOneStateIsOfTheMotionThatStays) {
  const Checker checker(test::slidingCube(), "all", test::worldWithCube());
  const PathCertificate free = certifyPath(checker, States{{1.0, 0.0}});
  ASSERT_EQ(free.segments.size(), 1u);
  EXPECT_EQ(free.verdict(), Verdict::Free);
  EXPECT_NEAR(free.segments[0].clearance->lower, 0.8, 1e-3);
  EXPECT_EQ(certifyPath(checker, States{{0.0, 0.0}}).verdict(), Verdict::Collision);
}

TEST(PathCertificate, LeavesOutWhatIsNotAskedFor) {
  const Checker checker(test::slidingCube(), "all", test::worldWithCube());
  std::vector<std::size_t> told;
  const PathCertificate path = certifyPath(
      checker, randomPath(1000),
      {.clearances = false, .progress = [&](std::size_t done) { told.push_back(done); }});
  EXPECT_TRUE(std::ranges::none_of(path.segments, [](const CertifiedSegment& segment) {
    return segment.clearance.has_value();
  }));
  EXPECT_GT(told.size(), 1u);
  EXPECT_TRUE(std::ranges::is_sorted(told));
  EXPECT_EQ(told.back(), 999u);
}

TEST(PathCertificate, RefusesWhatIsNoPath) {
  const Checker checker(test::slidingCube(), "all", test::worldWithCube());
  EXPECT_THROW(certifyPath(checker, States{}), std::invalid_argument);
  EXPECT_THROW(certifyPath(checker, States{{0.0, 0.0}, {0.0}}), std::invalid_argument);
}

}  // namespace
}  // namespace swept
