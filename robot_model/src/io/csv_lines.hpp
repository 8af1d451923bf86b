// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/group_columns.hpp"

/// Tables of numbers below a line of names, with commas between.
namespace swept::detail {

/// Reads line by line, and skips lines of blanks.
class CsvLines {
 public:
  explicit CsvLines(std::string_view text);
  bool next();
  std::string_view text() const { return text_; }
  int line() const { return line_; }

 private:
  std::string_view rest_, text_;
  int line_ = 0;
};

/// The cells of a line of names, which may be in quotes.
std::vector<std::string> csvNames(std::string_view line, const FailAt& fail);
/// The cells of a line of values, without blanks around them.
std::vector<std::string_view> csvValues(std::string_view line);

/// The number in the i-th cell, whose column has that name.
double csvNumber(std::string_view cell, std::size_t i, const std::string& name, const FailAt& fail);
/// Fails unless there are as many cells as names.
void requireCsvCells(std::size_t cells, std::size_t names, const FailAt& fail);
/// Fails for a first line of values.
void requireCsvNames(const std::vector<std::string>& names, const FailAt& fail);

/// What messages call a column: `column 3 `, or with its name `column 3, elbow, `.
std::string csvColumn(std::size_t i, const std::string& name = {});

}  // namespace swept::detail
