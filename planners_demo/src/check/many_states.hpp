// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "command_line/arguments.hpp"
#include "command_line/exit_code.hpp"
#include "input/task.hpp"
#include "output/text_output.hpp"
#include "replay/query_dump.hpp"
#include "swept/core/verdict.hpp"

/// Answers about so many states or motions that nobody reads them all: counted, by verdict alone,
/// on as many threads as there are processors. Of those that are not free the first are told in
/// full.
namespace swept {

/// Of those that are not free.
inline constexpr std::size_t kMostTold = 20;

/// How many there are of each verdict.
class VerdictCounts {
 public:
  void add(Verdict verdict);
  std::size_t all() const { return free_ + notFree(); }
  std::size_t notFree() const { return collision_ + violation_ + undecided_; }
  ExitCode code() const;
  /// `200000 states: 150000 free, 49990 in collision, 10 undecided`, of `what` = `state`.
  std::string text(const std::string& what) const;
  /// `and 49980 further states that are not free`, if more than `told` are; else empty.
  std::string furtherText(const std::string& what, std::size_t told) const;
  /// `count`, `free`, `collision`, `undecided`; `violation`, if there is one.
  void addTo(Json& json) const;

 private:
  std::size_t free_ = 0, collision_ = 0, violation_ = 0, undecided_ = 0;
};

/// Whether each state is more than should be printed.
bool areMany(const Task& task);

/// `check` and `motion` of many. Throw UsageError for a page.
ExitCode checkMany(const Arguments& args, const Model& model, const Task& task, QueryDump& dump,
                   const Warnings& warnings);
ExitCode moveThroughMany(const Arguments& args, const Model& model, const Task& task,
                         QueryDump& dump, const Warnings& warnings);

}  // namespace swept
