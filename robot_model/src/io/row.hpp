// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>

#include "io/point_file.hpp"

namespace swept::detail {

/// Values that follow each other in a line of text.
struct Column {
  std::string name;
  int axis = -1;           ///< 0, 1, 2: this is x, y or z; -1: it is skipped
  std::size_t repeat = 1;  ///< so many values
  bool isList = false;     ///< a whole number, then so many values
};

/// Reads the point in the present line of blank-separated numbers; a number may be NaN or infinite.
/// Throws InputError for too few values, too many, and an x, y or z that is not a number.
Eigen::Vector3d readRow(const LineReader& lines, std::span<const Column> columns);

/// Reads the number at `at` and moves `at` past it. The number ends at one of these characters or
/// at the end of the line. `name` is for messages. Throws InputError if there is no number that a
/// double can hold.
double readNumber(const char*& at, const char* end, std::string_view separators,
                  std::string_view name, const LineReader& lines);

/// The first character of [at, end) that is not a blank or tab.
const char* skipBlanks(const char* at, const char* end);

}  // namespace swept::detail
