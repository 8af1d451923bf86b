// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/robot_model/checker.hpp"

namespace CLI {
class App;
}

namespace swept {

/// Adds `--dump`.
void addDumpOption(CLI::App& app, Arguments& args);

/// Writes queries that are not free as files that `swept replay` asks again: into the folder of
/// --dump, else of SWEPT_DUMP_DIR; without either nowhere. A file is named after what is in it, so
/// that the same query is there once, whichever process asked it.
class QueryDump {
 public:
  /// Throws UsageError where the folder is not one that can be written to; it is made if there is
  /// none. Likewise for names of files, and other options, that are not UTF-8.
  explicit QueryDump(const Arguments& args);
  /// Throws UsageError for names of the group and its variables that are not UTF-8: better before
  /// the work than at the first answer that is to be written.
  void requireNames(const Checker& checker) const;

  /// Configurations are as the checker takes them: beside objects that move with their time.
  void state(const Checker& checker, const std::string& label, const std::vector<double>& q,
             Verdict verdict);
  void motion(const Checker& checker, const std::string& label, const std::vector<double>& from,
              const std::vector<double>& to, const MotionCertificate& certificate);

  /// What was typed in place of states is not to be read again: the first state stands for it.
  void setFirstState(const LabelledState& state);
  /// The answers from now on are in the world of this problem.
  void setProblem(const std::string& set, int index);

  /// Says on stderr how many were written, if any.
  void announce() const;

 private:
  void write(const Checker& checker, const std::string& label,
             const std::vector<std::vector<double>>& states, const MotionCertificate& found);

  Arguments args_;
  std::string folder_;  ///< empty: none
  std::string where_;   ///< the folder for messages, with the option that names it
  int written_ = 0;
};

}  // namespace swept
