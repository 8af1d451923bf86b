// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <map>
#include <optional>

#include "batch/ranks.hpp"
#include "batch/results_file.hpp"
#include "batch/results_header.hpp"
#include "batch/results_output.hpp"
#include "batch/worker_pool.hpp"
#include "command_line/commands.hpp"
#include "input/problem_choice.hpp"
#include "output/progress.hpp"
#include "planning/planning.hpp"

namespace swept {
namespace {

/// The runs of a command, and the place of their results.
class BatchRun {
 public:
  /// Of an MPI job's processes, only the one with rank 0 prints.
  BatchRun(const Arguments& args, int rank)
      : args_(args), warnings_(rank > 0 ? Warnings::none() : Warnings(args.quiet)) {
    batch_.args = &args;
    batch_.model = loadModel(args, warnings_);
    batch_.group = chooseGroup(*batch_.model.robot, args).name;
    batch_.problems = std::make_shared<const ProblemFile>(ProblemFile::load(args.problems));
    keys_ = args.batch.fromStdin ? readRuns(std::cin, "<stdin>", *batch_.problems, args)
                                 : listRuns(*batch_.problems, args);
    std::vector<ProblemChoice> chosen;
    for (const RunKey& key : keys_) chosen.push_back({.set = key.set, .index = key.index});
    requireBodiesOfRules(args, batch_.model, *batch_.problems, chosen);
    header_ = resultsHeader(batch_);
  }

  const std::vector<RunKey>& keys() const { return keys_; }

  ExitCode run() {
    routePlannerMessages(false);
    if (const std::optional<int> rank = mpiRank()) {
      runOnRanks({.work = [this](const WorkerLink& link) { runShare(link); },
                  .open = [this] { return open(); },
                  .take = [this](const std::string& line) { take(resultOfLine(line)); },
                  .warn = [this](const std::string& line) { warnings_(line); }});
      return ExitCode::Free;
    }
    const std::vector<std::size_t> places = open();
    const Interrupt interrupt;
    ProgressBar bar("runs", results_.size(), keys_.size(), args_.quiet);
    WorkerPool pool(interrupt, batch_, keys_, hardLimitOf(args_));
    const bool complete = pool.run(places, args_.jobs,
                                   {.done = [&](const RunResult& result) { take(result); },
                                    .warning = [&](const std::string& line) { warnings_(line); },
                                    .tick = [&] { bar.draw(results_.size()); }});
    return complete ? ExitCode::Free : ExitCode::Interrupted;
  }

  /// A file of half a batch would look like that of a whole one.
  void report(bool complete) const {
    if (args_.batch.fromStdin) return;
    printResults(args_, header_, results_);
    if (complete) writeOutputs(args_, header_, results_);
  }

 private:
  /// Takes over the results in the file, and returns the remaining runs, as places in the keys.
  std::vector<std::size_t> open() {
    if (!args_.output.empty()) {
      file_.emplace(args_.output, header_, warnings_);
      header_ = file_->header();
    }
    if (args_.batch.fromStdin) printLine(header_);
    std::map<RunKey, const RunResult*> known;
    if (file_)
      for (const RunResult& result : file_->runs()) known.emplace(result.key, &result);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      if (const auto found = known.find(keys_[i]); found != known.end())
        results_.push_back(*found->second);
      else
        places.push_back(i);
    }
    return places;
  }

  /// A rank's share of the runs, done in a separate process.
  void runShare(const WorkerLink& link) {
    std::vector<std::size_t> places;
    while (const auto place = link.nextRun()) places.push_back(*place);
    const Interrupt interrupt;
    WorkerPool pool(interrupt, batch_, keys_, hardLimitOf(args_));
    const bool complete = pool.run(
        places, args_.jobs,
        {.done =
             [&](const RunResult& result) {
               link.say(WorkerMessage::Kind::Result, lineOf(resultJson(result)));
             },
         .warning = [&](const std::string& line) { link.say(WorkerMessage::Kind::Warning, line); },
         .tick = [] {}});
    if (!complete) throw UsageError("stopped by a signal");
  }

  void take(const RunResult& result) {
    results_.push_back(result);
    if (file_) file_->append(result);
    if (args_.batch.fromStdin) printLine(resultJson(result));
  }

  static void printLine(const Json& json) {
    if (!(std::cout << lineOf(json) << '\n' << std::flush))
      throw UsageError("cannot write to standard output");
  }

  const Arguments& args_;
  Warnings warnings_;
  Batch batch_;
  std::vector<RunKey> keys_;
  Json header_;
  std::optional<ResultsFile> file_;
  std::vector<RunResult> results_;
};

void checkOptions(const Arguments& args) {
  const BatchArguments& batch = args.batch;
  if (batch.list && batch.fromStdin) throw UsageError("--list and --stdin cannot be combined");
  if (batch.fromStdin && mpiRank())
    throw UsageError("--stdin and MPI cannot be combined: stdin is that of rank 0 only");
  const bool lines = batch.list || batch.fromStdin;
  const std::string option = batch.list ? "--list" : "--stdin";
  if (lines && !args.output.empty()) throw UsageError(option + " and -o cannot be combined");
  if (lines && (args.json || !batch.log.empty() || !batch.csv.empty()))
    throw UsageError(option + " prints lines; --json, --log and --csv are for `bench summary`");
}

}  // namespace

ExitCode runBenchPlanners(const Arguments& args) {
  checkOptions(args);
  const int rank = mpiRank().value_or(0);
  if (rank == 0) requireOutputs(args);
  BatchRun batch(args, rank);
  if (args.batch.list) {
    if (rank > 0) return ExitCode::Free;
    for (const RunKey& key : batch.keys()) std::cout << lineOf(keyJson(key)) << '\n';
    return ExitCode::Free;
  }
  const ExitCode code = batch.run();
  if (rank == 0) batch.report(code == ExitCode::Free);
  return code;
}

}  // namespace swept
