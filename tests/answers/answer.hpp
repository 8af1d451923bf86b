// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

#include "swept/core/verdict.hpp"

namespace swept::answers {

/// One word from another: each has one of its own.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// 64 bits that tell one sequence of words from another.
class Digest {
 public:
  void add(std::uint64_t word) { value_ = mixed((value_ ^ word) + 0x9e3779b97f4a7c15); }
  void add(std::string_view text) {
    for (const char c : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    add(~std::uint64_t{0});
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0;
};

/// What one question is answered, bit by bit. Of what is not a number the bits are left out.
class Answer {
 public:
  /// Prints each part as it comes, where there is a stream.
  explicit Answer(std::ostream* text = nullptr) : text_(text) {}

  /// A verdict, a distance, or what else decides: enters both digests.
  template <typename Value>
  void result(std::string_view name, const Value& value) {
    if constexpr (std::is_same_v<Value, Verdict>) letters_ += letter(value);
    put(name, value, true);
  }
  /// What says more about it: enters the digest of everything alone.
  template <typename Value>
  void detail(std::string_view name, const Value& value) {
    put(name, value, false);
  }
  /// What the question is: enters none.
  template <typename Value>
  void question(std::string_view name, const Value& value) {
    if (text_) put(name, value, {});
  }

  const std::string& letters() const { return letters_; }  ///< F, C, U: each of the verdicts
  std::uint64_t verdict() const { return verdict_.value(); }
  std::uint64_t full() const { return full_.value(); }

 private:
  enum class Where : std::uint8_t { None, Full, Both };
  struct Part {
    Part() = default;
    Part(bool both) : where(both ? Where::Both : Where::Full) {}
    Where where = Where::None;
  };
  // Not the number of the enumerator: that may change.
  static char letter(Verdict verdict) {
    if (verdict == Verdict::Free) return 'F';
    return verdict == Verdict::Collision ? 'C' : 'U';
  }
  void word(std::uint64_t bits, Part part) {
    if (part.where != Where::None) full_.add(bits);
    if (part.where == Where::Both) verdict_.add(bits);
  }
  void print(std::string_view name, std::string_view value) {
    if (text_) *text_ << name << ' ' << value << '\n';
  }
  template <typename Value>
  void put(std::string_view name, const Value& value, Part part) {
    if constexpr (std::is_same_v<Value, Verdict>) {
      word(static_cast<unsigned char>(letter(value)), part);
      print(name, std::string_view(toString(value)));
    } else if constexpr (std::is_floating_point_v<Value>) {
      word(std::isnan(value) ? 0x7ff8000000000000 : std::bit_cast<std::uint64_t>(double{value}),
           part);
      std::array<char, 80> text{};
      if (text_) std::snprintf(text.data(), text.size(), "%.17g %a", double{value}, double{value});
      print(name, text.data());
    } else if constexpr (std::is_integral_v<Value> || std::is_enum_v<Value>) {
      const auto number = static_cast<std::int64_t>(value);
      word(static_cast<std::uint64_t>(number), part);
      if (text_) print(name, std::to_string(number));
    } else if constexpr (std::is_convertible_v<Value, std::string_view>) {
      const std::string_view text = value;
      for (const char c : text) word(static_cast<unsigned char>(c), part);
      word(~std::uint64_t{0}, part);
      print(name, text);
    } else if constexpr (requires {
                           value.matrix();
                           value.linear();
                         }) {
      put(name, value.matrix(), part);
    } else if constexpr (requires { value.rows(); }) {
      for (int i = 0; i < value.rows(); ++i)
        for (int k = 0; k < value.cols(); ++k) put(name, value(i, k), part);
    } else {
      word(value.size(), part);
      for (const auto& one : value) put(name, one, part);
    }
  }

  std::ostream* text_;
  std::string letters_;
  Digest verdict_, full_;
};

}  // namespace swept::answers
