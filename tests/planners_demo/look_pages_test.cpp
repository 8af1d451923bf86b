// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "page_data.hpp"

/// What the robot looks like, on pages: never a matter of answers.
namespace swept::test {
namespace {

using nlohmann::json;

const std::string kRook = "models/robots/rook7/rook7.urdf";

/// Three links, the last of which can meet the first; `visuals` of the first.
std::string armOf(const std::string& visuals) {
  const std::string ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
  return "<robot name='arm'><link name='base'>" + visuals + ball + "</link><link name='arm'>" +
         ball + "</link><link name='tip'>" + ball +
         "</link><joint name='j' type='revolute'><parent link='base'/><child link='arm'/><origin "
         "xyz='1 0 0'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/>"
         "</joint><joint name='k' type='fixed'><parent link='arm'/><child link='tip'/><origin "
         "xyz='-0.9 0.5 0'/></joint></robot>";
}

std::string meshVisual(const std::string& file) {
  return "<visual><geometry><mesh filename='" + file + "'/></geometry></visual>";
}

class LookPage : public testing::Test {
 protected:
  void SetUp() override {
    if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  }
  json pageOf(const std::string& robot, const std::string& state, Outcome& run,
              std::vector<std::string> options = {}) {
    std::vector<std::string> command{"check", robot, state, "--html", folder_.path("p.html")};
    command.insert(command.end(), options.begin(), options.end());
    run = runSwept(command);
    EXPECT_EQ(run.exitCode, 0) << run.err;
    return pageData(folder_.read("p.html"));
  }
  TemporaryFolder folder_;
};

TEST_F(LookPage, MeshesThatAreCheckedAreThereOnce) {
  Outcome run;
  const json data = pageOf(kRook, "ready", run, {"--group", "arm"});
  EXPECT_EQ(run.err, "");
  std::set<std::size_t> checked;
  std::map<std::string, std::string> colours;
  for (const json& body : data["bodies"]) {
    colours[body["name"]] = body["colour"].is_null() ? "" : body["colour"].get<std::string>();
    for (const json& part : body["parts"]) checked.insert(part["geometry"].get<std::size_t>());
  }
  EXPECT_EQ(colours["link1"], "#ededf0");
  EXPECT_EQ(colours["elbow_ring"], "#e88229");
  std::size_t meshes = 0;
  for (const json& visual : data["visuals"]) {
    const auto geometry = visual["geometry"].get<std::size_t>();
    if (data["geometries"][geometry]["kind"] != "triangles") continue;
    ++meshes;
    EXPECT_TRUE(checked.contains(geometry)) << visual;
  }
  EXPECT_EQ(meshes, 12U);
  // rook7 looks as it is: in each link as many visuals as parts that are checked, at the same
  // place.
  std::map<std::string, std::multiset<std::string>> shown, proven;
  for (const json& visual : data["visuals"])
    shown[data["frames"]["links"][visual["frame"].get<std::size_t>()]].insert(visual["pose"]);
  for (const json& body : data["bodies"])
    for (const json& part : body["parts"]) proven[body["name"]].insert(part["pose"]);
  EXPECT_EQ(shown, proven);
}

TEST_F(LookPage, MeshesThatAreMissingCostOneWarningAndNothingElse) {
  const std::string robot = folder_.write(
      "arm.urdf", armOf(meshVisual("a.stl") + meshVisual("b.dae") + meshVisual("c.obj")));
  Outcome run;
  const json data = pageOf(robot, "-0.5", run);
  EXPECT_EQ(run.err, robot +
                         ":1: warning: 3 meshes of <visual> are not found: they are left out of "
                         "what is shown (first at line 1)\n");
  EXPECT_TRUE(data["visuals"].empty());
  EXPECT_THAT(data["facts"].dump(), testing::HasSubstr("[\"visual\",\"3 left out\"]"));
  // Who asks for no page does not look for them.
  const Outcome without = runSwept({"check", robot, "-0.5"});
  EXPECT_EQ(without.err, "");
  EXPECT_EQ(without.out + "page written to " + folder_.path("p.html") + "\n", run.out);
  pageOf(robot, "-0.5", run, {"-q"});
  EXPECT_EQ(run.err, "");
}

TEST_F(LookPage, LargeMeshesAreDrawnCoarserAndThePageSaysSo) {
  std::string text;
  constexpr int kColumns = 500, kRows = 200;
  for (int i = 0; i <= kRows; ++i)
    for (int j = 0; j <= kColumns; ++j)
      text += "v " + std::to_string(i * 0.001) + " " + std::to_string(j * 0.001) + " 0\n";
  for (int i = 0; i < kRows; ++i)
    for (int j = 1; j <= kColumns; ++j) {
      const int at = i * (kColumns + 1) + j;
      text += "f " + std::to_string(at) + " " + std::to_string(at + 1) + " " +
              std::to_string(at + kColumns + 2) + " " + std::to_string(at + kColumns + 1) + "\n";
    }
  folder_.write("sheet.obj", text);
  const std::string robot = folder_.write("arm.urdf", armOf(meshVisual("sheet.obj")));
  Outcome run;
  const json data = pageOf(robot, "-0.5", run);
  ASSERT_EQ(data["visuals"].size(), 1U);
  const json& geometry = data["geometries"][data["visuals"][0]["geometry"].get<std::size_t>()];
  const std::size_t drawn =
      geometry.contains("indices16")
          ? uint16s(geometry["indices16"]).size() / 3
          : static_cast<std::size_t>(integers(geometry["indices32"]).size()) / 3;
  EXPECT_LE(drawn, 150'000U);
  EXPECT_GT(drawn, 100'000U);
  EXPECT_THAT(data["facts"].dump(),
              testing::HasSubstr("drawn with " + std::to_string(drawn) + " of 200000 triangles"));
}

}  // namespace
}  // namespace swept::test
