// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include "format_keys.hpp"
#include "format_table.hpp"
#include "input_files.hpp"
#include "scene_summary.hpp"
#include "swept/robot_model/problems.hpp"

namespace swept {
namespace {

const std::string kProblems = R"({"s": [{"index": 1, "valid": true, "joint_names": ["jl"],
 "start": [0], "goals": [[1]], "world": {
  "sphere": [{"name": "a", "position": [1, 2, 3], "radius": 0.5}],
  "cylinder": [{"name": "b", "position": [1, 2, 4], "orientation": [0, 0, 0.6, 0.8],
                "object_pose": [1, 0, 4, 0, 0, 0, 1], "primitive_pose": [0, 2, 0, 0, 0, 0.6, 0.8],
                "radius": 0.25, "length": 2}],
  "box": [{"name": "c", "position": [1, 2, 5], "orientation": [0, 0, 0, 1],
           "half_extents": [1, 2, 3]}]}}]})";

std::string summaryOf(const ProblemFile& file) {
  std::ostringstream text;
  for (const std::string& set : file.sets())
    for (const int index : file.indices(set)) {
      const PlanningProblem problem = file.problem(set, index);
      text << set << ' ' << index;
      for (const std::string& name : problem.jointNames) text << ' ' << name;
      for (const double value : problem.start) text << ' ' << value;
      for (const auto& goal : problem.goals)
        for (const double value : goal) text << ' ' << value;
      text << '\n';
      test::addBodies(problem.world, text);
    }
  return text.str();
}

TEST(ProblemsKeys, EachIsAppliedRefusedOrWithoutMeaning) {
  std::vector<test::KeyCase> cases;
  for (const auto& [key, from, to] : std::vector<std::array<const char*, 3>>{
           {"index", R"("index": 1)", R"("index": 2)"},
           {"valid", "true", "false"},
           {"joint_names", R"(["jl"])", R"(["jr"])"},
           {"start", R"("start": [0])", R"("start": [2])"},
           {"goals", "[[1]]", "[[1], [2]]"},
           {"world", R"("name": "a", "position": [1, 2, 3])",
            R"("name": "a", "position": [1, 2, 9])"},
           {"world/sphere", R"([{"name": "a", "position": [1, 2, 3], "radius": 0.5}])", "[]"},
           {"world/cylinder", R"("length": 2}])", R"("length": 3}])"},
           {"world/box", R"([1, 2, 3]}])", R"([1, 2, 4]}])"},
           {"name", R"("name": "a")", R"("name": "d")"},
           {"position", "[1, 2, 5]", "[1, 2, 6]"},
           {"orientation", "[0, 0, 0, 1],\n           \"half", "[0, 0, 0.6, 0.8], \"half"},
           {"object_pose", "[1, 0, 4, 0, 0, 0, 1], \"primitive_pose\": [0, 2, 0, 0, 0, 0.6, 0.8]",
            "[1, 1, 4, 0, 0, 0.6, 0.8]"},
           {"primitive_pose", "[0, 2, 0, 0, 0, 0.6, 0.8]", "[0, 2, 0, 0, 0, 0, 1]"},
           {"radius", R"("radius": 0.25)", R"("radius": 0.5)"},
           {"length", R"("length": 2)", R"("length": 4)"},
           {"half_extents", "[1, 2, 3]}", "[2, 2, 3]}"}}) {
    std::string text = kProblems;
    const std::string what = from;
    ASSERT_NE(text.find(what), std::string::npos) << what;
    cases.push_back({key, kProblems, text.replace(text.find(what), what.size(), to)});
  }
  const test::TemporaryFolder folder;
  test::walkFormat("Problems (.json)", cases, [&](const std::string& text) {
    return summaryOf(ProblemFile::load(folder.write("p.json", text)));
  });
}

TEST(ProblemsKeys, TheTableHasTheReadersKeys) {
  test::expectKeysOf("Problems (.json)", {"problems.cpp", "json_place.hpp"});
}

}  // namespace
}  // namespace swept
