// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "output/terminal.hpp"

namespace swept {

/// Rows of text in aligned columns, two blanks apart. Columns of numbers are set flush right.
class TextTable {
 public:
  struct Column {
    std::string title;
    bool number = false;
  };
  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  /// One line per row below the line of titles. If lines must not be longer than `columns`, one of
  /// three layouts is used, whichever is shortest. Titles and text are broken over several lines,
  /// at blanks and after commas. Or the columns of numbers are divided among several tables. Or the
  /// first cell of each row stands above the others, each after its title. Words and numbers stay
  /// whole, however long.
  std::string text(std::optional<std::size_t> columns = columnsOf(Stream::Out)) const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace swept
