// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"

/// How numbers, points and results look, as text and as JSON.
namespace swept {

using Json = nlohmann::ordered_json;

/// Six significant digits: for reading, not for reading back.
std::string shortNumber(double value);
/// Three significant digits and the unit.
std::string secondsText(double seconds);
/// Fewest digits that read back to the same double.
std::string exactNumber(double value);
/// `1 segment`, `3 segments`. `several`: instead of `what` with an s.
std::string countedText(std::size_t count, const std::string& what,
                        const std::string& several = {});
/// m, to the picometre: what is below is rounding, not distance.
std::string lengthText(double metres);
/// `[x y z]`, m.
std::string pointText(const Eigen::Vector3d& point);
/// `a, b, c`.
std::string joined(std::span<const std::string> items, const std::string& separator = ", ");
/// A cell of a CSV file, in quotes where it needs them.
std::string csvCell(const std::string& text);
/// The two bodies do not touch: they are closer than their margin.
bool keepsApart(const Witness& witness);
/// There are some, and that is so of all of them.
bool keepApart(std::span<const Witness> contacts);
/// `link - body: distance 0.001 m, closer than the margin of 0.01 m, at [..] and [..]`.
std::string witnessText(const Witness& witness);

Json toJson(const Eigen::Vector3d& point);
Json toJson(std::span<const double> values);
Json toJson(const Witness& witness);
/// Infinite and undefined numbers are null: JSON has none.
Json finiteOrNull(double value);

/// JSON over several lines. Bytes of names that are not UTF-8, which JSON has to be, become U+FFFD.
std::string dumped(const Json& json);
/// The same on one line.
std::string lineOf(const Json& json);
/// Throws UsageError, beginning with `where`, for the first key or text in it that is not UTF-8:
/// for files whose names have to be the ones that were read.
void requireUtf8(const Json& json, const std::string& where);

}  // namespace swept
