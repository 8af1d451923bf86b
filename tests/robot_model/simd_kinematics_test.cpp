// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/simd_motion.hpp"

#include <gtest/gtest.h>

#include "simd_robots.hpp"
#include "simd_targets.hpp"

namespace swept::simd_test {
namespace {

using detail::CheckerModel;
using detail::SimdModel;
using detail::SimdScratch;
using enum JointType;

/// What single precision cannot bound is left to the exact tier.
TEST(SimdKinematics, FarTurnsAndWhatIsNoNumberAreRefused) {
  Random random(13);
  ChainOptions options;
  options.types = {Planar, Revolute, Prismatic};
  options.mimics = 0.0;
  const CheckerModel model = robotOf(random, options);
  const SimdModel lanes = simdModelOf(model);
  SimdScratch scratch(lanes);
  const auto takes = [&](const std::vector<double>& from, const std::vector<double>& to) {
    return StraightSimdMotion(lanes, model.kinematics, from, to, scratch).compile();
  };
  const std::vector<double> good{0.1, 0.2, 0.3, 0.4, 0.1};
  EXPECT_TRUE(takes(good, good));
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
      std::vector<double> bad = good;
      bad[i] = value;
      // An angle modulo whole turns is as good as any.
      if ((i == 2 || i == 3) && value == 1e300) continue;
      EXPECT_FALSE(takes(good, bad)) << i << " " << value;
      EXPECT_FALSE(takes(bad, good)) << i << " " << value;
      EXPECT_FALSE(takes(bad, bad)) << i << " " << value;
    }
  }
  std::vector<double> far = good;
  far[3] = 150.0;
  EXPECT_FALSE(takes(good, far));
  EXPECT_TRUE(takes(far, far));
}

}  // namespace
}  // namespace swept::simd_test
