// SPDX-License-Identifier: BSD-3-Clause
// Prints the table of extremes; with --csv FILE, writes it there as well.
#include <fstream>
#include <iostream>
#include <string_view>

#include "table.hpp"

int main(int count, char** arguments) {
  using namespace extremes;
  const bool csv = count == 3 && std::string_view(arguments[1]) == "--csv";
  if (count != 1 && !csv) {
    std::cerr << "usage: extremes [--csv FILE]\n";
    return 2;
  }
  const std::vector<Row> rows = measured();
  std::cout << markdown(rows);
  for (const Row& row : rows) {
    if (!row.failure.empty()) std::cerr << row.query << ", " << row.name << ":\n" << row.failure;
  }
  if (!csv) return 0;
  std::ofstream file(arguments[2]);
  file << commaSeparated(rows);
  if (file.flush()) return 0;
  std::cerr << arguments[2] << " cannot be written\n";
  return 1;
}
