// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "output/text_output.hpp"
#include "page/page_content.hpp"

/// Paths that were written to files, for pages.
namespace swept {

/// The states of a path file, each within the limits. Throws InputError.
std::vector<std::vector<double>> pathStates(const Json& path, const Checker& checker,
                                            const std::string& file);

/// Several paths of one robot in one world, for `view`.
struct PathsToView {
  Model model;
  std::shared_ptr<const Checker> checker;
  PageContent content;
};

/// Throws UsageError, with `why` behind its name, for an option whose value a path file has: a page
/// of other rules would be about another question.
void refuseRules(const Arguments& args, const std::string& why);

/// Whether the states of `view` are path files: `.json`. Throws UsageError when some are not, and
/// for what is a path in another format.
bool namesPaths(const Arguments& args);

/// Reads the files that each path names, with the robot of the command line, and with its scene if
/// that has one, and certifies the paths anew. Throws InputError, naming the path and what differs,
/// unless robot, world and rules are those that each was written for, and the same for all;
/// UsageError for options that path files have values of.
PathsToView pathsToView(const Arguments& args, Warnings& warnings);

}  // namespace swept
