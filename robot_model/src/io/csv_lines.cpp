// SPDX-License-Identifier: BSD-3-Clause
#include "io/csv_lines.hpp"

#include <algorithm>

#include "swept/robot_model/foreign_text.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::string_view kCsvBlanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kCsvBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kCsvBlanks) - first + 1);
}

/// The text of a cell, which may be in quotes, up to a comma; `rest` begins behind that, and is
/// null at the end of the line.
std::string cellOf(std::string_view& rest, const FailAt& fail) {
  std::string cell;
  std::string_view after = rest.substr(std::min(rest.find_first_not_of(kCsvBlanks), rest.size()));
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

}  // namespace

CsvLines::CsvLines(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);  // a mark of UTF-8
}

bool CsvLines::next() {
  do {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    text_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
  } while (trimmed(text_).empty());
  return true;
}

std::vector<std::string> csvNames(std::string_view line, const FailAt& fail) {
  std::vector<std::string> cells;
  do {
    // Behind a comma at the end of a line is an empty cell, which has a place.
    cells.push_back(cellOf(line, fail));
  } while (line.data() != nullptr);
  return cells;
}

std::vector<std::string_view> csvValues(std::string_view line) {
  std::vector<std::string_view> cells;
  while (line.data() != nullptr) {
    const std::size_t end = std::min(line.find(','), line.size());
    cells.push_back(trimmed(line.substr(0, end)));
    line = end == line.size() ? std::string_view() : line.substr(end + 1);
  }
  return cells;
}

double csvNumber(std::string_view cell, std::size_t i, const std::string& name,
                 const FailAt& fail) {
  const auto value = parseNumber(cell);
  if (!value)
    fail(csvColumn(i, name) + "is '" + foreignText(cell) + "'; it must be a finite number");
  return *value;
}

void requireCsvCells(std::size_t cells, std::size_t names, const FailAt& fail) {
  if (cells != names)
    fail("there are " + std::to_string(cells) + " values; the first line names " +
         std::to_string(names));
}

void requireCsvNames(const std::vector<std::string>& names, const FailAt& fail) {
  if (std::ranges::all_of(names,
                          [](const std::string& name) { return parseNumber(name).has_value(); }))
    fail("the first line has values; it must have the names of the joints");
}

std::string csvColumn(std::size_t i, const std::string& name) {
  return "column " + std::to_string(i + 1) + (name.empty() ? "" : ", " + foreignText(name) + ",") +
         " ";
}

}  // namespace swept::detail
