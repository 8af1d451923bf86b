// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

namespace forgeries {

/// The same numbers for the same seed and index.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index) {
    std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                        static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32)};
    engine_.seed(words);
  }
  double uniform(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(engine_);
  }
  /// 0 to count - 1.
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_);
  }
  bool chance(double share) { return uniform(0.0, 1.0) < share; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  double normal() { return normal_(engine_); }
  /// Every power of ten between as often.
  double scale(double lower, double upper) { return std::pow(10.0, uniform(lower, upper)); }
  template <typename T>
  T pick(std::initializer_list<T> list) {
    return list.begin()[below(list.size())];
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace forgeries
