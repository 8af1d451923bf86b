// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "graph/motion_boxes.hpp"

namespace swept::detail {

/// Half of what single precision has of a number, as integers that can be compared: ten bits of its
/// fraction. It does not decrease with the number, so boxes whose keys do not overlap are apart.
/// Numbers up to 2^-15 have the key of zero, those from 2^17 on have the largest. Not of NaN.
struct BoxKey {
  static std::int16_t of(float value);
  ///@{
  /// No number with this key is less (more).
  static float least(std::int16_t key) {
    return key >= 0 ? numberOf(static_cast<std::uint32_t>(key))
                    : -numberOf(static_cast<std::uint32_t>(-key));
  }
  static float most(std::int16_t key) { return -least(static_cast<std::int16_t>(-1 - key)); }
  ///@}

 private:
  /// The bits of 2^-15, and those that a key leaves out.
  static constexpr std::uint32_t kLeast = 112U << 23U, kShift = 13;
  static constexpr std::uint32_t kLargest = 0x7fff;
  /// The least number that is not negative and has this key.
  static float numberOf(std::uint32_t key) {
    if (key == 0) return 0.0F;
    if (key > kLargest) return std::numeric_limits<float>::infinity();
    return std::bit_cast<float>((key << kShift) + kLeast);
  }
};

/// The keys of a box: lower x, y, z, upper x, y, z.
using BoxKeys = std::array<std::int16_t, 6>;
BoxKeys boxKeys(const SingleBox& box);

/// The keys of sixteen boxes side by side.
struct alignas(32) BoxRows {
  static constexpr std::size_t kBoxes = 16;
  std::array<std::array<std::int16_t, kBoxes>, 6> sides;

  void put(std::size_t index, const BoxKeys& keys) {
    for (std::size_t k = 0; k < keys.size(); ++k) sides[k][index] = keys[k];
  }
  /// No smaller than the box that was put.
  SingleBox box(std::size_t index) const {
    SingleBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.sides[k] = BoxKey::least(sides[k][index]);
      box.sides[k + 3] = BoxKey::most(sides[k + 3][index]);
    }
    return box;
  }
};

///@{
/// Which boxes overlap that with these keys, a bit each: of all rows, and of some of these.
void findOverlapping(std::span<const BoxRows> rows, const BoxKeys& box,
                     std::span<std::uint16_t> bits);
void findOverlapping(std::span<const BoxRows> rows, std::span<const std::uint32_t> which,
                     const BoxKeys& box, std::span<std::uint16_t> bits);
///@}

}  // namespace swept::detail
