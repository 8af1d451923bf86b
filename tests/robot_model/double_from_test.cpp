// SPDX-License-Identifier: BSD-3-Clause
// The function for standard libraries without std::from_chars for double, judged by the one here.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <random>
#include <string>
#include <version>

#undef __cpp_lib_to_chars
#include "text/double_from.cpp"

namespace {

void expectSame(const std::string& text) {
  SCOPED_TRACE("'" + text + "'");
  const char *first = text.data(), *last = text.data() + text.size();
  double expected = 7.0, value = 7.0;
  const auto judge = std::from_chars(first, last, expected);
  const auto result = swept::detail::doubleFrom(first, last, value);
  EXPECT_EQ(result.ec, judge.ec);
  EXPECT_EQ(result.ptr - first, judge.ptr - first);
  if (std::isnan(expected))
    EXPECT_TRUE(std::isnan(value));
  else
    EXPECT_EQ(value, expected);
  EXPECT_EQ(std::signbit(value), std::signbit(expected));
}

TEST(DoubleFrom, TakesWhatFromCharsTakes) {
  for (const char* text : {"",
                           "0",
                           "-0",
                           "1",
                           "1.",
                           ".5",
                           "-.5",
                           ".",
                           "-",
                           "--1",
                           "+1",
                           " 1",
                           "-+1",
                           "1e5",
                           "1e",
                           "1e+",
                           "1e-3x",
                           "1.5,2",
                           "1.5 2",
                           "1_000",
                           "0x10",
                           "-0X1p3",
                           "0x",
                           "x0",
                           "inf",
                           "-INF",
                           "infinity",
                           "infin",
                           "nan",
                           "-nan",
                           "nan(12)",
                           "1e400",
                           "-1e400",
                           "1e-400",
                           "-1e-400",
                           "0e-400",
                           "4e-320",
                           "4.9406564584124654e-324",
                           "1.7976931348623157e308",
                           "1.7976931348623159e308",
                           "9007199254740993",
                           "0.1e1e1",
                           "1(2)",
                           "12345678901234567890123456789",
                           "1.#IND"})
    expectSame(text);
}

TEST(DoubleFrom, RoundsAsFromCharsDoes) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> digit('0', '9'), length(1, 25), exponent(-330, 310);
  for (int i = 0; i < 20000; ++i) {
    std::string text = i % 3 == 0 ? "-" : "";
    for (int k = length(random); k > 0; --k) text += static_cast<char>(digit(random));
    text += '.';
    for (int k = length(random); k > 0; --k) text += static_cast<char>(digit(random));
    if (i % 2 == 0) text += "e" + std::to_string(exponent(random));
    expectSame(text);
  }
}

}  // namespace
