// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "row.hpp"

namespace extremes {

/// As the README has it.
std::string markdown(const std::vector<Row>& rows);
std::string commaSeparated(const std::vector<Row>& rows);

/// Cells of a row, by the names of its columns.
using Cells = std::map<std::string, std::string>;
using Table = std::map<std::pair<std::string, std::string>, Cells>;
Table cellsByName(const std::vector<Row>& rows);
/// The table between the markers of a README, by query and case.
Table readTable(const std::filesystem::path& readme);

}  // namespace extremes
