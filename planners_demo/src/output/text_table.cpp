// SPDX-License-Identifier: BSD-3-Clause
#include "output/text_table.hpp"

#include <algorithm>
#include <cstddef>

#include "output/terminal_text.hpp"

namespace swept {

std::string TextTable::text() const {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    widths.push_back(columns_[c].title.size());
    for (const auto& row : rows_) widths[c] = std::max(widths[c], escapedLine(row.at(c)).size());
  }
  std::string result;
  const auto addLine = [&](auto cellOf) {
    std::string line;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::string cell = cellOf(c);
      const std::string blanks(widths[c] - cell.size(), ' ');
      line.append(c == 0 ? "" : "  ").append(columns_[c].number ? blanks + cell : cell + blanks);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + "\n";
  };
  addLine([&](std::size_t c) { return columns_[c].title; });
  for (const auto& row : rows_) addLine([&](std::size_t c) { return escapedLine(row[c]); });
  return result;
}

}  // namespace swept
