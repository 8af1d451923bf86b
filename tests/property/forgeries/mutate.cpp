// SPDX-License-Identifier: BSD-3-Clause
#include "mutate.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "cancel.hpp"
#include "places.hpp"

namespace forgeries {
namespace {

constexpr double kPi = std::numbers::pi;

double extreme(Random& random) {
  return random.sign() *
         random.pick({0.0, 5e-324, 1e-310, 2.3e-308, 1e-200, 1e-160, 1e-20, 1e-9, 1.0, 1e9, 1e16,
                      1e30, 1e100, 1e150, 1.3e154, 1e160, 1e200, 1.7e308});
}

bool mutateAxis(Json& path, Random& random) {
  Json* joint = any(path["model"]["joints"], random);
  Json* shape = anyShape(path, random);
  const bool wall = shape != nullptr && shape->contains("normal") && random.chance(0.5);
  if (!wall && joint == nullptr) return false;
  Json& axis = wall ? (*shape)["normal"] : (*joint)["axis"];
  const double length = 1.0 + random.pick({-9e-13, 9e-13, -1.1e-12});
  for (Json& number : axis) number = number.get<double>() * length;
  return true;
}

bool mutateRotation(Json& path, Random& random) {
  Json* joint = any(path["model"]["joints"], random);
  Json* shape = anyShape(path, random);
  const bool ofShape = shape != nullptr && random.chance(0.5);
  if (!ofShape && joint == nullptr) return false;
  Json& pose = ofShape ? (*shape)["pose"] : (*joint)["pose"];
  const bool larger = random.chance(0.3);
  for (std::size_t i = 0; i < 9; ++i)
    pose[i] = larger ? pose[i].get<double>() * (1.0 + 4.9e-13)
                     : pose[i].get<double>() + random.uniform(-3e-13, 3e-13);
  return true;
}

bool mutateTurn(Json& path, Random& random) {
  Json* joint = any(path["model"]["joints"], random);
  if (joint == nullptr || !isSingle(*joint) || typeOf(*joint) == "prismatic") return false;
  const std::size_t v = (*joint)["variable"];
  Json& states = path["states"];
  const double start = states[0][v];
  switch (random.below(4)) {
    case 0:
      states[1][v] = start + 2.0 * kPi * std::round(large(random));
      break;
    case 1:
      states[1][v] = start + random.sign() * kPi;
      break;
    case 2:
      states[1][v] = start + random.sign() * random.scale(0.0, 7.0);
      break;
    default:
      states[0][v] = start + 2.0 * kPi * std::round(large(random));
  }
  return true;
}

bool mutateQuaternion(Json& path, Random& random) {
  Json* joint = any(path["model"]["joints"], random);
  if (joint == nullptr || typeOf(*joint) != "floating" || (*joint)["variable"].is_null())
    return false;
  const std::size_t first = (*joint)["variable"].get<std::size_t>() + 3;
  Json& state = path["states"][1];
  const Json& before = path["states"][0];
  const double length = random.sign() * random.pick({1e-5, 0.5, 1.0, 1e5, 1e100, 1e150, 1.3e154});
  if (random.chance(0.3)) {  // across the first
    state[first] = -before[first + 1].get<double>();
    state[first + 1] = before[first];
    state[first + 2] = -before[first + 3].get<double>();
    state[first + 3] = before[first + 2];
  }
  for (std::size_t i = first; i < first + 4; ++i) state[i] = state[i].get<double>() * length;
  return true;
}

bool mutateSize(Json& path, Random& random) {
  Json* shape = anyShape(path, random);
  if (shape == nullptr) return false;
  bool found = false;
  for (auto& [key, value] : shape->items()) {
    if (key == "pose" || key == "normal") continue;
    const double factor = random.scale(-9.0, 3.0);
    if (value.is_number()) value = value.get<double>() * factor;
    if (value.is_array())
      for (Json& number : value) number = number.get<double>() * factor;
    found = found || value.is_number() || value.is_array();
  }
  return found;
}

bool mutateRule(Json& path, Random& random) {
  Json& model = path["model"];
  const double margin = random.chance(0.2) ? std::abs(extreme(random)) : random.scale(-17.0, -1.0);
  model["margin"] = margin;
  path["margin"] = margin;
  for (const Json& body : model["bodies"])
    if (random.chance(0.5))
      model["paddings"][body["name"].get<std::string>()] =
          random.chance(0.5) ? margin * 0x1p-53 : random.scale(-17.0, -1.0);
  return true;
}

void numbersIn(Json& json, std::vector<Json*>& numbers) {
  if (json.is_number_float()) numbers.push_back(&json);
  if (json.is_structured())
    for (Json& child : json) numbersIn(child, numbers);
}

bool mutateExtreme(Json& path, Random& random) {
  std::vector<Json*> numbers;
  const bool ofPoints = path.contains("trajectory") && random.chance(0.3);
  numbersIn(ofPoints             ? path["trajectory"]
            : random.chance(0.3) ? path["states"]
                                 : path["model"],
            numbers);
  if (numbers.empty()) return false;
  Json& number = *numbers[random.below(numbers.size())];
  number = random.chance(0.7) ? extreme(random) : number.get<double>() * extreme(random);
  if (!std::isfinite(number.get<double>())) number = std::numeric_limits<double>::max();
  return true;
}

bool mutateLimit(Json& path, Random& random) {
  Json* variable = any(path["model"]["variables"], random);
  if (variable == nullptr) return false;
  (*variable)["lower"] = -std::abs(random.chance(0.5) ? extreme(random) : large(random));
  (*variable)["upper"] = std::abs(random.chance(0.5) ? extreme(random) : large(random));
  return true;
}

bool mutateTime(Json& path, Random& random) {
  if (!path.contains("trajectory")) return false;
  Json& points = path["trajectory"]["points"];
  const double duration = random.chance(0.5) ? std::abs(extreme(random)) : random.scale(-6.0, 4.0);
  const double begin = random.chance(0.5) ? 0.0 : large(random);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i]["time"] = begin + static_cast<double>(i) * duration;
  return true;
}

/// Of one variable. On a curve its value comes back from far away, or is there for a short time.
bool mutateRate(Json& path, Random& random) {
  if (!path.contains("trajectory")) return false;
  Json& points = path["trajectory"]["points"];
  const char* key = random.chance(0.5) ? "velocities" : "accelerations";
  Json* point = any(points, random);
  if (!point->contains(key) || (*point)[key].empty()) return false;
  Json& number = (*point)[key][random.below((*point)[key].size())];
  if (number == 0.0) return false;  // of an orientation
  number = random.chance(0.5) ? large(random) : number.get<double>() * large(random);
  return true;
}

bool mutateTube(Json& path, Random& random) {
  Json& model = path["model"];
  Json* joint = any(model["joints"], random);
  if (joint == nullptr || !model.contains("tracking")) return false;
  const std::string name = (*joint)["name"];
  if (!model["tracking"].contains(name)) return false;
  for (Json& number : model["tracking"][name])
    number = random.chance(0.2) ? std::abs(extreme(random))
                                : number.get<double>() * random.scale(-9.0, 3.0);
  if (!isSingle(*joint) || random.chance(0.5)) return true;
  // A limit that it may not reach.
  const std::size_t v = (*joint)["variable"];
  const double value = path["states"][0][v];
  model["variables"][v]["lower"] = value - random.pick({0.0, 1e-6, 1e-4, 2.0});
  model["variables"][v]["upper"] = value + random.pick({0.0, 1e-6, 1e-4, 2.0});
  return true;
}

/// In the order of Field.
constexpr std::array<bool (*)(Json&, Random&), kFields> kChanges = {
    cancelOffset,  cancelValue,    cancelOrigin, cancelShape,      cancelWall, cancelBody,
    mutateAxis,    mutateRotation, mutateTurn,   mutateQuaternion, mutateSize, mutateRule,
    mutateExtreme, mutateLimit,    mutateTime,   mutateRate,       mutateTube};

}  // namespace

bool mutate(Json& path, Field field, Random& random) {
  return kChanges[static_cast<std::size_t>(field)](path, random);
}

}  // namespace forgeries
