// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swept::detail {

/// One finite decimal number, with nothing but white space around it. Independent of the locale.
std::optional<double> parseNumber(std::string_view text);

/// White-space separated finite numbers; empty if one of them is not a number, or there are none.
std::vector<double> parseNumbers(std::string_view text);

/// Shortest text that reads back as the same double.
std::string formatNumber(double value);

/// Quaternion with `values` = x, y, z, w, normalised; empty unless its norm is within 1e-2 of 1,
/// since a larger difference is a mistake, not rounding.
std::optional<Eigen::Quaterniond> unitQuaternion(const Eigen::Vector4d& values);

}  // namespace swept::detail
