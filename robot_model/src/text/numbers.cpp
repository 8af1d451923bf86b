// SPDX-License-Identifier: BSD-3-Clause
#include "text/numbers.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "text/double_from.hpp"

namespace swept::detail {

namespace {
constexpr std::string_view kSpace = " \t\r\n\f\v";
constexpr double kQuaternionNorm = 1e-2;
}  // namespace

std::optional<double> parseNumber(std::string_view text) {
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
  // from_chars accepts no plus sign, but people write it.
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto result = doubleFrom(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<double> parseNumbers(std::string_view text) {
  std::vector<double> values;
  for (auto begin = text.find_first_not_of(kSpace); begin != std::string_view::npos;) {
    const auto end = text.find_first_of(kSpace, begin);
    const auto value = parseNumber(text.substr(begin, end - begin));
    if (!value) return {};
    values.push_back(*value);
    begin = text.find_first_not_of(kSpace, end);
  }
  return values;
}

std::string formatNumber(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::optional<Eigen::Quaterniond> unitQuaternion(const Eigen::Vector4d& values) {
  const double norm = values.norm();
  if (!(std::abs(norm - 1.0) <= kQuaternionNorm)) return std::nullopt;
  return Eigen::Quaterniond(values[3] / norm, values[0] / norm, values[1] / norm, values[2] / norm);
}

}  // namespace swept::detail
