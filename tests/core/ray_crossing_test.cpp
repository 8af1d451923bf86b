// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ray_crossing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <random>

namespace swept::detail {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// The same decisions in integers, where a zero is a zero.
Crossing exactCrossing(const Vector3i& direction, const Vector3i& a, const Vector3i& b,
                       const Vector3i& c) {
  if (std::max({direction.dot(a), direction.dot(b), direction.dot(c)}) < 0) return Crossing::Miss;
  const int sides[] = {direction.dot(b.cross(c)), direction.dot(c.cross(a)),
                       direction.dot(a.cross(b))};
  const auto [least, most] = std::minmax_element(std::begin(sides), std::end(sides));
  if (*least < 0 && *most > 0) return Crossing::Miss;
  const int volume = a.dot(b.cross(c));
  if (std::count(std::begin(sides), std::end(sides), 0) > 0 || volume == 0) return Crossing::Unsure;
  if ((volume > 0) != (*least > 0)) return Crossing::Miss;
  return *least > 0 ? Crossing::Along : Crossing::Against;
}

TEST(RayCrossing, AgreesWithIntegers) {
  std::mt19937 random(15);
  std::uniform_int_distribution<int> coordinate(-4, 4);
  const auto draw = [&] {
    const int x = coordinate(random);
    const int y = coordinate(random);
    return Vector3i(x, y, coordinate(random));
  };
  std::array<int, 4> counts{};
  for (int i = 0; i < 20000; ++i) {
    const Vector3i direction = draw();
    const Vector3i a = draw();
    const Vector3i b = draw();
    const Vector3i c = draw();
    const Vector3d unit = 0.25 * direction.cast<double>();
    const Crossing crossing =
        rayCrossing(unit, a.cast<double>(), b.cast<double>(), c.cast<double>());
    ASSERT_EQ(crossing, exactCrossing(direction, a, b, c));
    ++counts[static_cast<std::size_t>(crossing)];
  }
  for (int count : counts) EXPECT_GT(count, 300);
}

TEST(RayCrossing, IsUnsureOfWhatIsNoNumberAndOfUnderflow) {
  const Vector3d direction(0.5, 0.5, 0.5);
  const Vector3d a(3, 0, 0);
  const Vector3d b(0, 3, 0);
  const Vector3d c(0, 0, 3);
  EXPECT_EQ(rayCrossing(direction, a, b, c), Crossing::Along);
  EXPECT_EQ(rayCrossing(direction, a, c, b), Crossing::Against);
  EXPECT_EQ(rayCrossing(-direction, a, b, c), Crossing::Miss);
  EXPECT_EQ(rayCrossing(direction, 1e-160 * a, 1e-160 * b, 1e-160 * c), Crossing::Unsure);
  EXPECT_EQ(rayCrossing(direction, 1e200 * a, 1e200 * b, 1e200 * c), Crossing::Unsure);
  const Vector3d nan = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(rayCrossing(direction, a, b, nan), Crossing::Unsure);
  EXPECT_EQ(rayCrossing(nan, a, b, c), Crossing::Unsure);
}

}  // namespace
}  // namespace swept::detail
