// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "foreign_environment.hpp"

namespace swept::test {

/// Answers, bit by bit.
class Transcript {
 public:
  /// Any number of numbers, names, enumerators, vectors and poses.
  template <typename... Parts>
  void add(const Parts&... parts) {
    (put(parts), ...);
  }
  std::size_t size() const { return words_.size(); }
  /// Where the two differ first; their size where they do not.
  std::size_t common(const Transcript& other) const {
    const auto ends = std::ranges::mismatch(words_, other.words_);
    return static_cast<std::size_t>(ends.in1 - words_.begin());
  }

 private:
  template <typename Number>
  void put(const Number& number) {
    if constexpr (std::is_floating_point_v<Number>) {
      words_.push_back(std::bit_cast<std::uint64_t>(static_cast<double>(number)));
    } else if constexpr (std::is_enum_v<Number> || std::is_integral_v<Number>) {
      words_.push_back(static_cast<std::uint64_t>(number));
    } else if constexpr (std::is_convertible_v<Number, std::string_view>) {
      for (const char c : std::string_view(number)) words_.push_back(static_cast<unsigned char>(c));
      words_.push_back(~std::uint64_t{0});
    } else if constexpr (requires {
                           number.matrix();
                           number.linear();
                         }) {
      put(number.matrix());
    } else if constexpr (requires { number.rows(); }) {
      for (Eigen::Index i = 0; i < number.rows(); ++i) {
        for (Eigen::Index k = 0; k < number.cols(); ++k) put(number(i, k));
      }
    } else {
      for (const auto& part : number) put(part);
    }
  }
  std::vector<std::uint64_t> words_;
};

/// A query by name, of inputs that are there before; what it answers goes into the transcript.
struct Query {
  std::string name;
  std::function<void(Transcript&)> ask;
};

/// Each query has the same bits in every environment, and leaves that as it is.
inline void expectSameInEveryEnvironment(const std::vector<Query>& queries) {
  for (const Query& query : queries) {
    SCOPED_TRACE(query.name);
    Transcript expected;
    query.ask(expected);
    EXPECT_GT(expected.size(), 0U) << "says nothing";
    for (const Environment& environment : foreignEnvironments()) {
      SCOPED_TRACE(environment.name);
      Transcript answer;
      EXPECT_TRUE(leavesAlone(environment, [&] { query.ask(answer); }));
      EXPECT_EQ(answer.size(), expected.size());
      EXPECT_EQ(answer.common(expected), expected.size());
    }
  }
}

/// Each throws, with the same message, and leaves the environment as it is.
inline void expectSameRefusals(const std::vector<Query>& queries) {
  const auto messageOf = [](const Query& query) -> std::string {
    Transcript none;
    try {
      query.ask(none);
    } catch (const std::exception& e) {
      return e.what();
    }
    return {};
  };
  for (const Query& query : queries) {
    SCOPED_TRACE(query.name);
    const std::string expected = messageOf(query);
    EXPECT_FALSE(expected.empty()) << "throws nothing";
    for (const Environment& environment : foreignEnvironments()) {
      SCOPED_TRACE(environment.name);
      std::string message;
      EXPECT_TRUE(leavesAlone(environment, [&] { message = messageOf(query); }));
      EXPECT_EQ(message, expected);
    }
  }
}

}  // namespace swept::test
