// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "io/point_file.hpp"
#include "io/row.hpp"

namespace swept::detail {

namespace {

constexpr std::array<const char*, 3> kNames{"x", "y", "z"};

/// Moves `at` behind what separates two numbers: blanks, with or without one comma or semicolon.
/// That one, or a blank.
char skipSeparator(const char*& at, const char* end) {
  at = skipBlanks(at, end);
  if (at == end || (*at != ',' && *at != ';')) return ' ';
  const char separator = *at;
  at = skipBlanks(at + 1, end);
  return separator;
}

Eigen::Vector3d readLine(const LineReader& lines) {
  const char* at = lines.line().data();
  const char* const end = at + lines.line().size();
  at = skipBlanks(at, end);
  Eigen::Vector3d point;
  std::array<char, 3> separators{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (at == end) {
      lines.fail(std::string("the line ends where ") + kNames[axis] + " should follow");
    }
    point[static_cast<Eigen::Index>(axis)] = readNumber(at, end, " \t,;", kNames[axis], lines);
    separators[axis] = skipSeparator(at, end);
  }
  // A decimal comma would otherwise make two numbers of one: in `1,5 2,5 3,5`, say.
  if (separators[0] != separators[1]) {
    lines.fail("'" + std::string(1, separators[0]) + "' is between x and y, but '" +
               std::string(1, separators[1]) + "' between y and z; it must be the same");
  }
  return point;
}

}  // namespace

SensedPoints readXyz(const PointFile& file) {
  PointList points;
  LineReader lines(file);
  while (lines.nextFilled()) {
    const std::string_view line = lines.line();
    if (line[line.find_first_not_of(" \t")] == '#') continue;
    if (points.given() == kMaxPoints) {
      lines.fail("the file has more than " + std::to_string(kMaxPoints) +
                 " points, which is the most allowed");
    }
    points.add(readLine(lines));
  }
  return {points.finish(file.source()), Eigen::Vector3d::Zero()};
}

}  // namespace swept::detail
