// SPDX-License-Identifier: BSD-3-Clause
#include "shape_input.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"

/// The first contact of two shapes that move, against distances at moments of the motion.
namespace swept::fuzz {
namespace {

using Eigen::Isometry3d;

constexpr int kMoments = 33;

UniformMotion motion(Numbers& numbers, double scale) {
  const Isometry3d start = pose(numbers, 2.0 * scale);
  switch (numbers.byte() % 4) {
    case 0:
      return UniformMotion::translation(start, 3.0 * scale * vector3(numbers));
    case 1:
      return UniformMotion::interpolation(start, pose(numbers, 2.0 * scale));
    case 2:
      return UniformMotion::screw(start, pose(numbers, 2.0 * scale));
    default: {
      const Eigen::Vector3d turn = 7.0 * vector3(numbers);
      return UniformMotion::turning(start, turn, scale * vector3(numbers));
    }
  }
}

void examine(const Sampled& a, const UniformMotion& motionA, const Sampled& b,
             const UniformMotion& motionB, double scale) {
  ContinuousOptions options;
  options.tolerance = 1e-3 * scale;
  options.maxIntervals = 20'000;
  const ContinuousResult found = continuousCollide(a.shape, motionA, b.shape, motionB, options);
  if (found.verdict == Verdict::Free && found.freeUntil != 1.0) fail("free, but not until 1");
  if (!(found.freeUntil >= 0.0 && found.freeUntil <= found.contactBy && found.contactBy <= 1.0))
    fail("the times are not in order");
  const auto gapAt = [&](double t) {
    return distance(a.shape, b.shape, motionA.at(t).inverse() * motionB.at(t));
  };
  const double slack = 1e-9 * scale;
  for (int i = 0; i < kMoments && found.freeUntil > 0.0; ++i) {
    // Just before its end: there the contact may be.
    const double t = found.freeUntil * (1.0 - 1e-9) * i / (kMoments - 1);
    if (gapAt(t).upper == 0.0) fail("in contact while proven free");
  }
  if (found.verdict == Verdict::Collision && gapAt(found.contactBy).lower > slack)
    fail("no contact at the time of contact");
}

}  // namespace
}  // namespace swept::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swept::fuzz;
  Numbers numbers(data, size);
  const double scale = numbers.size();
  const Sampled a = shape(numbers, scale), b = shape(numbers, scale);
  const swept::UniformMotion motionA = motion(numbers, scale);
  examine(a, motionA, b, motion(numbers, scale), scale);
  return 0;
}
