// SPDX-License-Identifier: BSD-3-Clause
#include "options.hpp"

#include <CLI/CLI.hpp>
#include <cmath>

namespace soak {

namespace {

constexpr int kBadInput = 3;

void addAmounts(CLI::App& app, Options& o) {
  const auto most = std::int64_t{100'000'000'000};
  app.add_option("--states", o.states, "states to check, all ways together")
      ->check(CLI::Range(std::int64_t{0}, most))
      ->capture_default_str();
  app.add_option("--motions", o.motions, "motions to certify")
      ->check(CLI::Range(std::int64_t{0}, most))
      ->capture_default_str();
  app.add_option("--threads", o.threads, "that check, besides the one that updates the worlds")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--updates", o.updates, "of the worlds, spread evenly over the checks")
      ->check(CLI::Range(std::int64_t{0}, most))
      ->capture_default_str();
  app.add_option("--seed", o.seed, "of the worlds and of what is asked")->capture_default_str();
  app.add_option("--sample-one-in", o.sampleOneIn, "one answer in so many is judged")
      ->check(CLI::Range(1, 1'000'000'000))
      ->capture_default_str();
  app.add_option("--growth", o.growth,
                 "MiB that memory may grow from the second quarter of the soak to the last")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
}

void addRobot(CLI::App& app, Options& o) {
  auto* robot = app.add_option("--robot", o.files.robot, "URDF; without, the robots of models/")
                    ->check(CLI::ExistingFile);
  app.add_option("--srdf", o.files.srdf, "SRDF of that robot")
      ->check(CLI::ExistingFile)
      ->needs(robot);
  auto* group = app.add_option("--group", o.files.group, "group of that robot")->needs(robot);
  robot->needs(group);
  app.add_option("--margin", o.margin, "m, that all pairs are to keep")
      ->check(CLI::Range(0.0, 1.0))
      ->needs(robot);
}

/// One query of a failed soak, again.
void addQuestion(CLI::App& app, Question& question) {
  auto* world = app.add_option("--world", question.world, "ask one query again, in this world")
                    ->needs("--robot");
  auto* from = app.add_option("--from", question.from, "state, or start of the motion")
                   ->delimiter(',')
                   ->needs(world);
  world->needs(from);
  auto* to = app.add_option("--to", question.to, "end of the motion")->delimiter(',')->needs(from);
  app.add_flag("--verdict-only", question.verdictOnly, "no more than the verdict of the motion")
      ->needs(to);
}

}  // namespace

ParsedOptions parseOptions(int argc, const char* const* argv) {
  ParsedOptions parsed;
  Options& o = parsed.options;
  Question question;
  CLI::App app{
      "Checks states and motions on many threads while the worlds change, and judges samples of "
      "the answers.\nExit codes: 0 nothing to complain of; 1 a wrong answer, memory that grows, or "
      "too few free or in collision; 3 bad input or usage; 130 ended early by SIGINT."};
  addAmounts(app, o);
  addRobot(app, o);
  addQuestion(app, question);
  try {
    app.parse(argc, argv);
    if (o.states + o.motions == 0)
      throw CLI::ValidationError("--states, --motions", "0 and 0: there is nothing to check");
  } catch (const CLI::ParseError& error) {
    parsed.exitCode = app.exit(error) == 0 ? 0 : kBadInput;
  }
  if (!question.world.empty()) o.question = std::move(question);
  return parsed;
}

}  // namespace soak
