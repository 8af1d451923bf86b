// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "command_line/arguments.hpp"

namespace swept {

/// --log and --csv.
inline void addResultFileOptions(CLI::App& app, Arguments& args) {
  app.add_option("--log", args.batch.log,
                 "folder: a benchmark log for OMPL's tools per problem, SET_INDEX.log")
      ->type_name("FOLDER");
  app.add_option("--csv", args.batch.csv, "a row per run")->type_name("FILE.csv");
}

}  // namespace swept
