// SPDX-License-Identifier: BSD-3-Clause
#include "batch/run_key.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "batch/validator.hpp"
#include "command_line/exit_code.hpp"
#include "input/problem_choice.hpp"
#include "swept/ompl_bridge/planners.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

/// The longest line, in bytes. A key has some hundred bytes; text without a line break may never
/// end.
constexpr std::size_t kMaxLine = std::size_t{1} << 20;

constexpr std::uint32_t kLargestSeed = std::numeric_limits<std::uint32_t>::max();

/// In the order given, each once.
template <typename Read>
std::vector<std::string> namesOf(const std::vector<std::string>& texts, const Read& read) {
  std::vector<std::string> names;
  for (const std::string& text : texts) {
    const std::string name = read(text);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

/// Throws UsageError or InputError unless the key's problem, planner and validator exist under
/// these names.
void requireKnown(const RunKey& key, const ProblemFile& problems, double margin) {
  problems.problem(key.set, key.index);
  if (plannerName(key.planner) != key.planner)
    throw UsageError("planner is \"" + key.planner + "\"; it must be \"" +
                     plannerName(key.planner) + "\"");
  if (const std::string name = readValidator(key.validator, margin).name(); name != key.validator)
    throw UsageError("validator is \"" + key.validator + "\"; it must be \"" + name + "\"");
}

}  // namespace

std::uint32_t seedOfRun(std::uint32_t first, int run) {
  const std::uint64_t zeroBased = std::uint64_t{first} - 1 + static_cast<std::uint64_t>(run) - 1;
  return static_cast<std::uint32_t>(zeroBased % kLargestSeed) + 1;
}

std::vector<RunKey> listRuns(const ProblemFile& problems, const Arguments& args) {
  const auto planners =
      namesOf(args.batch.planners, [](const std::string& text) { return plannerName(text); });
  const auto validators = namesOf(args.batch.validators, [&](const std::string& text) {
    return readValidator(text, largestMargin(args)).name();
  });
  std::vector<RunKey> keys;
  for (const auto& [set, index] : chosenProblems(problems, args))
    for (const std::string& planner : planners)
      for (const std::string& validator : validators)
        for (int run = 1; run <= args.batch.runs; ++run)
          keys.push_back({.set = set,
                          .index = index,
                          .planner = planner,
                          .validator = validator,
                          .run = run,
                          .seed = seedOfRun(args.seed, run)});
  return keys;
}

std::vector<RunKey> readRuns(std::istream& text, const std::string& source,
                             const ProblemFile& problems, const Arguments& args) {
  std::vector<RunKey> keys;
  std::set<RunKey> known;
  int number = 0;
  std::string most(kMaxLine + 1, '\0');
  while (text.getline(most.data(), static_cast<std::streamsize>(most.size()))) {
    ++number;
    const auto count = static_cast<std::size_t>(text.gcount());
    const std::string line = most.substr(0, text.eof() ? count : count - 1);
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    try {
      const nlohmann::json json = parseJsonLine(line, source, number);
      keys.push_back(keyOf(JsonValue(json, "", source)));
      requireKnown(keys.back(), problems, largestMargin(args));
      if (!known.insert(keys.back()).second)
        throw UsageError("the run " + keyText(keys.back()) + " comes twice");
    } catch (const InputError& error) {
      throw InputError(source, number, error.message());
    } catch (const UsageError& error) {
      throw InputError(source, number, error.what());
    }
  }
  if (!text.eof())
    throw InputError(source, number + 1,
                     "the line has more than " + std::to_string(kMaxLine) +
                         " bytes, which are the most that name a run");
  return keys;
}

Json keyJson(const RunKey& key) {
  return {{"set", key.set},         {"index", key.index},
          {"planner", key.planner}, {"validator", key.validator},
          {"run", key.run},         {"seed", key.seed}};
}

nlohmann::json parseJsonLine(const std::string& line, const std::string& source, int number) {
  requireModestJson(line, source, number);
  nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object()) throw InputError(source, number, "the line is not a JSON object");
  return json;
}

RunKey keyOf(const JsonValue& json) {
  RunKey key;
  key.set = json.at("set").text();
  key.index = static_cast<int>(json.at("index").whole(-1'000'000'000, 1'000'000'000));
  key.planner = json.at("planner").text();
  key.validator = json.at("validator").text();
  key.run = static_cast<int>(json.at("run").whole(1, std::numeric_limits<int>::max()));
  key.seed = static_cast<std::uint32_t>(json.at("seed").whole(1, kLargestSeed));
  return key;
}

std::string keyText(const RunKey& key) {
  return key.set + " " + std::to_string(key.index) + " " + key.planner + " " + key.validator +
         ", run " + std::to_string(key.run) + ", seed " + std::to_string(key.seed);
}

}  // namespace swept
