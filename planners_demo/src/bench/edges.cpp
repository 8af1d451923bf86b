// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <functional>
#include <iostream>
#include <limits>
#include <map>

#include "bench/edges_file.hpp"
#include "bench/edges_output.hpp"
#include "bench/peer.hpp"
#include "command_line/commands.hpp"
#include "input/problem_choice.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "replay/query_dump.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

// The usual stack takes a hundred times as long; its least time settles sooner.
constexpr int kMostFclPasses = 3;

/// s that `work` takes.
template <typename Work>
double secondsOf(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// The edges asked for, in the order of the file.
std::vector<BenchEdge> chosenEdges(const Arguments& args, const ProblemFile& problems,
                                   int dimension) {
  // The file's own message names the sets it has.
  if (!args.set.empty() && problems.indices(args.set).empty()) problems.problem(args.set, 0);
  std::vector<BenchEdge> edges = readBenchEdges(args.edges, dimension, problems);
  if (!args.set.empty())
    std::erase_if(edges, [&](const BenchEdge& edge) { return edge.set != args.set; });
  if (edges.empty()) throw UsageError("'" + args.edges + "' has no edge of set '" + args.set + "'");
  if (args.limit && edges.size() > static_cast<std::size_t>(*args.limit)) edges.resize(*args.limit);
  return edges;
}

/// The group asked for; without, the first that has exactly the joints of the first problem.
const Group& benchGroup(const Arguments& args, const Robot& robot, const ProblemFile& problems) {
  if (asksForGroup(args) || problems.sets().empty()) return chooseGroup(robot, args);
  const std::string set = problems.sets().front();
  const std::vector<std::string> wanted =
      problems.problem(set, problems.indices(set).front()).jointNames;
  for (const Group& group : robot.groups()) {
    const bool fits = std::ranges::is_permutation(group.variables, wanted, std::ranges::equal_to(),
                                                  [&](int v) { return robot.variables()[v].name; });
    if (fits) return group;
  }
  return chooseGroup(robot, args);
}

/// Places of edges in the file, by problem, in the order in which problems appear.
struct EdgesOfProblem {
  std::string set;
  int index = 0;
  std::vector<std::size_t> places;
};

std::vector<EdgesOfProblem> byProblem(const std::vector<BenchEdge>& edges) {
  std::vector<EdgesOfProblem> groups;
  std::map<std::pair<std::string, int>, std::size_t> known;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [found, isNew] = known.try_emplace({edges[i].set, edges[i].index}, groups.size());
    if (isNew) groups.push_back({.set = edges[i].set, .index = edges[i].index, .places = {}});
    groups[found->second].places.push_back(i);
  }
  return groups;
}

std::vector<double> inOrder(const std::vector<double>& values,
                            const std::vector<std::size_t>& order) {
  std::vector<double> q;
  for (const std::size_t place : order) q.push_back(values[place]);
  return q;
}

/// Certifies the edges of one problem, all of them in each pass: no edge finds the caches as its
/// own last pass left them.
std::vector<EdgeResult> measure(const Checker& checker, const std::vector<BenchMotion>& motions,
                                int passes, const BenchClock& clock) {
  Workspace workspace(checker);
  std::vector<EdgeResult> results(motions.size());
  for (EdgeResult& result : results) result.nanoseconds = std::numeric_limits<double>::infinity();
  MotionCertificate certificate;
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const double taken = clock.time([&] {
        certificate = checker.certifyMotion(motions[i].from, motions[i].to, workspace,
                                            MotionQuery::VerdictOnly);
      });
      results[i].nanoseconds = std::min(results[i].nanoseconds, taken);
      results[i].verdict = certificate.verdict;
      results[i].effort = certificate.effort;
    }
  }
  return results;
}

/// A run of the program over the edges of a file, one problem after the other.
class EdgeRun {
 public:
  explicit EdgeRun(const Arguments& args) : args_(args), warnings_(args.quiet), dump_(args) {
    bench_.margin = args.margin;
    bench_.selfMargin = args.selfMargin.value_or(args.margin);
    bench_.worldMargin = args.worldMargin.value_or(args.margin);
    bench_.tolerance = args.tolerance;
    bench_.passes = args.passes;
    bench_.clockOverhead = clock_.overhead();
    bench_.loadTime = secondsOf([&] { model_ = loadModel(args, warnings_); });
    bench_.robot = model_.robot->name();
  }

  EdgeBench run() {
    const ProblemFile problems = ProblemFile::load(args_.problems);
    const Group& group = benchGroup(args_, *model_.robot, problems);
    bench_.group = group.name;
    const auto edges = chosenEdges(args_, problems, static_cast<int>(group.variables.size()));
    bench_.results.resize(edges.size());
    const std::vector<EdgesOfProblem> parts = byProblem(edges);
    std::vector<ProblemChoice> chosen;
    for (const EdgesOfProblem& part : parts)
      chosen.push_back({.set = part.set, .index = part.index});
    requireBodiesOfRules(args_, model_, problems, chosen);
    Progress progress("measuring", args_.quiet);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      progress.setLabel(std::to_string(i) + " of " + std::to_string(parts.size()) +
                        " problems, now " + parts[i].set + " " + std::to_string(parts[i].index));
      addProblem(problems.problem(parts[i].set, parts[i].index), group, parts[i], edges);
    }
    dump_.announce();
    return std::move(bench_);
  }

 private:
  void addProblem(const PlanningProblem& problem, const Group& group, const EdgesOfProblem& part,
                  const std::vector<BenchEdge>& edges) {
    const std::vector<std::size_t> order = problemOrder(*model_.robot, group, problem);
    const auto world = std::make_shared<const World>(problem.world);
    std::shared_ptr<const Checker> checker;
    bench_.checkerTimes.push_back(secondsOf([&] {
      checker = like_ ? makeNextChecker(args_, model_, *like_, world, warnings_)
                      : makeFirstChecker(args_, model_, group, world, warnings_);
    }));
    like_ = checker;
    std::vector<BenchMotion> motions;
    for (const std::size_t place : part.places) {
      motions.push_back(
          {.from = inOrder(edges[place].from, order), .to = inOrder(edges[place].to, order)});
      for (auto* q : {&motions.back().from, &motions.back().to})
        for (const TakenToLimit& taken : takeToLimits(*model_.robot, group, *q))
          warnings_("swept: warning: " + limitRemark(taken));
    }
    const std::vector<EdgeResult> results = measure(*checker, motions, args_.passes, clock_);
    std::vector<FclResult> fcl;
    if (!args_.against.empty())
      fcl = measureFcl(*checker, motions, std::min(args_.passes, kMostFclPasses), clock_);
    for (std::size_t i = 0; i < results.size(); ++i) {
      EdgeResult& result = bench_.results[part.places[i]];
      result = results[i];
      result.length = edges[part.places[i]].length;
      if (!fcl.empty()) result.fcl = fcl[i];
      dumpUndecided(*checker, part, motions[i], result, part.places[i] + 1);
    }
  }

  /// Collisions are no failures here: the edges come from a planner that tried them.
  void dumpUndecided(const Checker& checker, const EdgesOfProblem& part, const BenchMotion& motion,
                     const EdgeResult& result, std::size_t row) {
    if (result.verdict != Verdict::Undecided) return;
    MotionCertificate certificate;
    certificate.verdict = result.verdict;
    dump_.setProblem(part.set, part.index);
    dump_.motion(checker, "edge " + std::to_string(row), motion.from, motion.to, certificate);
  }

  const Arguments& args_;
  Warnings warnings_;
  QueryDump dump_;
  BenchClock clock_;
  Model model_;
  EdgeBench bench_;
  std::shared_ptr<const Checker> like_;  ///< the last one
};

}  // namespace

ExitCode runBenchEdges(const Arguments& args) {
  requirePeer(args);
  const EdgeBench bench = EdgeRun(args).run();
  if (args.json)
    std::cout << dumped(benchJson(bench)) << '\n';
  else
    printText(benchText(bench));
  return ExitCode::Free;
}

}  // namespace swept
