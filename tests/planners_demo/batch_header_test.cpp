// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "batch.hpp"
#include "gantry.hpp"

/// The first line of a results file: what all of its results depend on.
namespace swept::test {
namespace {

using nlohmann::ordered_json;
using testing::HasSubstr;
using testing::StartsWith;

class BatchHeader : public testing::Test {
 protected:
  Outcome batch(const Words& more) const {
    Words all{"bench",          "planners", gantry_.urdf, "--group", "both", "--problems",
              gantry_.problems, "--set",    "over",       "-o",      file_};
    all.insert(all.end(), more.begin(), more.end());
    return runSwept(all);
  }
  ordered_json header() const {
    const std::string text = gantry_.folder().read("r");
    return ordered_json::parse(text.substr(0, text.find('\n')));
  }
  void setHeader(const ordered_json& header) const {
    const std::string text = gantry_.folder().read("r");
    gantry_.folder().write("r", header.dump() + text.substr(text.find('\n')));
  }
  void expectRefused(const Outcome& run, const std::string& message) const {
    EXPECT_EQ(run.exitCode, 3) << message;
    EXPECT_EQ(run.out, "") << message;
    EXPECT_EQ(run.err, file_ + message + "\n");
  }

  Gantry gantry_;
  std::string file_ = gantry_.folder().path("r");
};

/// Of the same type.
ordered_json another(const ordered_json& value) {
  if (value.is_boolean()) return !value.get<bool>();
  if (value.is_number_integer()) return value.get<int>() + 1;
  if (value.is_number()) return value.get<double>() + 0.5;
  if (value.is_array()) return ordered_json::array({"a,b"});
  return "other";
}

TEST_F(BatchHeader, AllOfItIsComparedButTheTime) {
  ASSERT_EQ(batch({}).exitCode, 0);
  const ordered_json written = header();
  ASSERT_GE(written.size(), 19u);
  ASSERT_TRUE(written.contains("time"));
  for (const auto& [key, value] : written.items()) {
    ordered_json changed = written;
    changed[key] = key == "time" ? ordered_json{{"host", "elsewhere"}} : another(value);
    setHeader(changed);
    const Outcome run = batch({});
    EXPECT_EQ(run.exitCode, key == "time" ? 0 : 3) << key;
    if (key == "time") continue;
    const std::string message = key == "format" ? "not a results file" : key + " is ";
    EXPECT_THAT(run.err, StartsWith(file_ + ":1: error: " + message)) << key;
  }
}

/// It was written and not compared: results without the attached box were taken for those with it.
TEST_F(BatchHeader, WhatIsAttachedIsCompared) {
  ASSERT_EQ(batch({}).exitCode, 0);
  const std::string other = R"(attach is []; it is ["box:0.1,0.1,0.1@cube"])";
  const Words attach{"--attach", "box:0.1,0.1,0.1@cube"};
  expectRefused(batch(attach), ":1: error: " + other + " on the command line");
  std::filesystem::rename(file_, file_ + "0");
  ASSERT_EQ(batch(attach).exitCode, 0);
  expectRefused(runSwept({"bench", "summary", file_ + "0", file_}),
                R"(:1: error: attach is ["box:0.1,0.1,0.1@cube"]; it is [] in ')" + file_ + "0'");
}

TEST_F(BatchHeader, WhatStandsIsCompared) {
  ASSERT_EQ(batch({}).exitCode, 0);
  EXPECT_FALSE(header().contains("stand"));
  expectRefused(batch({"--stand", "both=default"}),
                R"(:1: error: stand is []; it is ["both=default"] on the command line)");
}

TEST_F(BatchHeader, AFileThatDoesNotSayWhatIsAttachedIsOneWithoutIt) {
  ASSERT_EQ(batch({}).exitCode, 0);
  ordered_json old = header();
  old.erase("attach");
  setHeader(old);
  EXPECT_EQ(batch({}).exitCode, 0);
  EXPECT_EQ(runSwept({"bench", "summary", file_}).exitCode, 0);
  expectRefused(batch({"--attach", "sphere:0.1@cube"}),
                ":1: error: attach is []; it is [\"sphere:0.1@cube\"] on the command line");
}

TEST_F(BatchHeader, EachFieldIsRefusedWithoutTheTypeItHas) {
  ASSERT_EQ(batch({}).exitCode, 0);
  const ordered_json written = header();
  const std::vector<std::tuple<std::string, ordered_json, std::string>> cases{
      {"version", "1", "version is \"1\"; this program reads 1"},
      {"swept", 1, "swept is 1; it must be text"},
      {"robot", nullptr, "robot is null; it must be text"},
      {"urdf", true, "urdf is true; it must be text"},
      {"srdf", 7, "srdf is 7; it must be text"},
      {"group", {"both"}, "group is [\"both\"]; it must be text"},
      {"problems", 1.5, "problems is 1.5; it must be text"},
      {"margin", "0", "margin is \"0\"; it must be a finite number"},
      {"tolerance", -1, "tolerance is -1; it must be 0 or more"},
      {"pad", "cube=0.1", "pad must be a list"},
      {"scale", {2}, "scale[0] is 2; it must be text"},
      {"allow", nullptr, "allow must be a list"},
      {"attach", 7, "attach must be a list"},
      {"time_limit", "5", "time_limit is \"5\"; it must be a finite number"},
      {"hard_limit", nullptr, "hard_limit is null; it must be a finite number"},
      {"simplify", "yes", "simplify is \"yes\"; it must be true or false"},
      {"clearance", 1, "clearance is 1; it must be true or false"},
      {"time", 7, "time must be an object"},
      {"time", {{"host", 7}}, "time.host is 7; it must be text"},
      {"time", {{"started", {1}}}, "time.started is [1]; it must be text"}};
  for (const auto& [field, value, message] : cases) {
    ordered_json changed = written;
    changed[field] = value;
    setHeader(changed);
    expectRefused(batch({}), ":1: error: " + message);
    expectRefused(runSwept({"bench", "summary", file_, "--log", gantry_.folder().path("logs")}),
                  ":1: error: " + message);
  }
  for (const auto& [field, value] : written.items()) {
    if (field == "attach" || field == "time" || field == "without_default_contacts") continue;
    ordered_json changed = written;
    changed.erase(field);
    setHeader(changed);
    const Outcome run = batch({});
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_THAT(run.err, HasSubstr(field == "format" ? "not a results file"
                                                     : ":1: error: the header has no " + field));
  }
}

TEST_F(BatchHeader, AFolderIsNoResultsFile) {
  const std::string folder = gantry_.folder().path();
  const Outcome run = runSwept({"bench", "summary", folder});
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.err, folder + ": error: file cannot be read: Is a directory\n");
}

/// As a shell's `<(zcat results.gz)` has it.
TEST_F(BatchHeader, ResultsMayComeThroughAPipe) {
  ASSERT_EQ(batch({}).exitCode, 0);
  const Outcome run = runShell("cat '" + file_ + "' | swept bench summary /dev/stdin");
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(run.out, runSwept({"bench", "summary", file_}).out);
}

/// The header of the file has U+FFFD where the one of the command line has other bytes.
TEST_F(BatchHeader, ABatchWhoseOptionsAreNotUtf8GoesOn) {
  const Words odd{"--pad", "\xff*=0.01", "-q"};
  ASSERT_EQ(batch(odd).exitCode, 0);
  EXPECT_EQ(header()["pad"], ordered_json::array({"\xef\xbf\xbd*=0.01"}));
  const Outcome run = batch(odd);
  EXPECT_EQ(run.exitCode, 0) << run.err;
}

}  // namespace
}  // namespace swept::test
