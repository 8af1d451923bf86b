// SPDX-License-Identifier: BSD-3-Clause
#include "table.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "core/rounded_up.hpp"

namespace extremes {

namespace {

using swept::test::roundedUp;

constexpr std::size_t kColumns = 14;
constexpr std::array<const char*, kColumns> kHeads = {
    "query",         "case",  "n",      "apart",   "right", "undecided",    "wrong",
    "largest error", "bound", "honest", "counted", "work",  "work at most", "time"};

std::string decimal(double x) {
  char text[32];
  std::snprintf(text, sizeof text, x < 9.95 ? "%.1f" : "%.0f", x);
  return text;
}

std::array<std::string, kColumns> cellsOf(const Row& row) {
  const std::string none = "–";
  return {row.query,
          row.name,
          std::to_string(row.n),
          std::to_string(row.apart),
          std::to_string(row.right),
          std::to_string(row.undecided),
          std::to_string(row.wrong + row.far),
          row.hasBound ? roundedUp(row.error) : none,
          row.hasBound ? roundedUp(row.bound) : none,
          row.honest ? "yes" : "no",
          row.countsWork && row.isOrdinary() ? std::to_string(row.work) : none,
          row.countsWork ? decimal(row.workRatio) : none,
          row.countsWork ? decimal(row.workLimit) : none,
          decimal(row.timeRatio)};
}

template <class Cells>
std::string joined(const Cells& cells, const std::string& between) {
  std::string line;
  for (const auto& cell : cells) {
    if (!line.empty()) line += between;
    line += cell;
  }
  return line;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line.substr(line.find('|') + 1));
  for (std::string cell; std::getline(stream, cell, '|');) {
    const auto first = cell.find_first_not_of(' ');
    const auto last = cell.find_last_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

}  // namespace

std::string markdown(const std::vector<Row>& rows) {
  std::string text = "| " + joined(kHeads, " | ") + " |\n|---|---";
  for (std::size_t i = 2; i < kColumns; ++i) text += "|--:";
  text += "|\n";
  for (const Row& row : rows) text += "| " + joined(cellsOf(row), " | ") + " |\n";
  return text;
}

std::string commaSeparated(const std::vector<Row>& rows) {
  const auto quoted = [](const std::string& cell) { return '"' + cell + '"'; };
  std::string text = joined(kHeads, ",") + "\n";
  for (const Row& row : rows) {
    std::array<std::string, kColumns> cells = cellsOf(row);
    cells[1] = quoted(cells[1]);
    text += joined(cells, ",") + "\n";
  }
  return text;
}

Table cellsByName(const std::vector<Row>& rows) {
  Table table;
  for (const Row& row : rows) {
    const auto cells = cellsOf(row);
    Cells& named = table[{row.query, row.name}];
    for (std::size_t i = 0; i < kColumns; ++i) named[kHeads[i]] = cells[i];
  }
  return table;
}

Table readTable(const std::filesystem::path& readme) {
  Table rows;
  std::ifstream file(readme);
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("<!-- /extremes-table")) break;
    const std::vector<std::string> cells = split(line);
    if (inside && line.starts_with("|") && cells.size() == kColumns && cells[0] != kHeads[0] &&
        !line.starts_with("|--")) {
      Cells& row = rows[{cells[0], cells[1]}];
      for (std::size_t i = 0; i < kColumns; ++i) row[kHeads[i]] = cells[i];
    }
    inside |= line.starts_with("<!-- extremes-table");
  }
  return rows;
}

}  // namespace extremes
