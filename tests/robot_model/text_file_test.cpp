// SPDX-License-Identifier: BSD-3-Clause
//
// Files of text that are too large, or nested too deeply, to be read.
#include "swept/robot_model/text_file.hpp"

#include <gtest/gtest.h>

#include "input_files.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using test::inputError;
using test::TemporaryFolder;

std::string nested(int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += i % 2 == 0 ? "[" : "{\"a\":";
  text += "1";
  for (int i = depth; i-- > 0;) text += i % 2 == 0 ? "]" : "}";
  return text;
}

TEST(TextFile, TheLargestIsReadAndOneByteMoreIsNot) {
  const TemporaryFolder folder;
  const auto file = folder.write("robot.urdf", "");
  std::filesystem::resize_file(file, kMaxTextBytes);  // takes no room on the disk
  EXPECT_EQ(readTextFile(file).size(), kMaxTextBytes);
  std::filesystem::resize_file(file, kMaxTextBytes + 1);
  EXPECT_EQ(inputError([&] { (void)Robot::load(file); }),
            file.string() +
                ": error: the file has more than 67108864 bytes, which are the most that are read "
                "of a text");
}

TEST(TextFile, EveryByteIsThere) {
  const TemporaryFolder folder;
  std::string text;
  for (unsigned i = 0; i < 200'001; ++i) text += static_cast<char>(i * i % 251);
  EXPECT_EQ(readTextFile(folder.write("a.scene", text)), text);
  EXPECT_EQ(readTextFile(folder.write("empty.scene", "")), "");
}

TEST(TextFile, JsonIsNestedNoDeeperThanTheLimit) {
  EXPECT_NO_THROW(requireModestJson(nested(kMaxNesting), "a.json"));
  EXPECT_EQ(inputError([] { requireModestJson("\n" + nested(kMaxNesting + 1), "a.json", 5); }),
            "a.json:6: error: objects and arrays are nested deeper than 500");
  // Many, but not in each other, and brackets in texts.
  std::string flat = "[";
  for (int i = 0; i < 2 * kMaxNesting; ++i)
    flat += R"(["[[\\\"{", {"[": "\\"}],)"
            "\n";
  EXPECT_NO_THROW(requireModestJson(flat + "0]", "a.json"));
}

TEST(TextFile, JsonObjectsHaveNoMoreKeysThanTheLimit) {
  const auto object = [](std::size_t keys) {
    std::string text = "{";
    for (std::size_t i = 0; i < keys; ++i) text += "\"k:" + std::to_string(i) + "\": [1, {}],\n";
    return text + "\"last\": 0}";
  };
  EXPECT_NO_THROW(requireModestJson(object(kMaxKeys - 1), "a.json"));
  EXPECT_EQ(inputError([&] { requireModestJson(object(kMaxKeys), "a.json"); }),
            "a.json:20001: error: an object has more than 20000 keys");
  // Several objects have as many each.
  EXPECT_NO_THROW(
      requireModestJson("[" + object(kMaxKeys - 1) + "," + object(kMaxKeys - 1) + "]", "a.json"));
  EXPECT_NO_THROW(requireModestJson("]}:", "a.json")) << "malformed: the parser says so";
}

TEST(TextFile, ProblemsAreNestedNoDeeper) {
  const TemporaryFolder folder;
  const auto file = folder.write("p.json", "{\"set\":\n" + nested(300'000) + "}");
  EXPECT_EQ(inputError([&] { (void)ProblemFile::load(file); }),
            file.string() + ":2: error: objects and arrays are nested deeper than 500");
}

}  // namespace
}  // namespace swept
