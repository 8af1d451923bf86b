// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include "program.hpp"
#include "urdf_text.hpp"

/// What fits the 80 columns of a terminal, on a robot with long names.
namespace swept::test {
namespace {

constexpr std::size_t kColumns = 80;
constexpr int kJoints = 8;

std::string linkName(int i) {
  std::string name = "left_shoulder_upper_housing_with_cable_guide_link_";
  return name.append(std::to_string(i));
}

std::string jointName(int i) {
  std::string name = "left_shoulder_lift_and_pan_motor_joint_";
  return name.append(std::to_string(i));
}

class Narrow : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    std::string urdf =
        "<robot name='robot_of_two_arms_with_long_names'><link name='" + linkName(0) + "'/>";
    std::string joints, values;
    for (int i = 1; i <= kJoints; ++i) {
      urdf += "<link name='" + linkName(i) +
              "'><collision><geometry><sphere radius='0.04'/></geometry></collision></link>" +
              joint(jointName(i), "revolute", linkName(i - 1), linkName(i),
                    "<origin xyz='0 0 0.1'/>" + limited("1 0 0", -2.9, 2.9));
      joints += "<joint name='" + jointName(i) + "'/>";
      values += "<joint name='" + jointName(i) + "' value='0.1'/>";
    }
    folder_->write("r.urdf", urdf + "</robot>");
    folder_->write("r.srdf",
                   "<robot name='robot_of_two_arms_with_long_names'><group "
                   "name='left_arm_with_gripper_and_camera'>" +
                       joints +
                       "</group><group_state name='folded_for_transport_in_the_van' "
                       "group='left_arm_with_gripper_and_camera'>" +
                       values + "</group_state><disable_collisions link1='" + linkName(1) +
                       "' link2='" + linkName(8) + "' reason='Never'/></robot>");
    std::string objects;
    for (int i = 0; i < 3; ++i)
      objects += "    - id: cupboard_of_the_kitchen_door_number_" + std::to_string(i) +
                 "\n      primitives: [{type: box, dimensions: [0.1, 0.1, 0.1]}]\n"
                 "      primitive_poses: [{position: [" +
                 std::to_string(0.5 + i) + ", 0.9, 0.3], orientation: [0, 0, 0, 1]}]\n";
    folder_->write("s.yaml", "world:\n  collision_objects:\n" + objects);
  }
  static void TearDownTestSuite() { delete folder_; }

  /// The words of a command line with the robot's file behind the subcommand.
  static std::vector<std::string> words(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> all;
    for (std::string word; stream >> word;)
      all.push_back(word.starts_with("@") ? folder_->path(word.substr(1)) : word);
    return all;
  }

  static TemporaryFolder* folder_;
};

TemporaryFolder* Narrow::folder_ = nullptr;

std::size_t charactersOf(const std::string& line) {
  return static_cast<std::size_t>(
      std::ranges::count_if(line, [](char c) { return (c & 0xc0) != 0x80; }));
}

/// It could not be broken anywhere: one word, behind blanks and at most one title.
bool isOneWord(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    if (word != "\\") words.push_back(word);
  return words.size() == 1;
}

void expectNarrow(const std::string& text, const std::string& command) {
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    EXPECT_TRUE(charactersOf(line) <= kColumns || isOneWord(line)) << command << "\n" << line;
}

/// Names that people have given: those with an underscore. Titles may be left out where a column is
/// empty, and numbers of times differ from run to run.
std::set<std::string> namesIn(const std::string& text) {
  std::set<std::string> names;
  std::string name;
  for (const char c : text + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
      name += c;
      continue;
    }
    if (name.find('_') != std::string::npos) names.insert(name);
    name.clear();
  }
  return names;
}

constexpr const char* kHome = "folded_for_transport_in_the_van";

/// Each twice: in a pipe, where lines are as long as they are, and in 80 columns.
TEST_F(Narrow, EveryTextFitsAndNothingIsLost) {
  const std::string other = " 0.2,0.2,0.2,0.2,0.2,0.2,0.2,-0.2 ", home = kHome;
  const std::string bad = " 2.8,2.8,2.8,2.8,2.8,2.8,2.8,2.8 ";
  const std::vector<std::string> lines{
      "info @r.urdf --scene @s.yaml --group left_arm_with_gripper_and_camera --explain " +
          linkName(1) + "," + linkName(5),
      "check @r.urdf " + home + other + bad + "--scene @s.yaml",
      "motion @r.urdf " + home + other + bad + "--scene @s.yaml",
      "plan @r.urdf " + home + other + "--scene @s.yaml",
      "plan @r.urdf " + home + bad + "--scene @s.yaml",
      "acm @r.urdf --samples 50 --budget 20000",
      "replay models/cases.json",
      "plan models/robots/rook7/rook7.urdf --group arm --problems "
      "models/problems.json --set shelf",
      "bench planners models/robots/rook7/rook7.urdf --group arm --problems "
      "models/problems.json --set shelf -q",
      "bench edges models/robots/rook7/rook7.urdf --group arm --problems "
      "models/problems.json --edges models/edges.csv --passes 1 --limit 40",
      "report models/robots/rook7/rook7.urdf --group arm --scene "
      "models/scenes/shelf.yaml --motions 10 --passes 1 -q"};
  for (const std::string& line : lines) {
    const Outcome wide = runSwept(words(line));
    const Outcome narrow = runOnTerminal(words(line), kColumns, {"NO_COLOR=1"});
    EXPECT_NE(wide.exitCode, 3) << line << "\n" << wide.err;
    EXPECT_EQ(narrow.exitCode, wide.exitCode) << line;
    expectNarrow(narrow.out, line);
    const std::set<std::string> found = namesIn(narrow.out);
    for (const std::string& name : namesIn(wide.out))
      EXPECT_TRUE(found.contains(name)) << line << "\n" << name << " is not in\n" << narrow.out;
  }
}

TEST_F(Narrow, HelpFits) {
  for (const std::string command :
       {"",           "info",    "check",         "motion",         "plan",
        "line",       "roadmap", "roadmap build", "roadmap update", "roadmap query",
        "verify",     "acm",     "cover",         "replay",         "report",
        "completion", "bench",   "bench edges",   "bench planners", "bench summary"})
    expectNarrow(runOnTerminal(words(command + " --help"), kColumns).out, command + " --help");
}

TEST_F(Narrow, ColumnsOfTheEnvironmentCountAndOthersDoNot) {
  const std::string line = "check @r.urdf " + std::string(kHome);
  const auto longest = [](const std::string& text) {
    std::size_t most = 0;
    std::istringstream stream(text);
    for (std::string one; std::getline(stream, one);) most = std::max(most, one.size());
    return most;
  };
  const std::size_t whole = longest(runSwept(words(line)).out);
  ASSERT_GT(whole, 100u);
  EXPECT_EQ(longest(runOnTerminal(words(line), 400).out) > 100, true);
  EXPECT_LE(longest(runOnTerminal(words(line), 400, {"COLUMNS=80", "NO_COLOR=1"}).out), kColumns);
  EXPECT_EQ(longest(runOnTerminal(words(line), 400, {"COLUMNS=8x", "NO_COLOR=1"}).out), whole);
  EXPECT_EQ(longest(runOnTerminal(words(line), 0).out), whole)
      << "mpirun gives its processes terminals that have no width, and takes what they write";
}

/// JSON is one text for all.
TEST_F(Narrow, JsonIsAsItIs) {
  const std::string line = "check @r.urdf " + std::string(kHome) + " --json";
  EXPECT_EQ(runOnTerminal(words(line), 40).out, runSwept(words(line)).out);
}

}  // namespace
}  // namespace swept::test
