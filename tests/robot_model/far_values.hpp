// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "../urdf_text.hpp"
#include "simd_robots.hpp"
#include "swept/robot_model/checker.hpp"

/// Judges what is said of a ball on joints at large values, beside another one; truths are in 50
/// digits.
namespace swept::far_test {

using Digits = boost::multiprecision::cpp_bin_float_50;
using Exact = std::array<Digits, 3>;
using simd_test::Random;
using test::joint;

inline constexpr double kRadius = 0.0625;  // m, of the robot's ball and of the one beside it
/// What may be lost of a clearance, per unit of the values in use; and m, by iterations.
inline constexpr double kLoss = 1e-12;
inline constexpr double kIterations = 2e-9;

inline std::string ball(const std::string& name, const std::string& origin = "0 0 0") {
  return "<link name='" + name + "'><collision><origin xyz='" + origin +
         "'/><geometry><sphere radius='0.0625'/></geometry></collision></link>";
}

inline std::shared_ptr<const Robot> robotOf(const std::string& elements) {
  return Robot::parse("<robot name='r'><link name='base'/>" + elements + "</robot>", "r.urdf");
}

inline std::string wide(const std::string& axis) {
  return "<axis xyz='" + axis + "'/><limit lower='-1e16' upper='1e16' effort='1' velocity='1'/>";
}

/// Where the robot's ball is at `q`, what that is made of, and a configuration from which it comes
/// nearer to whatever is behind `q` all the way; empty: none is known.
struct Place {
  std::vector<double> q;
  Exact at;
  double used = 0.0;  ///< m, or rad times 1 m
  std::vector<double> from = {};
  Eigen::Vector3d ahead = Eigen::Vector3d::UnitX();  ///< which way it comes
};

inline Digits distance(const Exact& a, const Eigen::Vector3d& b) {
  Digits squared = 0;
  for (int i = 0; i < 3; ++i) squared += (a[i] - Digits(b[i])) * (a[i] - Digits(b[i]));
  return sqrt(squared);
}

struct Counts {
  int touching = 0, apart = 0, free = 0;
};

class Judge {
 public:
  Judge(std::shared_ptr<const Robot> robot, World others = {})
      : robot_(std::move(robot)), others_(std::move(others)) {}

  /// With a ball ahead whose gap is about as much as `gap` (m).
  void judge(const Place& place, double gap, Counts& counts) const {
    Eigen::Vector3d at;
    for (int i = 0; i < 3; ++i)
      at[i] = static_cast<double>(place.at[i] + Digits((2.0 * kRadius + gap) * place.ahead[i]));
    const Digits truth = distance(place.at, at) - 2 * Digits(kRadius);
    const double loss = kLoss * place.used + kIterations;
    counts.touching += truth <= 0 ? 1 : 0;
    counts.apart += truth > loss ? 1 : 0;
    for (const int maxIntervals : {7, 1 << 20}) {  // with 7 the lanes are not asked
      const Checker checker = beside(at, maxIntervals);
      Workspace workspace(checker);
      judgeState(checker, place, truth, loss, workspace, counts);
      if (!place.from.empty()) judgeMotion(checker, place, truth, loss, workspace);
    }
  }

 private:
  Checker beside(const Eigen::Vector3d& at, int maxIntervals) const {
    World world = others_;
    world.add("ball", makeSphere(kRadius), Eigen::Isometry3d(Eigen::Translation3d(at)));
    CheckerOptions options;
    options.maxIntervals = maxIntervals;
    return {robot_, "all", std::make_shared<const World>(std::move(world)), options};
  }

  static void judgeState(const Checker& checker, const Place& place, const Digits& truth,
                         double loss, Workspace& workspace, Counts& counts) {
    std::vector<Verdict> verdicts(3);
    std::vector<double> states;
    for (int i = 0; i < 3; ++i) states.insert(states.end(), place.q.begin(), place.q.end());
    checker.checkStates(states, verdicts, workspace);
    verdicts.push_back(checker.checkState(place.q, workspace));
    verdicts.push_back(checker.certifyMotion(place.q, place.q, workspace).verdict);
    for (const Verdict verdict : verdicts) {
      if (truth <= 0) {
        EXPECT_NE(verdict, Verdict::Free) << truth << " m at " << place.used;
      } else if (truth > loss) {
        EXPECT_EQ(verdict, Verdict::Free) << truth << " m at " << place.used;
      }
      counts.free += verdict == Verdict::Free ? 1 : 0;
    }
    const double clearance = checker.clearance(place.q, workspace);
    if (checker.checkedPairs().empty()) return;  // out of reach
    EXPECT_LE(clearance, std::max(0.0, static_cast<double>(truth)) * (1.0 + 1e-12));
    EXPECT_GE(clearance, static_cast<double>(truth) - loss) << place.used;
  }

  static void judgeMotion(const Checker& checker, const Place& place, const Digits& truth,
                          double loss, Workspace& workspace) {
    for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
      const auto found = checker.certifyMotion(place.from, place.q, workspace, query);
      if (truth <= 0) {
        EXPECT_NE(found.verdict, Verdict::Free) << truth << " m at " << place.used;
      } else if (truth > loss + checker.options().tolerance &&
                 checker.options().maxIntervals > 100) {
        EXPECT_EQ(found.verdict, Verdict::Free) << truth << " m at " << place.used;
        EXPECT_EQ(found.freeUntil, 1.0);
      }
    }
  }

  std::shared_ptr<const Robot> robot_;
  World others_;
};

/// m, of either sign and any size that matters among values of `used`.
inline double someGap(Random& random, double used) {
  if (random.chance(0.3)) return 1.1e-3 + kLoss * used + random.scale(1e-3, 1.0);
  const double size = used * random.scale(1e-17, 1e-11);
  return random.chance(0.5) ? size : -std::min(size, kRadius);
}

inline void judgeMany(const Judge& judge, Random& random, int rounds, const auto& placeOf) {
  Counts counts;
  for (int round = 0; round < rounds && !testing::Test::HasFailure(); ++round) {
    const Place place = placeOf(random);
    judge.judge(place, someGap(random, place.used), counts);
  }
  EXPECT_GT(counts.touching, rounds / 8);
  EXPECT_GT(counts.apart, rounds / 4);
  EXPECT_GT(counts.free, rounds);
}

}  // namespace swept::far_test
