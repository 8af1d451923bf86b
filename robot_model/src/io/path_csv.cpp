// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "io/path_formats.hpp"
#include "swept/robot_model/foreign_text.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::string_view kBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Reads line by line, and skips lines of blanks.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);  // a mark of UTF-8
  }
  bool next() {
    do {
      if (rest_.empty()) return false;
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      text_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++line_;
    } while (trimmed(text_).empty());
    return true;
  }
  std::string_view text() const { return text_; }
  int line() const { return line_; }

 private:
  std::string_view rest_, text_;
  int line_ = 0;
};

/// The text of a cell, which may be in quotes, up to a comma; `rest` begins behind that, and is
/// null at the end of the line.
std::string cellOf(std::string_view& rest, const FailAt& fail) {
  std::string cell;
  std::string_view after = rest.substr(std::min(rest.find_first_not_of(kBlanks), rest.size()));
  if (after.starts_with('"')) {
    for (after.remove_prefix(1); !after.starts_with('"') || after.starts_with("\"\"");) {
      if (after.empty()) fail("a quote is not closed");
      if (after.front() == '"') after.remove_prefix(1);
      cell += after.front();
      after.remove_prefix(1);
    }
    after.remove_prefix(1);
    const std::size_t comma = std::min(after.find(','), after.size());
    if (!trimmed(after.substr(0, comma)).empty()) fail("text follows the quoted '" + cell + "'");
  } else {
    cell = trimmed(after.substr(0, std::min(after.find(','), after.size())));
  }
  const std::size_t comma = after.find(',');
  rest = comma == std::string_view::npos ? std::string_view() : after.substr(comma + 1);
  return cell;
}

std::vector<std::string> cellsOf(std::string_view line, const FailAt& fail) {
  std::vector<std::string> cells;
  do {
    // Behind a comma at the end of a line is an empty cell, which has a place.
    cells.push_back(cellOf(line, fail));
  } while (line.data() != nullptr);
  return cells;
}

std::string columnText(std::size_t i, const std::string& name) {
  return "column " + std::to_string(i + 1) + (name.empty() ? "" : ", " + foreignText(name) + ",") +
         " ";
}

void setColumns(const std::vector<std::string>& names, PathRows& rows, const FailAt& fail) {
  if (std::ranges::all_of(names,
                          [](const std::string& name) { return parseNumber(name).has_value(); }))
    fail("the first line has values; it must have the names of the joints");
  rows.setColumns(
      names, [&](std::size_t i, const std::string& message) { fail(columnText(i, "") + message); },
      fail);
}

}  // namespace

void readCsvPath(const std::string& text, const InputSource& source, PathRows& rows) {
  Lines lines(text);
  const FailAt fail = [&](const std::string& message) { source.fail(lines.line(), message); };
  if (!lines.next())
    source.fail(0, "it is empty; its first line must have the names of the joints");
  const std::vector<std::string> names = cellsOf(lines.text(), fail);
  setColumns(names, rows, fail);
  std::vector<double> values(names.size());
  while (lines.next()) {
    std::size_t count = 0;
    for (std::string_view rest = lines.text(); rest.data() != nullptr; ++count) {
      const std::size_t end = std::min(rest.find(','), rest.size());
      const std::string_view cell = trimmed(rest.substr(0, end));
      if (count < values.size()) {
        const auto value = parseNumber(cell);
        if (!value)
          fail(columnText(count, names[count]) + "is '" + foreignText(cell) +
               "'; it must be a finite number");
        values[count] = *value;
      }
      rest = end == rest.size() ? std::string_view() : rest.substr(end + 1);
    }
    if (count != values.size())
      fail("there are " + std::to_string(count) + " values; the first line names " +
           std::to_string(values.size()));
    rows.add(values, lines.line(), fail, false);
  }
  if (rows.states().empty()) source.fail(0, "it has no line of values below that of the names");
}

}  // namespace swept::detail
