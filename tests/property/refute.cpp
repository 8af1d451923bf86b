// SPDX-License-Identifier: BSD-3-Clause
// refute: tries to prove the checker wrong on random motions. Exit code 1 when it did.
#include <CLI/CLI.hpp>
#include <iostream>
#include <optional>

#include "oracle/scene.hpp"
#include "refuter.hpp"

namespace {

struct Arguments {
  ScenarioFiles files;
  RefuterOptions refuter;
  swept::CheckerOptions checker;
  std::vector<double> from, to;
  std::optional<std::uint64_t> clutter;
  bool everyIndex = false;
};

bool run(const Scenario& scenario, const Arguments& arguments) {
  const bool one = !arguments.from.empty();
  const RefuterReport report =
      one ? refuteMotion(scenario, arguments.refuter, arguments.from, arguments.to)
          : refute(scenario, arguments.refuter);
  std::cout << scenario.robot.stem().string() << ' ' << scenario.worldArguments << ": "
            << summary(report) << std::endl;
  for (const std::string& failure : report.failures) std::cout << "  " << failure << '\n';
  return report.failures.empty();
}

bool runAll(Arguments& a) {
  if (a.clutter) return run(clutterScenario(a.files, *a.clutter, a.checker), a);
  if (!a.everyIndex) return run(loadScenario(a.files, a.checker), a);
  bool good = true;
  for (const int index : oracle::problemIndices(a.files.problems, a.files.set)) {
    a.files.index = index;
    good = run(loadScenario(a.files, a.checker), a) && good;
  }
  return good;
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): CLI throws where the options below are wrong.
int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{"Tries to prove the checker wrong on random motions."};
  app.add_option("--robot", a.files.robot, "URDF")->required();
  app.add_option("--srdf", a.files.srdf, "SRDF");
  app.add_option("--group", a.files.group, "group that moves")->required();
  // What would do nothing is refused.
  auto* scene = app.add_option("--scene", a.files.scene, "planning-scene YAML");
  auto* problems = app.add_option("--problems", a.files.problems, "MotionBenchMaker JSON");
  auto* set = app.add_option("--set", a.files.set, "problem set")->needs(problems);
  auto* index = app.add_option("--index", a.files.index, "problem")->needs(set);
  app.add_flag("--all", a.everyIndex, "every problem of the set")->needs(set)->excludes(index);
  app.add_option("--clutter", a.clutter, "random world of this seed")
      ->excludes(scene)
      ->excludes(problems);
  scene->excludes(problems);
  auto* motions = app.add_option("--motions", a.refuter.motions, "how many (of each world)");
  auto* seed = app.add_option("--seed", a.refuter.seed);
  app.add_option("--step", a.refuter.step, "rad or m between samples");
  auto* skew = app.add_option("--skew", a.refuter.skew, "larger: more short motions");
  auto* to = app.add_option("--to", a.to, "end of a single motion")->delimiter(',');
  auto* from = app.add_option("--from", a.from, "its start")->delimiter(',')->needs(to);
  to->needs(from);
  for (auto* ofMany : {motions, seed, skew}) from->excludes(ofMany);
  app.add_option("--margin", a.checker.margin, "m");
  app.add_option("--tolerance", a.checker.tolerance, "m");
  CLI11_PARSE(app, argc, argv);
  try {
    return runAll(a) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
