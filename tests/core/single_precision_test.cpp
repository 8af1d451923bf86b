// SPDX-License-Identifier: BSD-3-Clause
// Our compile flags keep what is stored in single precision there: bounds are rounded up to floats,
// and read again as doubles.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>

namespace {

struct Pair {
  double a, b;
};

/// Two statements side by side, of which GCC 12 makes a vector without the rounding.
[[gnu::noinline]] Pair rounded(const Pair& pair) {
  const auto a = static_cast<float>(pair.a);
  const auto b = static_cast<float>(pair.b);
  return {static_cast<double>(a), static_cast<double>(b)};
}

[[gnu::noinline]] std::array<double, 4> rounded(const std::array<double, 4>& values) {
  std::array<float, 4> floats{};
  for (std::size_t i = 0; i < 4; ++i) floats[i] = static_cast<float>(values[i]);
  return {static_cast<double>(floats[0]), static_cast<double>(floats[1]),
          static_cast<double>(floats[2]), static_cast<double>(floats[3])};
}

TEST(SinglePrecision, IsNotTakenForDouble) {
  constexpr double kTenth = 0.1, kFloat = 0.100000001490116119384765625;
  const volatile double tenth = kTenth;  // not known when this is compiled
  const Pair pair = rounded(Pair{tenth, tenth});
  EXPECT_EQ(pair.a, kFloat);
  EXPECT_EQ(pair.b, kFloat);
  for (const double value : rounded(std::array<double, 4>{tenth, tenth, tenth, tenth}))
    EXPECT_EQ(value, kFloat);
}

}  // namespace
