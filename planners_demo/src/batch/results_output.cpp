// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_output.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "batch/results_csv.hpp"
#include "batch/results_log.hpp"
#include "batch/results_table.hpp"
#include "command_line/exit_code.hpp"
#include "output/terminal_text.hpp"
#include "output/whole_file.hpp"

namespace swept {

void requireOutputs(const Arguments& args) {
  if (!args.batch.csv.empty()) requireWritable(args.batch.csv);
  if (args.batch.log.empty()) return;
  std::error_code error;
  std::filesystem::create_directory(args.batch.log, error);
  if (error)
    throw UsageError("cannot make the folder '" + args.batch.log + "': " + error.message());
  requireWritable(std::filesystem::path(args.batch.log) / "any.log");
}

void printResults(const Arguments& args, const Json& header, std::vector<RunResult> results) {
  std::ranges::sort(results, {}, &RunResult::key);
  const std::vector<TableRow> rows = tableRows(results);
  if (!args.json) {
    printText(tableText(rows));
    return;
  }
  Json json = {{"header", header}, {"runs", results.size()}, {"rows", tableJson(rows)}};
  std::cout << dumped(json) << '\n';
}

void writeOutputs(const Arguments& args, const Json& header, std::vector<RunResult> results) {
  std::ranges::sort(results, {}, &RunResult::key);
  if (!args.batch.csv.empty()) writeWholeFile(args.batch.csv, csvText(results));
  if (args.batch.log.empty()) return;
  for (const ExperimentLog& log : experimentLogs(header, results))
    writeWholeFile(std::filesystem::path(args.batch.log) / (log.name + ".log"), log.text);
}

}  // namespace swept
