// SPDX-License-Identifier: BSD-3-Clause
//
// What other libraries say of a file may have all of the file in it, with its control characters.
#include "swept/robot_model/foreign_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "io/mesh_file.hpp"
#include "io/mesh_import.hpp"
#include "swept/robot_model/planning_request.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::HasSubstr;

TEST(ForeignText, ShortTextOfOneLineStays) {
  EXPECT_EQ(foreignText(""), "");
  EXPECT_EQ(foreignText(" \n"), "");
  EXPECT_EQ(foreignText("no vertices at 'a\\b'"), "no vertices at 'a\\b'");
  EXPECT_EQ(foreignText("\nGröße 5 µm\n"), "Größe 5 µm");
}

TEST(ForeignText, ControlCharactersAreNamed) {
  EXPECT_EQ(foreignText("a\nb\r\nc\x1b[2J\x7f"), "a\\nb\\u000d\\nc\\u001b[2J\\u007f");
  EXPECT_EQ(foreignText(std::string("a\0b", 3)), "a\\u0000b");
  // The same in Latin-1, as UTF-8 and as bytes that are none.
  EXPECT_EQ(foreignText("a\xc2\x9b\x9b\xff\xe2\x82z"), "a\\u009b\\u009b\\u00ff\\u00e2\\u0082z");
}

TEST(ForeignText, LongTextIsCutBetweenCharacters) {
  EXPECT_EQ(foreignText(std::string(300, 'a')), std::string(300, 'a'));
  EXPECT_EQ(foreignText(std::string(301, 'a')), std::string(300, 'a') + "...");
  EXPECT_EQ(foreignText(std::string(299, 'a') + "\xc3\xa4"), std::string(299, 'a') + "...");
  EXPECT_EQ(foreignText(std::string(298, 'a') + "\xc3\xa4" + "b"),
            std::string(298, 'a') + "\xc3\xa4...");
}

/// In texts of 1 MB, with a control character in what the library quotes.
TEST(ForeignText, IsAllThatMessagesHaveOfOtherLibraries) {
  const test::TemporaryFolder folder;
  const std::string noise = "\x1b[2J" + std::string(1 << 20, 'q');
  const std::vector<std::function<void()>> readers{
      [&] { ProblemFile::load(folder.write("a.json", "{\"" + noise)); },
      [&] { ProblemFile::load(folder.write("b.json", "{\"a\": " + noise)); },
      [&] { ProblemFile::load(folder.write("c.json", std::string(1 << 20, '[') + "1e999")); },
      [&] { ProblemFile::load(folder.write("d.json", "[1" + std::string(1 << 20, '0') + "e99]")); },
      [&] { World::load(folder.write("a.yaml", "world: *" + noise)); },
      [&] { World::load(folder.write("b.yaml", "world: &" + noise + " [")); },
      [&] { World::load(folder.write("c.yaml", "? " + noise + "\n\t: !<" + noise)); },
      [&] { PlanningRequest::load(folder.write("d.yaml", "a: *" + noise)); },
      [&] { Robot::load(folder.write("a.urdf", "<robot name='r'><link name='a'/><" + noise)); },
  };
  for (std::size_t i = 0; i < readers.size(); ++i) {
    const std::string message = test::inputError(readers[i]);
    EXPECT_NE(message, "") << i;
    EXPECT_LE(message.size(), 1000U) << i;
    EXPECT_THAT(message, Each(Ge(' '))) << i;
  }
}

/// Assimp puts the rest of the file behind a word that is no number to it.
TEST(ForeignText, IsAllThatMessagesHaveOfAssimp) {
  std::string text = "solid a\nfacet normal -nan(ind) 0 1\nouter loop\nvertex 0 0 0\n";
  for (int i = 0; i < 100'000; ++i) text += "vertex 1 0 0\n";
  try {
    static_cast<void>(detail::importMesh(
        "mesh.stl", {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}));
    FAIL() << "is to be refused";
  } catch (const detail::MeshFileError& error) {
    EXPECT_LE(std::string(error.what()).size(), 400U);
    EXPECT_THAT(error.what(), HasSubstr("cannot be read: "));
    EXPECT_THAT(std::string(error.what()), Each(Ge(' ')));
  }
}

}  // namespace
}  // namespace swept
