// SPDX-License-Identifier: BSD-3-Clause
// swept_answers_record: asks seeded questions of all kinds and writes digests of the answers; see
// README.md.
#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <iostream>
#include <regex>
#include <stdexcept>
#include <string>

#include "data_folder.hpp"
#include "models_dir.hpp"
#include "record.hpp"
#include "swept/core/simd_dispatch.hpp"

namespace swept::answers {
namespace {

constexpr int kBadInput = 3;

/// Dispatch goes to the instruction set of this name, or stays as it is for an empty one; the name
/// of that which runs.
std::string chooseTarget(const std::string& name) {
  std::string all;
  for (std::int64_t left = detail::processorTargets(); left != 0; left &= left - 1) {
    std::string one = hwy::TargetName(left & -left);
    if (name.empty()) return one;
    if (one == name) {
      detail::chosenTarget().Update(left & -left);
      return one;
    }
    all += ' ' + one;
  }
  throw std::invalid_argument("--target: '" + name + "' is none of" + all);
}

void addOptions(CLI::App& app, Options& o) {
  app.add_option("--count", o.count, "questions, those that are asked once not among them")
      ->check(CLI::Range(std::int64_t{1}, std::int64_t{1'000'000'000}))
      ->capture_default_str();
  app.add_option("--seed", o.seed, "of scenes and questions")->capture_default_str();
  app.add_option("--robots", o.robots, "regular expression: robots, or ROBOT:GROUP");
  app.add_option("--threads", o.threads, "0: as many as there are processors");
  app.add_option("--target", o.target, "instruction set, as Highway calls it; else the widest");
  app.add_option("--folder", o.extra, "more robots, scenes and problems")
      ->check(CLI::ExistingDirectory);
  app.add_option("--out", o.out, "file for the record; else standard output");
  app.add_option("--each", o.each, "file with a line for each question");
  app.add_option("--only", o.only, "ROBOT/SCENE/KIND/INDEX: prints this question and its answer");
}

std::ofstream openFile(const std::filesystem::path& path) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error("cannot write '" + path.string() + "'");
  return file;
}

void print(const char* name, const Tally& tally, std::ostream& out) {
  out << "# " << name << " questions=" << tally.questions << " free=" << tally.free
      << " collision=" << tally.collision << " undecided=" << tally.undecided << '\n';
}

/// Answers that are nearly all the same prove little.
bool isRepresentative(const Tally& motions) {
  const std::int64_t all = motions.free + motions.collision + motions.undecided;
  return all > 0 && 10 * motions.free >= all && 10 * motions.collision >= all;
}

int runProgram(const Options& options) {
  const std::string target = chooseTarget(options.target);
  Folders folders{.models = modelsDir(), .data = dataFolder(), .extra = std::nullopt};
  if (!options.extra.empty()) folders.extra = options.extra;
  const auto remark = [](const std::string& text) { std::cerr << "left out: " << text << '\n'; };
  const auto places = makePlaces(folders, options.seed, std::regex(options.robots), remark);
  if (places.empty()) throw std::invalid_argument("--robots: no robot matches");
  if (!options.only.empty()) {
    askOnly(options, places, std::cout);
    return 0;
  }
  std::ofstream outFile;
  std::ofstream eachFile;
  if (!options.out.empty()) outFile = openFile(options.out);
  if (!options.each.empty()) eachFile = openFile(options.each);
  std::ostream& out = options.out.empty() ? std::cout : outFile;
  out << "# count=" << options.count << " seed=" << options.seed << " robots=" << options.robots
      << " target=" << target << '\n';
  const Totals totals = record(options, places, out, options.each.empty() ? nullptr : &eachFile);
  print("all", totals.all, out);
  print("motions", totals.motions, out);
  out.flush();
  if (!out || (eachFile.is_open() && !eachFile.flush()))
    throw std::runtime_error("the files cannot be written");
  if (isRepresentative(totals.motions)) return 0;
  std::cerr << "error: fewer than a tenth of the motions are free, or in collision\n";
  return 1;
}

int parseAndRun(int argc, const char* const* argv) {
  Options options;
  CLI::App app{
      "Asks seeded questions of all kinds and writes digests of the answers.\nExit codes: 0; 1 too "
      "few motions are free or in collision; 3 bad input or usage."};
  addOptions(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadInput;
  }
  return runProgram(options);
}

}  // namespace
}  // namespace swept::answers

int main(int argc, char** argv) {
  try {
    return swept::answers::parseAndRun(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return swept::answers::kBadInput;
  }
}
