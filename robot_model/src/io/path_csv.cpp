// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <vector>

#include "io/csv_lines.hpp"
#include "io/path_formats.hpp"

namespace swept::detail {

void readCsvPath(const std::string& text, const InputSource& source, PathRows& rows) {
  CsvLines lines(text);
  const FailAt fail = [&](const std::string& message) { source.fail(lines.line(), message); };
  if (!lines.next())
    source.fail(0, "it is empty; its first line must have the names of the joints");
  const std::vector<std::string> names = csvNames(lines.text(), fail);
  requireCsvNames(names, fail);
  rows.setColumns(
      names, [&](std::size_t i, const std::string& message) { fail(csvColumn(i) + message); },
      fail);
  std::vector<double> values(names.size());
  while (lines.next()) {
    const auto cells = csvValues(lines.text());
    for (std::size_t i = 0; i < std::min(cells.size(), names.size()); ++i)
      values[i] = csvNumber(cells[i], i, names[i], fail);
    requireCsvCells(cells.size(), names.size(), fail);
    rows.add(values, lines.line(), fail, false);
  }
  if (rows.states().empty()) source.fail(0, "it has no line of values below that of the names");
}

}  // namespace swept::detail
