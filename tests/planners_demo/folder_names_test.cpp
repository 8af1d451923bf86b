// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>

#include "gantry.hpp"

/// Files in folders that are symbolic links, or have names that a shell takes apart.
namespace swept::test {
namespace {

namespace fs = std::filesystem;

class FolderNames : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return gantry_.folder().path(name); }
  Outcome verifiedIn(const std::string& folder, const std::string& file) const {
    return runCommands("swept verify " + file, path(folder));
  }

  Gantry gantry_;
};

/// Names in a path file were made relative to the folder as it was typed: `lnk/..` is not the
/// folder that has `lnk` in it.
TEST_F(FolderNames, APathFileBehindASymbolicLinkFindsItsFiles) {
  fs::create_directories(path("deep/er/x"));
  fs::create_directory_symlink(path("deep/er/x"), path("lnk"));
  ASSERT_EQ(gantry_.run("plan", {"left", "right", "-o", path("lnk/p.json")}).exitCode, 0);
  for (const auto& [folder, file] : {std::pair{"lnk", "p.json"},
                                     {"deep/er/x", "p.json"},
                                     {"", "lnk/p.json"},
                                     {"deep", "er/x/p.json"},
                                     {"lnk", "./../x/p.json"}}) {
    const Outcome run = verifiedIn(folder, file);
    EXPECT_EQ(run.exitCode, 0) << folder << ", " << file << ": " << run.out << run.err;
  }
}

/// Its files were looked for beside the link that it was read, or written, through.
TEST_F(FolderNames, APathFileThatIsASymbolicLinkFindsItsFiles) {
  for (const std::string folder : {"store/deep", "links"}) fs::create_directories(path(folder));
  fs::create_symlink("../store/deep/read.json", path("links/read.json"));
  fs::create_symlink("../store/deep/written.json", path("links/written.json"));
  ASSERT_EQ(gantry_.run("plan", {"left", "right", "-o", path("store/deep/read.json")}).exitCode, 0);
  ASSERT_EQ(gantry_.run("plan", {"left", "right", "-o", path("links/written.json")}).exitCode, 0);
  for (const std::string file : {"store/deep/read.json", "links/read.json",
                                 "store/deep/written.json", "links/written.json"}) {
    const Outcome run = verifiedIn("", file);
    EXPECT_EQ(run.exitCode, 0) << file << ": " << run.out << run.err;
  }
}

TEST_F(FolderNames, ARobotBehindASymbolicLinkIsFound) {
  fs::create_directories(path("far/away"));
  fs::create_directory_symlink(path(""), path("far/away/robots"));
  fs::create_directories(path("out"));
  ASSERT_EQ(
      runSwept({"plan", path("far/away/robots/gantry.urdf"), "left", "right", "--group", "both",
                "--scene", path("far/away/robots/post.yaml"), "-o", path("out/p.json")})
          .exitCode,
      0);
  EXPECT_EQ(verifiedIn("out", "p.json").exitCode, 0);
  // Such a file can move with its robot.
  const auto inputs = nlohmann::json::parse(gantry_.folder().read("out/p.json"))["inputs"];
  EXPECT_EQ(inputs["robot"], "../gantry.urdf");
  EXPECT_EQ(inputs["scene"], "../post.yaml");
}

/// A file that is a link itself keeps its name: bodies are named after it, and what it names is
/// looked for beside it.
TEST_F(FolderNames, AFileThatIsASymbolicLinkKeepsItsName) {
  gantry_.folder().write("real.obj",
                         "v -0.1 -0.1 0\nv 0.1 -0.1 0\nv 0 0.1 0\nv 0 0 -0.1\n"
                         "f 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n");
  fs::create_symlink(path("real.obj"), path("tip.obj"));
  ASSERT_EQ(gantry_
                .run("plan", {"left", "right", "--attach", path("tip.obj") + "@cube:0,0,-0.1", "-q",
                              "-o", path("p.json")})
                .exitCode,
            0);
  const Outcome run = verifiedIn("", "p.json");
  EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
}

/// The printed command was not quoted.
TEST_F(FolderNames, TheCommandThatConfirmsAPairCanBePasted) {
  fs::create_directories(path("my robot's"));
  const std::string urdf = gantry_.folder().write("my robot's/post.urdf", R"(<robot name="post">
  <link name="rail"><collision><origin xyz="1 0 0"/>
    <geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <link name="beam"/>
  <link name="cube"><collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
  <joint name="slide" type="prismatic"><parent link="rail"/><child link="beam"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="2" effort="1" velocity="1"/></joint>
  <joint name="lift" type="prismatic"><parent link="beam"/><child link="cube"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
)");
  gantry_.folder().write("my robot's/post.srdf",
                         "<robot name=\"post\"><disable_collisions link1=\"rail\" link2=\"cube\" "
                         "reason=\"Never\"/></robot>\n");
  const Outcome run = runSwept({"acm", urdf, "--package", "parts=" + path("my robot's"), "--json"});
  EXPECT_EQ(run.exitCode, 1);
  const auto differences = jsonOf(run)["differences"];
  ASSERT_EQ(differences.size(), 1u);
  const auto command = differences[0]["command"].get<std::string>();
  EXPECT_TRUE(command.starts_with("swept check '")) << command;
  const Outcome confirmed = runShell(command);
  EXPECT_EQ(confirmed.exitCode, 1) << command << "\n" << confirmed.err;
  EXPECT_NE(confirmed.out.find("rail - cube"), std::string::npos) << confirmed.out;
}

}  // namespace
}  // namespace swept::test
