// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "io/json_value.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/problems.hpp"

namespace swept {

/// One run of a batch. With the batch's header it determines the result, except for times.
struct RunKey {
  std::string set;
  int index = 0;          ///< of the problem in the set
  std::string planner;    ///< as plannerName() returns it
  std::string validator;  ///< as Validator::name() returns it
  int run = 1;            ///< from 1
  std::uint32_t seed = 1;

  auto operator<=>(const RunKey&) const = default;
};

/// The seed of a run: `first` for run 1, one more for each next run. After the largest comes 1.
std::uint32_t seedOfRun(std::uint32_t first, int run);

/// All runs that the command line asks for, ordered by problem, then planner, validator and run.
/// Throws UsageError or InputError for a name that does not exist, and lists those that do.
std::vector<RunKey> listRuns(const ProblemFile& problems, const Arguments& args);

/// The runs in a text with a JSON object per line, as `--list` prints them. Throws InputError,
/// naming `source`, line and field, for anything else, for a run that occurs twice, and for what
/// listRuns refuses.
std::vector<RunKey> readRuns(std::istream& text, const std::string& source,
                             const ProblemFile& problems, const Arguments& args);

/// A line of a file that has a JSON object per line. Throws InputError.
nlohmann::json parseJsonLine(const std::string& line, const std::string& source, int number);

/// The fields of a key in their order.
Json keyJson(const RunKey& key);
/// Throws InputError. Does not check that the problem, planner or validator exists.
RunKey keyOf(const JsonValue& json);

/// `shelf 3 RRTConnect certified, run 1, seed 1`.
std::string keyText(const RunKey& key);

}  // namespace swept
