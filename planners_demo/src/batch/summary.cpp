// SPDX-License-Identifier: BSD-3-Clause
#include <map>

#include "batch/results_file.hpp"
#include "batch/results_header.hpp"
#include "batch/results_output.hpp"
#include "command_line/commands.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

ExitCode runBenchSummary(const Arguments& args) {
  requireOutputs(args);
  Warnings warnings(args.quiet);
  Results all;
  std::map<RunKey, std::pair<std::string, std::string>> known;  // file and line
  for (const std::string& file : args.batch.files) {
    const Results some = readResults(file, warnings);
    if (some.header.is_null()) throw InputError(file, 0, "the file has no header");
    if (all.header.is_null()) all.header = some.header;
    requireSameHeader(some.header, file, all.header, "in '" + args.batch.files.front() + "'");
    for (const RunResult& run : some.runs) {
      const std::string line = lineOf(resultJson(run));
      const auto [place, isNew] = known.try_emplace(run.key, file, line);
      if (!isNew && place->second.second != line)
        throw InputError(
            file, 0,
            "another result than in '" + place->second.first + "' of the run " + keyText(run.key));
      if (isNew) all.runs.push_back(run);
    }
  }
  printResults(args, all.header, all.runs);
  writeOutputs(args, all.header, all.runs);
  return ExitCode::Free;
}

}  // namespace swept
