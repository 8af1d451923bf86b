// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "site.hpp"

namespace swept::answers {

/// What the command line says.
struct Options {
  std::int64_t count = 1'000'000;  ///< of questions, those that are asked once not among them
  std::uint64_t seed = 1;
  std::string robots = ".";     ///< regular expression
  unsigned threads = 0;         ///< 0: as many as there are processors
  std::string target;           ///< of Highway; empty: the widest
  std::filesystem::path out;    ///< empty: standard output
  std::filesystem::path each;   ///< empty: not written
  std::filesystem::path extra;  ///< robots and scenes; empty: none
  std::string only;             ///< ROBOT/SCENE/KIND/INDEX; empty: all
};

/// Of verdicts.
struct Tally {
  std::int64_t questions = 0, free = 0, collision = 0, undecided = 0;
};

/// Of motions and of everything.
struct Totals {
  Tally all, motions;
};

/// Asks all questions and writes what is answered.
Totals record(const Options& options, const std::vector<Place>& places, std::ostream& lines,
              std::ostream* each);

/// Prints the one question that `options.only` names. Throws std::invalid_argument where there is
/// no such question.
void askOnly(const Options& options, const std::vector<Place>& places, std::ostream& text);

}  // namespace swept::answers
