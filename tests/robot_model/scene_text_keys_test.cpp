// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "format_table.hpp"
#include "input_files.hpp"
#include "scene_summary.hpp"
#include "swept/robot_model/planning_scene.hpp"

namespace swept {
namespace {

/// What MoveIt writes of a ball with a subframe.
std::string scene(const std::string& name, const std::string& id, const std::string& objectPose,
                  const std::string& shape, const std::string& shapePose, const std::string& colour,
                  const std::string& subframe) {
  return name + "\n* " + id + "\n" + objectPose + "\n0 0 0 1\n1\n" + shape + "\n" + shapePose +
         "\n0 0 0 1\n" + colour + "\n1\n" + subframe + "\n0 0 1\n0 0 0 1\n.\n";
}

TEST(SceneTextKeys, EachIsAppliedOrWithoutMeaning) {
  const std::string ball = "sphere\n0.5", no = "0 0 0 0";
  const std::string base = scene("s", "a", "1 0 0", ball, "0 2 0", no, "top");
  const std::vector<test::KeyCase> cases{
      {"name", base, scene("t", "a", "1 0 0", ball, "0 2 0", no, "top")},
      {"id", base, scene("s", "b", "1 0 0", ball, "0 2 0", no, "top")},
      {"object_pose", base, scene("s", "a", "2 0 0", ball, "0 2 0", no, "top")},
      {"shape", base, scene("s", "a", "1 0 0", "sphere\n0.6", "0 2 0", no, "top")},
      {"shape", base, scene("s", "a", "1 0 0", "box\n1 1 1", "0 2 0", no, "top")},
      {"shape_pose", base, scene("s", "a", "1 0 0", ball, "0 3 0", no, "top")},
      {"colour", base, scene("s", "a", "1 0 0", ball, "0 2 0", "1 0 0 1", "top")},
      {"subframe", base, scene("s", "a", "1 0 0", ball, "0 2 0", no, "side")},
      {"text after the end", base, base + "s\n.\n"},
  };
  const test::TemporaryFolder folder;
  const auto robot = test::twoArms();
  test::walkFormat("MoveIt text (.scene)", cases, [&](const std::string& text) {
    return test::summaryOf(PlanningScene::load(folder.write("s.scene", text), *robot));
  });
}

}  // namespace
}  // namespace swept
