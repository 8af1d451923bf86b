// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/problems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "data_folder.hpp"
#include "input_files.hpp"

namespace swept {
namespace {

using ::testing::ElementsAre;

const char* const kProblems = R"({
 "shelf": [
  {"index": 1, "world": {"sphere": [{"name": "ball", "position": [1, 2, 3], "radius": 0.5}],
    "cylinder": [{"name": "can", "position": [0, 0, 1], "orientation": [0, 0, 0.6, 0.8],
                  "radius": 0.1, "length": 0.4}],
    "box": [{"name": "board", "position": [0, 1, 0], "orientation": [0, 0, 0, 1],
             "half_extents": [0.5, 0.25, 0.125]}]},
   "start": [0.25, -1], "goals": [[1, 2], [3, 4]], "joint_names": ["a", "b"], "valid": true},
  {"index": 7, "world": {}, "start": [0], "goals": [[1]], "joint_names": ["a"]}],
 "cage": [{"index": 1, "world": {}, "start": [5], "goals": [[6]], "joint_names": ["a"]}]
})";

TEST(Problems, ReadsBodiesAndConfigurations) {
  const test::TemporaryFolder folder;
  const ProblemFile file = ProblemFile::load(folder.write("p.json", kProblems));
  EXPECT_THAT(file.sets(), ::testing::UnorderedElementsAre("shelf", "cage"));
  EXPECT_THAT(file.indices("shelf"), ElementsAre(1, 7));
  EXPECT_THAT(file.indices("none"), ElementsAre());
  const PlanningProblem problem = file.problem("shelf", 1);
  EXPECT_EQ(problem.set, "shelf");
  EXPECT_EQ(problem.index, 1);
  EXPECT_THAT(problem.jointNames, ElementsAre("a", "b"));
  EXPECT_THAT(problem.start, ElementsAre(0.25, -1));
  EXPECT_THAT(problem.goals, ElementsAre(ElementsAre(1, 2), ElementsAre(3, 4)));
  ASSERT_EQ(problem.world.bodies().size(), 3u);
  const auto part = [&](const char* name) { return problem.world.find(name)->parts[0]; };
  EXPECT_EQ(std::get<Sphere>(part("ball").shape).radius, 0.5);
  EXPECT_EQ(part("ball").world_from_shape.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(std::get<Cylinder>(part("can").shape).radius, 0.1);
  EXPECT_EQ(std::get<Cylinder>(part("can").shape).halfLength, 0.2);
  EXPECT_EQ(std::get<Box>(part("board").shape).halfExtents, Eigen::Vector3d(0.5, 0.25, 0.125));
  // The quaternion is x, y, z, w: a turn about z with cos(half) = 0.8.
  const Eigen::Vector3d turned = part("can").world_from_shape.linear() * Eigen::Vector3d::UnitX();
  EXPECT_LT((turned - Eigen::Vector3d(0.28, 0.96, 0)).norm(), 1e-15);
}

TEST(Problems, UnknownSetsAndIndicesNameTheKnown) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("p.json", kProblems);
  const ProblemFile file = ProblemFile::load(path);
  EXPECT_EQ(test::inputError([&] { file.problem("shelf", 2); }),
            path.string() + ": error: set 'shelf' has no problem 2; it has 1, 7");
  EXPECT_EQ(test::inputError([&] { file.problem("table", 1); }),
            path.string() + ": error: there is no set 'table'; there are cage, shelf");
}

/// `sets` named s00 on, each with problems 0, 10, 20, ...
std::string manyProblems(int sets, int problems) {
  std::string text = "{";
  for (int i = 0; i < sets; ++i) {
    text += (i > 0 ? ", \"s" : "\"s") + std::to_string(i / 10) + std::to_string(i % 10) + "\": [";
    for (int j = 0; j < problems; ++j)
      text += (j > 0 ? ", " : "") + ("{\"index\": " + std::to_string(10 * j)) +
              ", \"world\": {}, \"start\": [5], \"goals\": [[6]], \"joint_names\": [\"a\"]}";
    text += "]";
  }
  return text + "}";
}

TEST(Problems, OfManySetsAndIndicesTheNearestAreNamed) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("p.json", manyProblems(60, 30));
  const ProblemFile file = ProblemFile::load(path);
  const auto messageOf = [&](const std::string& set, int index) {
    return test::inputError([&] { file.problem(set, index); });
  };
  const std::string begin = path.string() + ": error: ";
  EXPECT_EQ(messageOf("s3", 0),
            begin +
                "there is no set 's3'; there are 60, among them s25, s26, s27, s28, s29, s30, "
                "s31, s32, s33, s34");
  EXPECT_EQ(messageOf("", 0),
            begin +
                "there is no set ''; there are 60, among them s00, s01, s02, s03, s04, s05, "
                "s06, s07, s08, s09");
  EXPECT_EQ(messageOf("t", 0),
            begin +
                "there is no set 't'; there are 60, among them s50, s51, s52, s53, s54, s55, "
                "s56, s57, s58, s59");
  EXPECT_EQ(messageOf("s07", 101),
            begin +
                "set 's07' has no problem 101; it has 30, among them 60, 70, 80, 90, 100, 110, "
                "120, 130, 140, 150");
}

TEST(Problems, TenSetsAreAllNamed) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("p.json", manyProblems(10, 1));
  EXPECT_EQ(test::inputError([&] { ProblemFile::load(path).problem("s1", 0); }),
            path.string() +
                ": error: there is no set 's1'; there are s00, s01, s02, s03, s04, s05, "
                "s06, s07, s08, s09");
}

TEST(Problems, AFileMayHaveNone) {
  const test::TemporaryFolder folder;
  const auto path = folder.write("p.json", manyProblems(2, 0));
  EXPECT_THAT(ProblemFile::load(path).sets(), ElementsAre());
  EXPECT_EQ(test::inputError([&] { ProblemFile::load(path).problem("s00", 0); }),
            path.string() + ": error: there is no set 's00'; the file has no problems");
}

TEST(Problems, MotionBenchMakerFile) {
  const auto data = dataFolder();
  if (!data || !std::filesystem::exists(*data / "mbm/panda.json")) {
    GTEST_SKIP() << "skipped: SWEPT_DATA is not set";
  }
  const ProblemFile file = ProblemFile::load(*data / "mbm/panda.json");
  ASSERT_EQ(file.sets().size(), 7u);
  std::size_t boxes = 0, cylinders = 0;
  for (const std::string& set : file.sets()) {
    ASSERT_EQ(file.indices(set).size(), 100u) << set;
    for (const int index : file.indices(set)) {
      const PlanningProblem problem = file.problem(set, index);
      EXPECT_EQ(problem.start.size(), 7u);
      for (const WorldBody& body : problem.world.bodies()) {
        boxes += std::holds_alternative<Box>(body.parts[0].shape) ? 1 : 0;
        cylinders += std::holds_alternative<Cylinder>(body.parts[0].shape) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(boxes, 5500u);
  EXPECT_EQ(cylinders, 2700u);
}

}  // namespace
}  // namespace swept
