// SPDX-License-Identifier: BSD-3-Clause
#include "output/text_table.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "output/line_breaks.hpp"
#include "output/terminal_text.hpp"

namespace swept {
namespace {

constexpr std::size_t kGap = 2;  // blanks between columns

using Cells = std::vector<std::string>;
using Widths = std::vector<std::size_t>;

struct Grid {
  std::vector<TextTable::Column> columns;
  std::vector<Cells> rows;  ///< escaped; the first has the titles
};

std::size_t longestWord(const std::string& text, bool atCommas) {
  std::size_t longest = 0;
  for (const std::string& word : brokenCell(text, 1, atCommas))
    longest = std::max(longest, widthOf(word));
  return longest;
}

/// Titles may be broken, and cells that hold no number.
bool mayBreak(const Grid& grid, const Cells& row, std::size_t c) {
  return &row == &grid.rows.front() || !grid.columns[c].number;
}

/// Of the rows from `first` on.
Widths naturalWidths(const Grid& grid, std::size_t first) {
  Widths widths(grid.columns.size());
  for (std::size_t r = first; r < grid.rows.size(); ++r)
    for (std::size_t c = 0; c < widths.size(); ++c)
      widths[c] = std::max(widths[c], widthOf(grid.rows[r][c]));
  return widths;
}

Widths leastWidths(const Grid& grid) {
  Widths widths(grid.columns.size());
  for (const Cells& row : grid.rows)
    for (std::size_t c = 0; c < row.size(); ++c)
      widths[c] =
          std::max(widths[c], mayBreak(grid, row, c) ? longestWord(row[c], true) : widthOf(row[c]));
  return widths;
}

std::size_t lineOf(const Widths& widths) {
  return std::accumulate(widths.begin(), widths.end(), std::size_t{0}) + kGap * (widths.size() - 1);
}

/// What is left of the line goes to those that want more, as wide as `wanted`, the narrowest first.
Widths fittedWidths(const Widths& wanted, Widths widths, std::size_t columns) {
  for (std::size_t spare = columns - lineOf(widths); spare > 0; --spare) {
    std::size_t narrowest = widths.size();
    for (std::size_t c = 0; c < widths.size(); ++c)
      if (widths[c] < wanted[c] && (narrowest == widths.size() || widths[c] < widths[narrowest]))
        narrowest = c;
    if (narrowest == widths.size()) break;
    ++widths[narrowest];
  }
  return widths;
}

std::string aligned(const Grid& grid, const Widths& widths) {
  std::string text;
  for (const Cells& row : grid.rows) {
    std::vector<Cells> broken;
    std::size_t height = 1;
    for (std::size_t c = 0; c < row.size(); ++c) {
      broken.push_back(mayBreak(grid, row, c) ? brokenCell(row[c], widths[c], true)
                                              : Cells{row[c]});
      height = std::max(height, broken.back().size());
    }
    for (std::size_t i = 0; i < height; ++i) {
      std::string line;
      for (std::size_t c = 0; c < row.size(); ++c) {
        const std::string cell = i < broken[c].size() ? broken[c][i] : "";
        const std::string blanks(widths[c] - std::min(widths[c], widthOf(cell)), ' ');
        line.append(c == 0 ? 0 : kGap, ' ')
            .append(grid.columns[c].number ? blanks + cell : cell + blanks);
      }
      line.erase(line.find_last_not_of(' ') + 1);
      text += line + "\n";
    }
  }
  return text;
}

/// `title: value`, in pieces that stay whole. The pieces of a number are not parted from it.
Cells piecesOf(const std::string& title, const std::string& cell, bool number) {
  Cells pieces = brokenCell(title, 1, false);
  if (number) {
    pieces.back() += ": " + cell;
    return pieces;
  }
  pieces.back() += ":";
  const Cells words = brokenCell(cell, 1, true);
  pieces.insert(pieces.end(), words.begin(), words.end());
  return pieces;
}

/// The first cell of each row, and below it the others that are not empty, one after the other.
std::string stacked(const Grid& grid, std::size_t columns) {
  const Cells& titles = grid.rows.front();
  std::string text;
  for (std::size_t r = 1; r < grid.rows.size(); ++r) {
    const Cells& row = grid.rows[r];
    if (!row.front().empty()) text += titles.front() + " " + row.front() + "\n";
    Cells pieces;
    for (std::size_t c = 1; c < row.size(); ++c) {
      if (row[c].empty()) continue;
      if (!pieces.empty()) pieces.back() += ";";
      std::ranges::copy(piecesOf(titles[c], row[c], grid.columns[c].number),
                        std::back_inserter(pieces));
    }
    std::string line(kGap - 1, ' ');
    for (const std::string& piece : pieces) {
      if (line.size() >= kGap && widthOf(line) + 1 + widthOf(piece) > columns) {
        text += line + "\n";
        line.assign(kGap - 1, ' ');
      }
      line += " " + piece;
    }
    if (!pieces.empty()) text += line + "\n";
  }
  return text;
}

/// Those columns of it.
Grid part(const Grid& grid, const std::vector<std::size_t>& columns) {
  Grid some{.columns = {}, .rows = std::vector<Cells>(grid.rows.size())};
  for (const std::size_t c : columns) {
    some.columns.push_back(grid.columns[c]);
    for (std::size_t r = 0; r < grid.rows.size(); ++r) some.rows[r].push_back(grid.rows[r][c]);
  }
  return some;
}

/// One below the other, tables of some of the numbers each, with the columns in front of them
/// repeated. Empty where there are texts behind numbers, or no room.
std::string parted(const Grid& grid, std::size_t columns) {
  std::size_t keys = grid.columns.size();
  while (keys > 0 && grid.columns[keys - 1].number) --keys;
  if (keys == 0) return {};
  const Widths least = leastWidths(grid);
  std::string text;
  for (std::size_t next = keys; next < least.size();) {
    std::vector<std::size_t> some(keys);
    std::iota(some.begin(), some.end(), std::size_t{0});
    std::size_t width = lineOf(Widths(least.begin(), least.begin() + static_cast<int>(keys)));
    while (next < least.size() && width + kGap + least[next] <= columns) {
      width += kGap + least[next];
      some.push_back(next++);
    }
    if (some.size() == keys) return {};
    const Grid table = part(grid, some);
    text += (text.empty() ? "" : "\n") +
            aligned(table, fittedWidths(naturalWidths(table, 0), leastWidths(table), columns));
  }
  return text;
}

}  // namespace

std::string TextTable::text(std::optional<std::size_t> columns) const {
  Grid grid{.columns = columns_, .rows = {{}}};
  for (const Column& column : columns_) grid.rows.front().push_back(column.title);
  for (const Cells& row : rows_) {
    grid.rows.emplace_back();
    for (std::size_t c = 0; c < columns_.size(); ++c)
      grid.rows.back().push_back(escapedLine(row.at(c)));
  }
  const Widths natural = naturalWidths(grid, 0), least = leastWidths(grid);
  if (!columns || lineOf(natural) <= *columns) return aligned(grid, natural);
  std::vector<std::string> layouts{parted(grid, *columns), stacked(grid, *columns)};
  if (lineOf(least) <= *columns) {
    // Titles are there once, and can do with several lines.
    const Widths forRows = fittedWidths(naturalWidths(grid, 1), least, *columns);
    layouts.insert(layouts.begin(), aligned(grid, fittedWidths(natural, forRows, *columns)));
  }
  std::erase(layouts, "");
  return *std::ranges::min_element(
      layouts, {}, [](const std::string& layout) { return std::ranges::count(layout, '\n'); });
}

}  // namespace swept
