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

/// One run of a batch: with the batch's header, all that its result depends on but for time.
struct RunKey {
  std::string set;
  int index = 0;          ///< of the problem in the set
  std::string planner;    ///< as plannerName() returns it
  std::string validator;  ///< as Validator::name() returns it
  int run = 1;            ///< from 1
  std::uint32_t seed = 1;

  auto operator<=>(const RunKey&) const = default;
};

/// Of run 1 it is `first`, of the next one more, ...; after the largest comes 1.
std::uint32_t seedOfRun(std::uint32_t first, int run);

/// All that the command line asks for, by problem, then planner, validator and run. Throws
/// UsageError or InputError for what is not there, naming what is.
std::vector<RunKey> listRuns(const ProblemFile& problems, const Arguments& args);

/// The runs of text, a JSON object per line as `--list` prints them. Throws InputError naming
/// `source`, line and field: for anything else, a run that comes twice, and what listRuns refuses.
std::vector<RunKey> readRuns(std::istream& text, const std::string& source,
                             const ProblemFile& problems, const Arguments& args);

/// A line of a file that has a JSON object per line. Throws InputError.
nlohmann::json parseJsonLine(const std::string& line, const std::string& source, int number);

/// The fields of a key in their order.
Json keyJson(const RunKey& key);
/// Throws InputError. Says nothing about whether there is such a problem, planner or validator.
RunKey keyOf(const JsonValue& json);

/// `shelf 3 RRTConnect certified, run 1, seed 1`.
std::string keyText(const RunKey& key);

}  // namespace swept
