// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/robot_model/problems.hpp"

namespace swept {

/// Which problem of a file.
struct ProblemChoice {
  std::string set;
  int index = 0;
};

/// The problem of a file that was read as `name`. Throws InputError, naming the sets there are.
PlanningProblem chosenProblem(const ProblemFile& file, const std::string& name,
                              const std::string& set, int index);

/// Those that --set, --every and --limit leave, in the order of the file: one or more. Throws
/// UsageError or InputError, naming the sets there are.
std::vector<ProblemChoice> chosenProblems(const ProblemFile& file, const Arguments& args);

/// Throws UsageError for a rule of the command line that names no link, no attached body, and no
/// body of the world of any of these.
void requireBodiesOfRules(const Arguments& args, const Model& model, const ProblemFile& file,
                          const std::vector<ProblemChoice>& chosen);

/// States come from the command line, or from --problems, or from --request, and a problem has its
/// own world. Throws UsageError.
void requireOneSource(const Arguments& args);

}  // namespace swept
