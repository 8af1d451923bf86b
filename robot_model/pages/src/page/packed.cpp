// SPDX-License-Identifier: BSD-3-Clause
#include "page/packed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swept {

std::string base64Of(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += k <= count ? kDigits[word >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

float roundedDown(double value) {
  const auto nearest = static_cast<float>(value);
  if (!(static_cast<double>(nearest) > value)) return nearest;
  return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

void appendPose(std::vector<float>& numbers, const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond turn(pose.linear());
  for (const double value : pose.translation()) numbers.push_back(static_cast<float>(value));
  for (const double value : turn.coeffs()) numbers.push_back(static_cast<float>(value));
}

}  // namespace swept
