// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

/// Numbers as a page holds them: base64 of little-endian bytes, for JavaScript's typed arrays.
namespace swept {

/// RFC 4648, with padding.
std::string base64Of(std::span<const std::uint8_t> bytes);

/// Of 2, 4 or 8 bytes each.
template <typename Number>
requires(std::integral<Number> || std::floating_point<Number>) std::string
    packed(std::span<const Number> numbers) {
  using Bits =
      std::conditional_t<sizeof(Number) == 2, std::uint16_t,
                         std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>>;
  static_assert(sizeof(Number) == sizeof(Bits));
  std::vector<std::uint8_t> bytes;
  bytes.reserve(numbers.size_bytes());
  for (const Number number : numbers) {
    const auto bits = std::bit_cast<Bits>(number);
    for (std::size_t shift = 0; shift < 8 * sizeof(Bits); shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
  return base64Of(bytes);
}

/// The largest float that is not above `value` (m), so that a proven lower bound stays one.
float roundedDown(double value);

/// Position (m), then quaternion x, y, z, w.
void appendPose(std::vector<float>& numbers, const Eigen::Isometry3d& pose);

}  // namespace swept
