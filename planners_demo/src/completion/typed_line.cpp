// SPDX-License-Identifier: BSD-3-Clause
#include "completion/typed_line.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace swept {
namespace {

/// The option that a word is, or that it begins with (`--group=arm`); null: none.
const CLI::Option* optionOf(const CLI::App& app, const std::string& word) {
  if (!word.starts_with("-")) return nullptr;
  const std::string name = word.substr(0, word.starts_with("--") ? word.find('=') : 2);
  for (const CLI::Option* option : app.get_options())
    if (option->nonpositional() && option->check_name(name)) return option;
  return nullptr;
}

bool takesValue(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

/// As a shell would have it by the time the program sees it.
std::string atHome(const std::string& file) {
  const char* home = std::getenv("HOME");
  return file.starts_with("~/") && home != nullptr ? home + file.substr(1) : file;
}

/// Keeps what tells which names there are.
void take(const CLI::Option& option, const std::string& value, Arguments& args) {
  const auto is = [&](const char* name) { return option.check_name(name); };
  if (is("--srdf")) args.srdf = value == "none" ? value : atHome(value);
  if (is("--group")) args.group = value;
  if (is("--joints")) args.joints = value;
  if (is("--chain")) args.chain = value;
  if (is("--problems")) args.problems = atHome(value);
}

/// A negative value looks like an option and is none.
bool isOption(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word[1] != '.' &&
         std::isdigit(static_cast<unsigned char>(word[1])) == 0;
}

}  // namespace

std::vector<std::string> shellWords(std::string_view line) {
  std::vector<std::string> words{""};
  char quote = '\0';
  bool begun = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char letter = line[i];
    if (letter == '\\' && quote != '\'' && i + 1 < line.size()) {
      words.back() += line[++i];
    } else if (quote != '\0' ? letter == quote : letter == '\'' || letter == '"') {
      quote = quote == '\0' ? letter : '\0';
    } else if (quote == '\0' && (letter == ' ' || letter == '\t' || letter == '\n')) {
      if (begun) words.emplace_back();
      begun = false;
      continue;
    } else {
      words.back() += letter;
    }
    begun = true;
  }
  return words;
}

TypedLine readTyped(const CLI::App& program, const std::vector<std::string>& words) {
  TypedLine typed;
  typed.app = &program;
  typed.word = words.back();
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    const auto isIt = [&](const CLI::App* app) { return app->get_name() == word; };
    const auto chosen = typed.app->get_subcommands(isIt);
    if (typed.positionals == 0 && !chosen.empty()) {
      typed.app = chosen.front();
      continue;
    }
    const CLI::Option* option = optionOf(*typed.app, word);
    const std::size_t equals = word.find('=');
    if (option != nullptr && word.starts_with("--") && equals != std::string::npos) {
      take(*option, word.substr(equals + 1), typed.args);
    } else if (option != nullptr && takesValue(*option)) {
      if (i + 2 == words.size())
        typed.option = option;
      else
        take(*option, words[++i], typed.args);
    } else if (!isOption(word)) {
      if (typed.positionals++ == 0) typed.args.robot = atHome(word);
    }
  }
  const std::size_t equals = typed.word.find('=');
  if (typed.option != nullptr || !typed.word.starts_with("--") || equals == std::string::npos)
    return typed;
  typed.option = optionOf(*typed.app, typed.word);
  typed.before = typed.word.substr(0, equals + 1);
  typed.word.erase(0, equals + 1);
  return typed;
}

}  // namespace swept
