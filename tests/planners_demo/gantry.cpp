// SPDX-License-Identifier: BSD-3-Clause
#include "gantry.hpp"

#include <algorithm>
#include <cmath>

namespace swept::test {
namespace {

constexpr const char* kUrdf = R"(<?xml version="1.0"?>
<robot name="gantry">
  <link name="rail"/>
  <link name="beam"/>
  <link name="cube">
    <collision>
      <geometry><box size="0.2 0.2 0.2"/></geometry>
    </collision>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="rail"/>
    <child link="beam"/>
    <axis xyz="1 0 0"/>
    <limit lower="-0.5" upper="2.5" effort="1" velocity="1"/>
  </joint>
  <joint name="lift" type="prismatic">
    <parent link="beam"/>
    <child link="cube"/>
    <axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
)";

constexpr const char* kSrdf = R"(<?xml version="1.0"?>
<robot name="gantry">
  <group name="both"><joint name="slide"/><joint name="lift"/></group>
  <group name="slider"><joint name="slide"/></group>
  <group_state name="left" group="both">
    <joint name="slide" value="0"/><joint name="lift" value="0"/>
  </group_state>
  <group_state name="right" group="both">
    <joint name="slide" value="2"/><joint name="lift" value="0"/>
  </group_state>
  <group_state name="inside" group="both">
    <joint name="slide" value="1"/><joint name="lift" value="0.1"/>
  </group_state>
</robot>
)";

constexpr const char* kScene = R"(name: one post
world:
  collision_objects:
    - id: post
      operation: add
      header: {frame_id: world}
      primitives:
        - {type: box, dimensions: [0.2, 0.2, 0.2]}
      primitive_poses:
        - {position: [1, 0, 0], orientation: [0, 0, 0, 1]}
)";

// Joint names in the other order than the group's. `blocked` has a wall that no path passes.
constexpr const char* kProblems = R"({
"over": [
  {"index": 1, "world": {"box": [{"name": "post", "position": [1, 0, 0], "orientation": [0, 0, 0, 1], "half_extents": [0.1, 0.1, 0.1]}]},
   "start": [0, 0], "goals": [[0, 2]], "joint_names": ["lift", "slide"]},
  {"index": 2, "world": {"sphere": [{"name": "ball", "position": [1, 0, 0], "radius": 0.1}]},
   "start": [0, 2], "goals": [[0, 0], [0, 0.5]], "joint_names": ["lift", "slide"]}],
"blocked": [
  {"index": 7, "world": {"box": [{"name": "wall", "position": [1, 0, 0], "orientation": [0, 0, 0, 1], "half_extents": [0.1, 0.1, 5]}]},
   "start": [0, 0], "goals": [[0, 2]], "joint_names": ["lift", "slide"]},
  {"index": 8, "world": {"box": [{"name": "post", "position": [1, 0, 0], "orientation": [0, 0, 0, 1], "half_extents": [0.1, 0.1, 0.1]}]},
   "start": [0, 1], "goals": [[0, 2]], "joint_names": ["lift", "slide"]},
  {"index": 9, "world": {},
   "start": [0, 3], "goals": [[0, 2]], "joint_names": ["lift", "slide"]}],
"foreign": [
  {"index": 1, "world": {}, "start": [0, 1], "goals": [[0, 2]], "joint_names": ["lift", "swing"]}]
}
)";

}  // namespace

Gantry::Gantry()
    : urdf(folder_.write("gantry.urdf", kUrdf)),
      srdf(folder_.write("gantry.srdf", kSrdf)),
      scene(folder_.write("post.yaml", kScene)),
      problems(folder_.write("problems.json", kProblems)) {}

std::vector<std::string> Gantry::arguments(const std::string& command,
                                           const std::vector<std::string>& more) const {
  std::vector<std::string> all{command, urdf};
  all.insert(all.end(), more.begin(), more.end());
  if (std::ranges::find(more, "--problems") == more.end())
    all.insert(all.end(), {"--scene", scene});
  if (std::ranges::find(more, "--group") == more.end()) all.insert(all.end(), {"--group", "both"});
  return all;
}

Outcome Gantry::run(const std::string& command, const std::vector<std::string>& more) const {
  return runSwept(arguments(command, more));
}

Outcome Gantry::plan(const std::vector<std::string>& more) const {
  Outcome last;
  for (const std::string limit : {"0.2", "2", "20"}) {
    std::vector<std::string> all = more;
    all.insert(all.end(), {"--time", limit});
    last = run("plan", all);
    if (last.exitCode != 1) break;
  }
  return last;
}

double Gantry::distance(double slide, double lift) {
  const double x = std::max(0.0, std::abs(slide - 1.0) - 0.2);
  const double z = std::max(0.0, std::abs(lift) - 0.2);
  return std::hypot(x, z);
}

double Gantry::leastDistance(std::span<const double> from, std::span<const double> to) {
  constexpr int kSamples = 20000;
  double least = INFINITY;
  for (int i = 0; i <= kSamples; ++i) {
    const double t = static_cast<double>(i) / kSamples;
    least =
        std::min(least, distance(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])));
  }
  return least;
}

}  // namespace swept::test
