// SPDX-License-Identifier: BSD-3-Clause
#include "io/row.hpp"

#include <algorithm>
#include <limits>

#include "text/double_from.hpp"

namespace swept::detail {

namespace {

constexpr std::string_view kRowBlanks = " \t";

const char* skipWord(const char* at, const char* end) {
  while (at != end && *at != ' ' && *at != '\t') ++at;
  return at;
}

/// Returns the beginning of the next word, which must exist.
const char* nextWord(const char* at, const char* end, const Column& column,
                     const LineReader& lines) {
  at = skipBlanks(at, end);
  if (at == end) lines.fail("the line ends where " + shown(column.name) + " should follow");
  return at;
}

/// NaN and infinity as older C libraries of Windows print them: `-1.#IND`, `1.#QNAN0`, `1.#INF`.
bool isNotFinite(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  if (!word.starts_with("1.#")) return false;
  word.remove_prefix(3);
  while (word.ends_with('0')) word.remove_suffix(1);
  return word == "IND" || word == "QNAN" || word == "SNAN" || word == "INF";
}

std::size_t listLength(const char*& at, const char* end, const Column& column,
                       const LineReader& lines) {
  const char* const begin = nextWord(at, end, column, lines);
  at = skipWord(begin, end);
  const std::string_view word(begin, static_cast<std::size_t>(at - begin));
  const auto count = parseCount(word);
  if (!count) {
    lines.fail("the length of " + shown(column.name) + " is " + shown(word) +
               "; it must be a whole number from 0 to 9e15");
  }
  return static_cast<std::size_t>(*count);
}

}  // namespace

const char* skipBlanks(const char* at, const char* end) {
  while (at != end && (*at == ' ' || *at == '\t')) ++at;
  return at;
}

double readNumber(const char*& at, const char* end, std::string_view separators,
                  std::string_view name, const LineReader& lines) {
  const char* begin = at;
  // from_chars knows no plus sign, people do.
  if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
  double value = 0.0;
  const auto result = doubleFrom(begin, end, value);
  const auto isSeparator = [&](char c) { return separators.find(c) != std::string_view::npos; };
  if (result.ec != std::errc{} || (result.ptr != end && !isSeparator(*result.ptr))) {
    const std::string_view word(at,
                                static_cast<std::size_t>(std::find_if(at, end, isSeparator) - at));
    if (isNotFinite(word)) {
      at += word.size();
      return std::numeric_limits<double>::quiet_NaN();
    }
    lines.fail(std::string(name) + " is " + shown(word) +
               "; it must be a number that a double can hold");
  }
  at = result.ptr;
  return value;
}

Eigen::Vector3d readRow(const LineReader& lines, std::span<const Column> columns) {
  const char* at = lines.line().data();
  const char* const end = at + lines.line().size();
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (const Column& column : columns) {
    if (column.axis >= 0) {
      at = nextWord(at, end, column, lines);
      point[column.axis] = readNumber(at, end, kRowBlanks, column.name, lines);
      continue;
    }
    std::size_t count = column.isList ? listLength(at, end, column, lines) : column.repeat;
    for (; count > 0; --count) at = skipWord(nextWord(at, end, column, lines), end);
  }
  at = skipBlanks(at, end);
  if (at != end) {
    const char* const wordEnd = skipWord(at, end);
    lines.fail(shown({at, static_cast<std::size_t>(wordEnd - at)}) +
               " follows the last value of the line");
  }
  return point;
}

}  // namespace swept::detail
