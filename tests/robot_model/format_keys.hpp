// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

#include "format_table.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept::test {

/// The words in quotes that `text` has in its calls of allowOnly.
inline std::set<std::string> allowedKeysIn(const std::string& text) {
  std::set<std::string> keys;
  const std::regex list(R"(allowOnly\(\s*\{([^}]*)\}\s*\))");
  const std::regex word("\"([a-z_]+)\"");
  for (std::sregex_iterator call(text.begin(), text.end(), list), end; call != end; ++call) {
    const std::string words = (*call)[1];
    for (std::sregex_iterator key(words.begin(), words.end(), word); key != end; ++key)
      keys.insert((*key)[1]);
  }
  return keys;
}

/// Each key that a reader allows has a row in the format's table, and each row is of a word that
/// the reader's sources (in robot_model/src/io) have. `others`: keys in these sources that are of
/// other formats.
inline void expectKeysOf(const std::string& format, const std::vector<std::string>& sources,
                         const std::set<std::string>& others = {}) {
  std::string text;
  for (const std::string& source : sources)
    text += readTextFile(modelsDir() + "/../robot_model/src/io/" + source);
  std::set<std::string> rows;
  for (const auto& [key, fate] : fatesOf(format))
    for (std::size_t from = 0, to = 0; to != std::string::npos; from = to + 1) {
      to = key.find('/', from);
      rows.insert(key.substr(from, to == std::string::npos ? to : to - from));
    }
  const std::set<std::string> allowed = allowedKeysIn(text);
  EXPECT_GT(allowed.size(), 5U) << "no calls of allowOnly were found";
  for (const std::string& key : allowed)
    EXPECT_TRUE(rows.contains(key) || others.contains(key))
        << format << " has no row for '" << key << "'";
  for (const std::string& row : rows)
    EXPECT_NE(text.find('"' + row + '"'), std::string::npos)
        << format << ": the reader knows no '" << row << "'";
}

}  // namespace swept::test
