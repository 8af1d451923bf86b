// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "batch/run_result.hpp"

namespace swept {

/// A row per run below a header with units. A cell with a comma, a quote or a line break is in
/// quotes, with quotes in it doubled. A missing value is an empty cell.
std::string csvText(const std::vector<RunResult>& results);

}  // namespace swept
