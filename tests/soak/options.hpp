// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenario.hpp"

namespace soak {

/// One query, to be asked again.
struct Question {
  std::string world;         ///< see WorldKey
  std::vector<double> from;  ///< of the group, rad or m
  std::vector<double> to;    ///< empty: `from` is a state to be checked
  bool verdictOnly = false;
};

struct Options {
  std::int64_t states = 100'000'000;
  std::int64_t motions = 10'000'000;
  int threads = 8;
  std::int64_t updates = 20'000;
  std::uint64_t seed = 1;
  int sampleOneIn = 10'000;
  double growth = 2.0;  ///< MiB, of memory
  ScenarioFiles files;  ///< no robot: those of models/
  double margin = 0.0;  ///< m, of that robot
  std::optional<Question> question;
};

/// Reads the command line, or prints help or an error that names option, value and what is allowed;
/// then `exitCode` is what the program is to end with: 0, or 3.
struct ParsedOptions {
  Options options;
  std::optional<int> exitCode;
};
ParsedOptions parseOptions(int argc, const char* const* argv);

}  // namespace soak
