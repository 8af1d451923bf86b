// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <iostream>
#include <mutex>
#include <thread>

#include "input/problem_choice.hpp"
#include "input/states.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/quantile.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/text_table.hpp"
#include "plan/plan_dump.hpp"
#include "plan/plan_sets.hpp"
#include "planning/planning.hpp"

namespace swept {
namespace {

struct Entry {
  std::string set;
  int index = 0;
  PlanOutcome outcome;
};

PlanOutcome solveProblem(const Arguments& args, const Model& model, const ProblemFile& file,
                         const Entry& entry, const Checker& like, const PlanRequest& request,
                         Warnings& warnings) {
  const PlanningProblem problem = file.problem(entry.set, entry.index);
  ProblemStates ends;
  try {
    ends = problemStates(like.robot(), like.group(), problem, std::ref(warnings));
  } catch (const UsageError& error) {
    // One problem with values outside the robot's limits does not end the run.
    PlanOutcome outcome;
    outcome.code = ExitCode::BadInput;
    outcome.failure = error.what();
    return outcome;
  }
  std::vector<LabelledState> states{{.label = "start", .q = ends.start}};
  for (const std::vector<double>& goal : ends.goals) states.push_back({.label = "goal", .q = goal});
  const auto checker =
      makeNextChecker(args, model, like, std::make_shared<const World>(problem.world), warnings);
  warnOfNothing(*checker, warnings);
  return plan(checker, states, request);
}

/// Threads take the next problem when they are done with one. The first exception ends the run.
template <typename Solve>
void runAll(std::vector<Entry>& entries, int jobs, Progress& progress, const Solve& solve) {
  std::atomic<std::size_t> next = 0;
  std::atomic<std::size_t> done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i; (i = next++) < entries.size();) {
      try {
        entries[i].outcome = solve(entries[i]);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = entries.size();
      }
      progress.setLabel(std::to_string(++done) + " of " + std::to_string(entries.size()) +
                        " problems, last " + entries[i].set + " " +
                        std::to_string(entries[i].index));
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int j = 1; j < jobs; ++j) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

/// Planning times are those of the solved problems, s.
struct Summary {
  std::string name;
  std::size_t problems = 0, solved = 0, proven = 0;
  std::vector<double> times;  ///< ascending
};

Summary summarise(const std::string& name, const std::vector<Entry>& entries,
                  const std::string& set) {
  Summary summary;
  summary.name = name;
  for (const Entry& entry : entries) {
    if (!set.empty() && entry.set != set) continue;
    ++summary.problems;
    summary.solved += entry.outcome.solved() ? 1 : 0;
    summary.proven += entry.outcome.proven() ? 1 : 0;
    if (entry.outcome.solved()) summary.times.push_back(entry.outcome.planningTime);
  }
  std::ranges::sort(summary.times);
  return summary;
}

std::vector<Summary> summaries(const std::vector<Entry>& entries) {
  std::vector<Summary> all;
  for (const Entry& entry : entries)
    if (all.empty() || all.back().name != entry.set)
      all.push_back(summarise(entry.set, entries, entry.set));
  all.push_back(summarise("total", entries, ""));
  return all;
}

std::string setsText(const std::vector<Entry>& entries) {
  std::string text;
  for (const Entry& entry : entries)
    if (!entry.outcome.proven())
      text += escapedLine(
                  entry.set + " " + std::to_string(entry.index) + ": " +
                  (entry.outcome.solved() ? "a segment is not proven" : entry.outcome.failure)) +
              "\n";
  TextTable table({{"set"},
                   {"solved", true},
                   {"all segments free", true},
                   {"median", true},
                   {"mean", true},
                   {"p95", true}});
  for (const Summary& summary : summaries(entries)) {
    const auto seconds = [&](double time) {
      return summary.times.empty() ? "-" : secondsText(time);
    };
    table.add({summary.name,
               std::to_string(summary.solved) + "/" + std::to_string(summary.problems),
               std::to_string(summary.proven) + "/" + std::to_string(summary.solved),
               seconds(quantile(summary.times, 0.5)), seconds(mean(summary.times)),
               seconds(quantile(summary.times, 0.95))});
  }
  return text + table.text();
}

Json setsJson(const std::vector<Entry>& entries, const PlanRequest& request) {
  Json json = {{"planner", request.planner}, {"seed", request.seed}, {"time", request.time}};
  json["sets"] = Json::array();
  for (const Summary& summary : summaries(entries)) {
    const auto orNull = [&](double time) {
      return summary.times.empty() ? Json(nullptr) : Json(time);
    };
    json["sets"].push_back({{"set", summary.name},
                            {"problems", summary.problems},
                            {"solved", summary.solved},
                            {"proven", summary.proven},
                            {"median", orNull(quantile(summary.times, 0.5))},
                            {"mean", orNull(mean(summary.times))},
                            {"p95", orNull(quantile(summary.times, 0.95))}});
  }
  json["problems"] = Json::array();
  for (const Entry& entry : entries)
    json["problems"].push_back(
        {{"set", entry.set},
         {"index", entry.index},
         {"solved", entry.outcome.solved()},
         {"proven", entry.outcome.proven()},
         {"failure", entry.outcome.solved() ? Json(nullptr) : Json(entry.outcome.failure)},
         {"planning_time", entry.outcome.planningTime},
         {"simplification_time", entry.outcome.simplifyTime},
         {"segments", entry.outcome.segments.size()},
         {"path_length", entry.outcome.length},
         {"motions_certified", entry.outcome.certified},
         {"motions_refused", entry.outcome.refused}});
  return json;
}

}  // namespace

ExitCode runPlanSets(const Arguments& args, const PlanRequest& request) {
  QueryDump dump(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Group& group = chooseGroup(*model.robot, args);
  const ProblemFile file = ProblemFile::load(args.problems);
  const std::vector<ProblemChoice> chosen = chosenProblems(file, args);
  requireBodiesOfRules(args, model, file, chosen);
  std::vector<Entry> entries;
  for (const ProblemChoice& choice : chosen)
    entries.push_back({.set = choice.set, .index = choice.index, .outcome = {}});
  const auto like = makeFirstChecker(args, model, group, std::make_shared<const World>(), warnings);
  {
    Progress progress("planning " + countedText(entries.size(), "problem"), args.quiet);
    runAll(entries, args.jobs, progress, [&](const Entry& entry) {
      return solveProblem(args, model, file, entry, *like, request, warnings);
    });
  }
  ExitCode code = ExitCode::Free;
  for (const Entry& entry : entries) {
    code = worse(code, entry.outcome.code);
    if (entry.outcome.code == ExitCode::BadInput)
      printMessage("swept: error: " + entry.outcome.failure);
    dump.setProblem(entry.set, entry.index);
    dumpFailures(dump, *like, entry.outcome);
  }
  if (args.json)
    std::cout << dumped(setsJson(entries, request)) << '\n';
  else
    printText(setsText(entries));
  dump.announce();
  return code;
}

}  // namespace swept
