// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/robot_model/problems.hpp"

namespace swept {

/// Selects a problem of a file.
struct ProblemChoice {
  std::string set;
  int index = 0;
};

/// The selected problem of a file that was read as `name`. Throws InputError, which names the sets
/// of the file.
PlanningProblem chosenProblem(const ProblemFile& file, const std::string& name,
                              const std::string& set, int index);

/// The problems that --set, --every and --limit select, in the order of the file: one or more.
/// Throws UsageError or InputError, which names the sets of the file.
std::vector<ProblemChoice> chosenProblems(const ProblemFile& file, const Arguments& args);

/// Throws UsageError for a rule of the command line that names no link, no attached body, and no
/// body of the world of any of these.
void requireBodiesOfRules(const Arguments& args, const Model& model, const ProblemFile& file,
                          const std::vector<ProblemChoice>& chosen);

/// States come from the command line, or from --problems, or from --request, and a problem has its
/// own world. Throws UsageError.
void requireOneSource(const Arguments& args);

}  // namespace swept
