// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "models_dir.hpp"
#include "swept/robot_model/input.hpp"

namespace swept::test {

/// A key of a format, in a file that is good but for it.
struct KeyCase {
  std::string key;  ///< as in the first column of the table, without its backticks
  std::string without;
  std::string with;
};

/// The fates of the keys in the table below the heading `## format` of robot_model/FORMATS.md, by
/// key.
inline std::map<std::string, std::string> fatesOf(const std::string& format) {
  std::ifstream file(modelsDir() + "/../robot_model/FORMATS.md");
  std::map<std::string, std::string> fates;
  std::string line, heading;
  while (std::getline(file, line)) {
    if (line.starts_with("## ")) heading = line.substr(3);
    if (heading != format || !line.starts_with("| `")) continue;
    const std::size_t end = line.find("` | ");
    const std::size_t next = line.find(" |", end + 4);
    if (end == std::string::npos || next == std::string::npos) {
      ADD_FAILURE() << "not a row `key` | fate | ...: " << line;
      continue;
    }
    const std::string key = line.substr(3, end - 3);
    EXPECT_TRUE(fates.emplace(key, line.substr(end + 4, next - end - 4)).second) << key;
  }
  return fates;
}

/// The last name of a key with a path: `position` of `robot_state/joint_state/position`.
inline std::string lastName(const std::string& key) {
  return key.substr(key.find_last_of("/ ") + 1);
}

/// Holds a format's table to what its reader does, and to `cases`: each row has cases, each case a
/// row. `answer` reads a file's text and says all that comes of it.
inline void walkFormat(const std::string& format, const std::vector<KeyCase>& cases,
                       const std::function<std::string(const std::string&)>& answer) {
  std::map<std::string, std::string> fates = fatesOf(format);
  ASSERT_FALSE(fates.empty()) << "no table '" << format << "'";
  std::map<std::string, int> walked;
  for (const KeyCase& key : cases) {
    SCOPED_TRACE(format + ": " + key.key);
    ASSERT_TRUE(fates.contains(key.key)) << "is not in the table";
    ++walked[key.key];
    const std::string fate = fates[key.key];
    std::string without, with, message;
    ASSERT_NO_THROW(without = answer(key.without));
    try {
      with = answer(key.with);
    } catch (const InputError& error) {
      message = error.what();
    }
    if (fate == "refused") {
      EXPECT_THAT(message, testing::HasSubstr(lastName(key.key)));
      continue;
    }
    EXPECT_EQ(message, "") << "is to be read";
    if (fate == "applied")
      EXPECT_NE(with, without);
    else if (fate == "no meaning")
      EXPECT_EQ(with, without);
    else
      ADD_FAILURE() << "no fate: " << fate;
  }
  for (const auto& [key, fate] : fates) EXPECT_EQ(walked.count(key), 1U) << key << " has no case";
}

}  // namespace swept::test
