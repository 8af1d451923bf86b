// SPDX-License-Identifier: BSD-3-Clause
// Takes one thing out of a valid scene, or makes it another: byte 0 chooses which, byte 1 how. What
// comes of the file has to be other than before, or a refusal, unless the table of formats says
// that the key has no meaning. A proof about less than the file says is a find.
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <map>
#include <optional>
#include <vector>

#include "fuzz_input.hpp"
#include "models_dir.hpp"
#include "scene_summary.hpp"

using namespace swept;

namespace {

constexpr int kMostChanges = 48;  // of one input

const char* const kScene = R"(name: s
robot_model_name: two
robot_state:
  joint_state: {header: {frame_id: base}, name: [jl, jr], position: [0.5, -0.25], velocity: [1], effort: [1]}
  multi_dof_joint_state: {joint_names: [vj], transforms: [{translation: {x: 1, y: 2, z: 0}, rotation: {x: 0, y: 0, z: 0.6, w: 0.8}}]}
  attached_collision_objects:
    - {link_name: l, object: {id: rod, header: {frame_id: r}, pose: {position: {x: 0, y: 0, z: 0.5}}, primitives: [{type: box, dimensions: [0.1, 0.2, 4]}]}, touch_links: [lid, cap]}
    - {link_name: r, object: {id: cap}}
fixed_frame_transforms:
  - {header: {frame_id: table}, child_frame_id: odom, transform: {translation: {x: 0, y: 0, z: 1}, rotation: {x: 0, y: 0.6, z: 0, w: 0.8}}}
allowed_collision_matrix:
  entry_names: [l, r, one, rod]
  entry_values: [{enabled: [true, false, true, false]}, {enabled: [false, true, false, true]}, {enabled: [true, false, true, false]}, {enabled: [false, true, false, true]}]
  default_entry_names: [two]
  default_entry_values: [true]
world:
  collision_objects:
    - id: one
      header: {stamp: 3, frame_id: table}
      pose: {position: {x: 1, y: 2, z: 3}, orientation: {x: 0.6, y: 0, z: 0, w: 0.8}}
      primitives: [{type: cylinder, dimensions: [2, 0.1]}]
      primitive_poses: [{position: {x: 0, y: 3, z: 0}}]
      subframe_names: [top]
      subframe_poses: [{position: {x: 0, y: 0, z: 1}}]
    - {id: two, header: {frame_id: one/top}, planes: [{coef: [0, 0, 1, 2]}], plane_poses: [{position: {x: 0, y: 0, z: 5}}]}
    - {id: cap, header: {frame_id: rod}, primitives: [{type: sphere, dimensions: [0.3]}]}
object_colors: [{id: one, color: {r: 1}}]
)";

/// A value of the scene: the steps to it are keys and places in lists.
struct Place {
  std::vector<std::string> steps;
  std::string key;  ///< as the table of formats has it
  bool isScalar = false;
};

void collect(const YAML::Node& node, const Place& here, std::vector<Place>& places) {
  if (!here.steps.empty()) {
    places.push_back(here);
    places.back().isScalar = node.IsScalar();
  }
  if (node.IsMap())
    for (const auto& entry : node) {
      Place below = here;
      below.steps.push_back(entry.first.Scalar());
      below.key += (here.key.empty() ? "" : "/") + entry.first.Scalar();
      // One object is like another, wherever it stands.
      if (below.key == "world/collision_objects") below.key = "collision_objects";
      if (below.key == "robot_state/attached_collision_objects/object/id")
        below.key = "collision_objects/id";
      collect(entry.second, below, places);
    }
  if (node.IsSequence())
    for (std::size_t i = 0; i < node.size(); ++i) {
      Place below = here;
      below.steps.push_back(std::to_string(i));
      collect(node[i], below, places);
    }
}

std::string otherScalar(const std::string& value, unsigned how) {
  if (value == "true") return "false";
  if (value == "false") return "true";
  char* end = nullptr;
  const double number = std::strtod(value.c_str(), &end);
  if (end != value.c_str() && *end == '\0') return std::to_string(number + 0.125 * (1 + how % 7));
  static const char* const kNames[] = {"l",  "r",  "rod",  "one",    "two",   "table",
                                       "jl", "jr", "odom", "sphere", "nobody"};
  const std::string other = kNames[how % std::size(kNames)];
  return other == value ? value + "x" : other;
}

/// False: there is no such change.
bool change(YAML::Node root, const Place& place, unsigned how) {
  YAML::Node parent = root;
  for (std::size_t i = 0; i + 1 < place.steps.size(); ++i)
    parent.reset(parent.IsMap() ? parent[place.steps[i]] : parent[std::stoul(place.steps[i])]);
  const std::string& last = place.steps.back();
  if (how % 2 == 0) return parent.IsMap() ? parent.remove(last) : parent.remove(std::stoul(last));
  if (!place.isScalar) return false;
  YAML::Node value = parent.IsMap() ? parent[last] : parent[std::stoul(last)];
  value = otherScalar(value.Scalar(), how / 2);
  return true;
}

/// Keys of the table that have no meaning. What is below such a key has none either.
bool hasNoMeaning(const std::string& key) {
  static const std::map<std::string, bool> kRows = [] {
    std::map<std::string, bool> rows;
    std::ifstream file(modelsDir() + "/../robot_model/FORMATS.md");
    std::string line;
    bool inside = false;
    while (std::getline(file, line)) {
      if (line.starts_with("## ")) inside = line.starts_with("## Planning scene");
      const std::size_t end = line.find("` | ");
      if (inside && line.starts_with("| `") && end != std::string::npos)
        rows.emplace(line.substr(3, end - 3), line.substr(end + 4).starts_with("no meaning"));
    }
    if (rows.empty()) fuzz::fail("no table of the format");
    return rows;
  }();
  for (std::string above = key;; above.resize(above.rfind('/'))) {
    if (const auto row = kRows.find(above); row != kRows.end()) return row->second;
    if (above.find('/') == std::string::npos) break;
  }
  fuzz::fail("the table has no row for " + key);
}

/// The matrix says nothing of a body and itself.
bool isDiagonal(const Place& place) {
  return place.key.ends_with("/enabled") && place.steps.size() == 5 &&
         place.steps[2] == place.steps[4];
}

/// Empty: refused.
std::optional<std::string> answerTo(const std::string& text) {
  static const auto kRobot = test::twoArms();
  const auto file = fuzz::files().write("planning_scene.yaml", text);
  std::optional<std::string> answer;
  fuzz::mayRefuse([&] { answer = test::summaryOf(PlanningScene::load(file, *kRobot)); });
  return answer;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string kBefore = answerTo(kScene).value_or("");
  if (kBefore.empty()) fuzz::fail("the scene itself is refused");
  static const std::vector<Place> kPlaces = [] {
    std::vector<Place> places;
    collect(YAML::Load(kScene), {}, places);
    return places;
  }();
  fuzz::Numbers numbers(data, size);
  for (int changes = 0; changes < kMostChanges && !numbers.isEmpty(); ++changes) {
    const std::size_t high = numbers.byte();
    const Place& place = kPlaces[(256 * high + numbers.byte()) % kPlaces.size()];
    const unsigned how = numbers.byte();
    if (isDiagonal(place)) continue;
    const YAML::Node scene = YAML::Load(kScene);
    if (!change(scene, place, how)) continue;
    const std::string text = YAML::Dump(scene);
    if (answerTo(text) == kBefore && !hasNoMeaning(place.key))
      fuzz::fail("nothing came of a change of " + place.key + ":\n" + text);
  }
  return 0;
}
