// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <Eigen/Geometry>
#include <array>

#include "places.hpp"
#include "verify/encoding.hpp"

namespace forgeries {
namespace {

using Eigen::Vector3d;

Json jsonOf(const Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Vector3d direction(Random& random) {
  if (random.chance(0.3)) return random.sign() * Vector3d::Unit(static_cast<int>(random.below(3)));
  return Vector3d(random.normal(), random.normal(), random.normal()).normalized();
}

std::string pointsText(Random& random, std::size_t count, double size) {
  std::vector<double> numbers(3 * count);
  for (double& number : numbers) number = random.uniform(-size, size);
  return swept::verify::base64Of(std::span<const double>(numbers));
}

/// A tetrahedron, its triangles facing outward.
Json meshJson(Random& random) {
  const double size = random.uniform(0.1, 0.4);
  const std::vector<double> numbers{0, 0, 0, size, 0, 0, 0, size, 0, 0, 0, size};
  const std::vector<std::uint32_t> corners{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  return {{"type", "mesh"},
          {"vertices", swept::verify::base64Of(std::span<const double>(numbers))},
          {"triangles", swept::verify::base64Of(std::span<const std::uint32_t>(corners))},
          {"solid", random.chance(0.5)}};
}

Json shapeJson(Random& random, bool mayBeFlat) {
  const double size = random.uniform(0.05, 0.3), other = random.uniform(0.05, 0.3);
  switch (random.below(mayBeFlat ? 11 : 9)) {
    case 0:
      return {{"type", "sphere"}, {"radius", size}};
    case 1:
      return {{"type", "box"}, {"half_extents", {size, other, 0.5 * size}}};
    case 2:
      return {{"type", "capsule"}, {"radius", size}, {"half_length", other}};
    case 3:
      return {{"type", "cylinder"}, {"radius", size}, {"half_length", other}};
    case 4:
      return {{"type", "cone"}, {"radius", size}, {"half_length", other}};
    case 5:
      return {{"type", "ellipsoid"}, {"semi_axes", {size, other, 0.5 * other}}};
    case 6:
      return {{"type", "convex"},
              {"vertices", pointsText(random, 1 + random.below(5), size)},
              {"error", random.chance(0.5) ? 0.0 : 0.1 * other}};
    case 7:
      return meshJson(random);
    case 8:
      return {{"type", "cloud"},
              {"points", pointsText(random, 1 + random.below(3), size)},
              {"radii", 0.2 * other}};
    case 9:
      return {{"type", "plane"}, {"normal", unitJson(random)}, {"offset", random.uniform(-1, 1)}};
    default:
      return {
          {"type", "half_space"}, {"normal", unitJson(random)}, {"offset", random.uniform(-1, 1)}};
  }
}

Json bodyJson(Random& random, const std::string& name, const Json& link) {
  Json body = {{"name", name}, {"link", link}, {"shapes", Json::array()}};
  const std::size_t count = random.chance(0.7) ? 1 : 2;
  for (std::size_t i = 0; i < count; ++i) {
    Json shape = shapeJson(random, link.is_null());
    shape["pose"] = poseJson(random, link.is_null() ? 2.0 : 0.3);
    body["shapes"].push_back(std::move(shape));
  }
  return body;
}

constexpr std::array kKinds = {"prismatic", "prismatic", "revolute", "continuous",
                               "planar",    "floating",  "fixed"};

std::size_t valuesOf(const std::string& type) {
  return type == "floating" ? 7 : type == "planar" ? 3 : type == "fixed" ? 0 : 1;
}

void addVariables(Random& random, const std::string& type, Json& model, Json& joint) {
  Json& variables = model["variables"];
  const std::size_t count = valuesOf(type), first = variables.size();
  joint["multiplier"] = 1.0;
  joint["offset"] = 0.0;
  if (random.chance(0.1)) {
    joint["variable"] = nullptr;
    joint["values"] = Json::array();
    for (std::size_t i = 0; i < count; ++i) joint["values"].push_back(random.uniform(-1.0, 1.0));
    return;
  }
  if (count == 1 && first > 0 && random.chance(0.4)) {  // mimics
    joint["variable"] = random.below(first);
    joint["multiplier"] = random.pick({-1.0, 0.5, 2.0, 3.0});
    joint["offset"] = random.uniform(-0.5, 0.5);
    return;
  }
  joint["variable"] = first;
  for (std::size_t i = 0; i < count; ++i)
    variables.push_back({{"name", joint["name"].get<std::string>() + std::to_string(i)},
                         {"lower", nullptr},
                         {"upper", nullptr},
                         {"cyclic", false}});
}

/// Cyclic variables, where all that follow them may.
void makeCyclic(Random& random, Json& model) {
  for (std::size_t v = 0; v < model["variables"].size(); ++v) {
    bool mayBe = true;
    for (const Json& joint : model["joints"]) {
      if (joint["variable"] != v) continue;
      const std::string type = joint["type"];
      const double multiplier = joint["multiplier"];
      mayBe = mayBe && (type == "revolute" || type == "continuous" || valuesOf(type) > 1) &&
              multiplier == std::round(multiplier);
    }
    model["variables"][v]["cyclic"] = mayBe && random.chance(0.5);
  }
}

Json nearBy(Random& random, const Json& model, const Json& state) {
  const double share = random.scale(-4.0, 0.3);
  Json next = state;
  for (Json& value : next) value = value.get<double>() + share * random.uniform(-1.0, 1.0);
  return random.chance(0.05) && model["variables"].size() > 0 ? state : next;
}

/// A value of a quaternion, which may not change on a curve.
bool isOrientation(const Json& model, std::size_t variable) {
  for (const Json& joint : model["joints"])
    if (typeOf(joint) == "floating" && !joint["variable"].is_null() &&
        variable >= joint["variable"].get<std::size_t>() + 3 &&
        variable < joint["variable"].get<std::size_t>() + 7)
      return true;
  return false;
}

Json ratesJson(Random& random, const Json& model) {
  const double most = random.scale(-3.0, 0.5);
  Json rates = Json::array();
  for (std::size_t v = 0; v < model["variables"].size(); ++v)
    rates.push_back(isOrientation(model, v) ? 0.0 : random.uniform(-most, most));
  return rates;
}

/// Makes the states points of a trajectory.
void addTrajectory(Random& random, Json& path) {
  const Json& model = path["model"];
  Json points = Json::array();
  double time = random.uniform(0.0, 3.0);
  const bool curved = random.chance(0.8), quintic = random.chance(0.5);
  for (Json& state : path["states"]) {
    for (std::size_t v = 0; curved && v < state.size(); ++v)
      if (isOrientation(model, v)) state[v] = path["states"][0][v];
    Json point = {{"time", time}, {"positions", state}};
    if (curved) point["velocities"] = ratesJson(random, model);
    if (curved && quintic) point["accelerations"] = ratesJson(random, model);
    points.push_back(std::move(point));
    time += random.uniform(0.1, 2.0);
  }
  path["trajectory"] = {{"variables", path["joint_names"]}, {"points", std::move(points)}};
}

void addTube(Random& random, Json& model) {
  for (const Json& joint : model["joints"]) {
    const std::string type = typeOf(joint), name = joint["name"];
    if (joint["variable"].is_null() || type == "fixed" || joint["multiplier"] != 1.0 ||
        random.chance(0.3))
      continue;
    if (type != "prismatic") model["tracking"][name]["rotation"] = random.scale(-5.0, -1.5);
    if (type != "revolute" && type != "continuous")
      model["tracking"][name]["translation"] = random.scale(-5.0, -1.5);
  }
}

}  // namespace

Json unitJson(Random& random) {
  return jsonOf(direction(random));
}

Json poseJson(Random& random, double farthest) {
  Eigen::Quaterniond turn(random.normal(), random.normal(), random.normal(), random.normal());
  turn.normalize();
  if (random.chance(0.3)) turn.setIdentity();
  const Eigen::Matrix3d rotation = turn.toRotationMatrix();
  Json numbers = Json::array();
  for (int i = 0; i < 9; ++i) numbers.push_back(rotation(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) numbers.push_back(random.uniform(-farthest, farthest));
  return numbers;
}

Json makeScene(Random& random) {
  Json model = {{"links", {"base"}}, {"variables", Json::array()}, {"joints", Json::array()}};
  const std::size_t joints = 1 + random.below(3);
  for (std::size_t i = 0; i < joints; ++i) {
    const std::string type = kKinds[random.below(kKinds.size())];
    const std::string link = "link" + std::to_string(i + 1);
    Json joint = {{"name", "j" + std::to_string(i)}, {"type", type}};
    joint["parent"] = random.chance(0.8) ? model["links"].back() : Json("base");
    joint["child"] = link;
    joint["pose"] = poseJson(random, 0.5);
    joint["axis"] = unitJson(random);
    if (type == "planar") {
      const Vector3d axis = direction(random);
      joint["axis"] = jsonOf(axis);
      joint["planar_x"] = jsonOf(axis.unitOrthogonal());
    }
    addVariables(random, type, model, joint);
    model["links"].push_back(link);
    model["joints"].push_back(std::move(joint));
  }
  makeCyclic(random, model);
  model["bodies"] = {bodyJson(random, "hand", model["links"].back())};
  if (joints > 1 && random.chance(0.4)) model["bodies"].push_back(bodyJson(random, "arm", "link1"));
  model["bodies"].push_back(bodyJson(random, "wall", nullptr));
  if (random.chance(0.3)) model["bodies"].push_back(bodyJson(random, "post", nullptr));
  model["margin"] = 0.0;
  model["paddings"] = Json::object();
  model["allowed"] = Json::array();

  Json path = {{"joint_names", Json::array()}, {"margin", 0.0}};
  Json state = Json::array();
  for (const Json& variable : model["variables"]) {
    path["joint_names"].push_back(variable["name"]);
    state.push_back(random.uniform(-1.0, 1.0));
  }
  path["states"] = {state};
  const std::size_t count = random.chance(0.8) ? 2 : 3;
  while (path["states"].size() < count)
    path["states"].push_back(nearBy(random, model, path["states"].back()));
  if (random.chance(0.3)) addTube(random, model);
  path["model"] = std::move(model);
  if (random.chance(0.4)) addTrajectory(random, path);
  return path;
}

}  // namespace forgeries
