// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <ostream>
#include <string>

#include "input_files.hpp"
#include "swept/robot_model/cloud_file.hpp"

namespace swept::test {

/// A broken file of points or of a map.
struct BadFile {
  std::string name;
  std::string file;  ///< its ending says what reads it
  std::string text;
  std::string message;  ///< behind the file's name
};

inline void PrintTo(const BadFile& file, std::ostream* out) {
  *out << file.name;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

inline std::string times(int count, const std::string& text) {
  std::string out;
  for (int i = 0; i < count; ++i) out += text;
  return out;
}

/// The message at a byte behind `header`.
inline std::string at(const std::string& header, std::size_t offset, const std::string& message) {
  return ": error: at byte " + std::to_string(header.size() + offset) + ": " + message;
}

/// Whatever the ending says.
inline void load(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".bt" || ending == ".ot") {
    loadOctomap(file);
  } else {
    loadPoints(file);
  }
}

/// What loading the file says, and that nothing is printed.
inline void expectMessage(const BadFile& bad) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write(bad.file, bad.text);
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const std::string message = inputError([&] { load(file); });
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(message, file.string() + bad.message);
}

}  // namespace swept::test
