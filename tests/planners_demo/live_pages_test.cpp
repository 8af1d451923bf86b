// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "page_data.hpp"

/// What SWEPT_LIVE adds to pages. That the module answers is seen in a browser
/// (live_page_browser.py) and in tests/packaging/wasm.sh.
namespace swept::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kCheck =
    "swept check models/robots/rook7/rook7.urdf 0.1,0.4,0,1.2,0,0.8,0 --group arm --scene "
    "models/scenes/narrow_slot.yaml --margin-self 0.001 --pad hand=0.01 ";

class LivePages : public testing::Test {
 protected:
  void SetUp() override {
    if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
    module_.write("live.js", "// the module's script\n");
    module_.write("live.wasm", std::string("\0asm", 4));
  }
  std::string html(const std::string& command) {
    const Outcome run = runShell(command + " --html " + folder_.path("p.html"));
    EXPECT_THAT(run.err, Not(HasSubstr("error"))) << command;
    return folder_.read("p.html");
  }
  std::string withModule() const { return "SWEPT_LIVE=" + module_.path() + " "; }

  TemporaryFolder module_, folder_;
};

TEST_F(LivePages, HaveAllThatTheAnswersDependOn) {
  const json live = pageData(html(withModule() + kCheck))["live"];
  for (const auto& [name, content] : live["files"].items()) {
    const std::filesystem::path file = folder_.path("given/" + name);
    ASSERT_EQ(file.lexically_normal(), file);
    std::filesystem::create_directories(file.parent_path());
    const std::vector<std::uint8_t> bytes = bytesOf(content);
    folder_.write("given/" + name, std::string(bytes.begin(), bytes.end()));
  }
  // The same answer from these files alone.
  const json& inputs = live["inputs"];
  const std::string given = folder_.path("given") + "/";
  const json again = jsonOf(runShell(
      "swept check --json " + given + inputs["robot"].get<std::string>() + " " +
      inputs["states"][0].get<std::string>() + " --srdf " + given +
      inputs["srdf"].get<std::string>() + " --group " + inputs["group"].get<std::string>() +
      " --scene " + given + inputs["scene"].get<std::string>() + " --margin-self 0.001 --pad " +
      inputs["pad"][0].get<std::string>()));
  const json first = jsonOf(runShell(kCheck + "--json"));
  EXPECT_EQ(first["states"][0]["verdict"], "collision");
  EXPECT_EQ(again["states"][0]["contacts"], first["states"][0]["contacts"]);
  EXPECT_EQ(inputs["margin_self"], 0.001);
}

TEST_F(LivePages, OfProblemsHaveTheirFile) {
  const json live = pageData(html(withModule() +
                                  "swept check models/robots/rook7/rook7.urdf --group arm "
                                  "--problems models/problems.json --set shelf --index 1"))["live"];
  EXPECT_EQ(live["inputs"]["problems"], "problems.json");
  EXPECT_EQ(live["inputs"]["index"], 1);
  EXPECT_TRUE(live["files"].contains("problems.json"));
  EXPECT_TRUE(live["files"].contains("robots/rook7/rook7.srdf"));
}

TEST_F(LivePages, AreNoOthersWithoutIt) {
  const std::string page = html("SWEPT_LIVE= " + kCheck);
  EXPECT_THAT(page, Not(HasSubstr("makeSweptLive")));
  EXPECT_FALSE(pageData(page).contains("live"));
  EXPECT_THAT(html(withModule() + kCheck), HasSubstr("makeSweptLive"));
  const std::string info = "swept info models/robots/rook7/rook7.urdf --group arm";
  EXPECT_FALSE(pageData(html(withModule() + info)).contains("live"));
}

TEST_F(LivePages, SayWhatTheFolderLacks) {
  std::filesystem::remove(module_.path("live.wasm"));
  const Outcome run = runShell(withModule() + kCheck + "--html " + folder_.path("p.html"));
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_THAT(run.err, HasSubstr("SWEPT_LIVE: the folder '" + module_.path() +
                                 "' has no live.wasm, which tests/packaging/wasm.sh makes"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path("p.html")));
  // Who asks for no page needs no module.
  EXPECT_EQ(runShell(withModule() + kCheck).exitCode, 1);
}

}  // namespace
}  // namespace swept::test
