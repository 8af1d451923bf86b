// SPDX-License-Identifier: BSD-3-Clause
#include "completion/candidates.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>

#include "command_line/program_options.hpp"
#include "command_line/shell_word.hpp"
#include "completion/robot_names.hpp"
#include "completion/typed_line.hpp"
#include "swept/ompl_bridge/planners.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/problems.hpp"

namespace swept {
namespace {

using Words = std::vector<std::string>;

Words optionsOf(const CLI::App& app) {
  Words words;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
    for (const std::string& name : option->get_snames()) words.push_back("-" + name);
  }
  return words;
}

Words subcommandsOf(const CLI::App& app) {
  Words words;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    words.push_back(sub->get_name());
  return words;
}

/// Each with `before` in front and `behind` at its end.
Words around(const std::string& before, const Words& names, const std::string& behind) {
  Words words;
  for (const std::string& name : names) words.push_back(before + name + behind);
  return words;
}

/// `A,B,...` of names that are not there yet; at most `most` of them, and no fewer where
/// `all`: then a comma stands behind each but the last.
Words listOf(const std::string& typed, Words names, std::size_t most, bool all) {
  const std::size_t comma = typed.rfind(',');
  const std::string before = comma == std::string::npos ? "" : typed.substr(0, comma + 1);
  const auto count = static_cast<std::size_t>(std::ranges::count(before, ','));
  if (count >= most) return {};
  std::erase_if(names, [&](const std::string& name) {
    return ("," + before).find("," + name + ",") != std::string::npos;
  });
  return around(before, names, all && count + 1 < most ? "," : "");
}

Words setsOf(const std::string& problems) {
  // They take a tenth of a second.
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{8} * 1024 * 1024;
  if (!std::filesystem::is_regular_file(problems) ||
      std::filesystem::file_size(problems) > kMostBytes)
    return {};
  return ProblemFile::load(problems).sets();
}

/// A state of the group that is chosen, or of any.
Words statesOf(const TypedLine& typed) {
  Words words{std::string(kDefaultState)};
  if (!typed.args.joints.empty() || !typed.args.chain.empty()) return words;
  for (const RobotNames::State& state : robotNames(typed.args).states)
    if (typed.args.group.empty() || state.group == typed.args.group) words.push_back(state.name);
  return words;
}

Words valuesOf(const TypedLine& typed) {
  constexpr std::size_t kMany = 1000;
  const auto is = [&](const char* name) { return typed.option->check_name(name); };
  const auto names = [&] { return robotNames(typed.args); };
  const std::string& word = typed.word;
  if (is("--planner")) return plannerNames();
  if (is("--planners")) return listOf(word, plannerNames(), kMany, false);
  if (is("--validators")) return listOf(word, {"certified", "discrete:", "fcl:"}, kMany, false);
  if (is("--against")) return {"fcl"};
  if (is("--group")) return names().groups;
  if (is("--set")) return setsOf(typed.args.problems);
  if (is("--joints")) return listOf(word, names().joints, kMany, false);
  if (is("--link")) return names().links;
  if (is("--chain") || is("--allow") || is("--explain"))
    return listOf(word, names().links, 2, true);
  if (is("--pad") || is("--scale")) return around("", names().links, "=");
  const std::size_t at = word.rfind('@');
  if (!is("--attach")) return {};
  if (at == std::string::npos) return {"box:", "sphere:", "cylinder:"};
  return around(word.substr(0, at + 1), names().links, "");
}

Words positionalsOf(const TypedLine& typed) {
  Words words = subcommandsOf(*typed.app);
  if (!words.empty()) return words;
  const auto has = [&](const char* name) {
    return typed.app->get_option_no_throw(name) != nullptr;
  };
  if (has("shell") && typed.positionals == 0) return {"bash", "zsh", "fish"};
  return has("states") && typed.positionals > 0 ? statesOf(typed) : Words{};
}

Words wordsFor(const TypedLine& typed) {
  if (typed.option != nullptr) return valuesOf(typed);
  return typed.word.starts_with("-") ? optionsOf(*typed.app) : positionalsOf(typed);
}

}  // namespace

std::vector<std::string> candidatesFor(std::string_view line) {
  const Words words = shellWords(line);
  if (words.size() < 2) return {};
  CLI::App program;
  Arguments unused;
  describeProgram(program, unused);
  const TypedLine typed = readTyped(program, words);
  Words found;
  try {
    found = wordsFor(typed);
  } catch (const std::exception&) {
    // A file that cannot be read has no names; the command itself says why.
    return {};
  }
  std::erase_if(found, [&](const std::string& word) {
    return !word.starts_with(typed.word) || shellWord(word) != word;
  });
  return around(typed.before, found, "");
}

}  // namespace swept
