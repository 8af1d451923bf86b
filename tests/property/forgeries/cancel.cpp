// SPDX-License-Identifier: BSD-3-Clause
#include "cancel.hpp"

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "places.hpp"
#include "verify/encoding.hpp"

namespace forgeries {
namespace {

void add(Json& number, double more) {
  number = number.get<double>() + more;
}

/// linear . (share v), added to a pose's translation.
void movePose(Json& pose, const Json& v, double share) {
  for (std::size_t row = 0; row < 3; ++row) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) sum += pose[3 * row + i].get<double>() * v[i].get<double>();
    add(pose[9 + row], share * sum);
  }
}

/// Points of a base64 text moved by share v.
void movePoints(Json& text, const Json& v, double share) {
  std::vector<double> numbers = swept::verify::doublesOf(text.get<std::string>(), "points");
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] += share * v[i % 3].get<double>();
  text = swept::verify::base64Of(std::span<const double>(numbers));
}

void moveVector(Json& pose, const Json& v, double share) {
  for (std::size_t i = 0; i < 3; ++i) add(pose[9 + i], share * v[i].get<double>());
}

/// Along its axis, which its own turn leaves as it is.
bool moveOrigin(Json& path, Random& random, bool toBodies) {
  Json* joint = any(path["model"]["joints"], random);
  if (joint == nullptr || typeOf(*joint) == "floating") return false;
  const double far = large(random);
  const Json axis = (*joint)["axis"];
  bool moved = false;
  for (Json& next : path["model"]["joints"])
    if (!toBodies && next["parent"] == (*joint)["child"]) {
      moveVector(next["pose"], axis, -far);
      moved = true;
    }
  for (Json& body : path["model"]["bodies"])
    if (toBodies && body["link"] == (*joint)["child"])
      for (Json& shape : body["shapes"]) {
        moveVector(shape["pose"], axis, -far);
        moved = true;
      }
  if (!moved && typeOf(*joint) == "prismatic") {
    add((*joint)["variable"].is_null() ? (*joint)["values"][0] : (*joint)["offset"], -far);
    moved = true;
  }
  if (moved) movePose((*joint)["pose"], axis, far);
  return moved;
}

}  // namespace

bool cancelOffset(Json& path, Random& random) {
  Json* joint = any(path["model"]["joints"], random);
  if (joint == nullptr || !isSingle(*joint)) return false;
  const std::size_t v = (*joint)["variable"];
  const bool cyclic = path["model"]["variables"][v]["cyclic"];
  const double multiplier = cyclic               ? std::round(large(random))
                            : random.chance(0.5) ? large(random)
                                                 : random.uniform(-4.0, 4.0);
  const double value = path["states"][0][v];
  const double kept = (*joint)["multiplier"].get<double>() * value;
  (*joint)["multiplier"] = multiplier;
  (*joint)["offset"] = kept - multiplier * value;
  return true;
}

/// Moves one variable in all states and takes it back in every joint that follows it.
bool cancelValue(Json& path, Random& random) {
  Json& model = path["model"];
  Json* source = any(model["joints"], random);
  if (source == nullptr || (*source)["variable"].is_null() || typeOf(*source) == "fixed")
    return false;
  const bool single = isSingle(*source);
  const double far = large(random);
  const std::size_t slide = single ? 0 : random.below(typeOf(*source) == "planar" ? 2 : 3);
  const std::size_t v = (*source)["variable"].get<std::size_t>() + slide;
  for (Json& state : path["states"]) add(state[v], far);
  for (Json& joint : model["joints"])
    if (isSingle(joint) && joint["variable"] == v)
      add(joint["offset"], -joint["multiplier"].get<double>() * far);
  if (single) return true;
  Json way = {slide == 0 ? 1.0 : 0.0, slide == 1 ? 1.0 : 0.0, slide == 2 ? 1.0 : 0.0};
  if (typeOf(*source) == "planar") {
    const Json& x = (*source)["planar_x"];
    const Json& z = (*source)["axis"];
    way = x;
    for (std::size_t i = 0; slide == 1 && i < 3; ++i)
      way[i] = z[(i + 1) % 3].get<double>() * x[(i + 2) % 3].get<double>() -
               z[(i + 2) % 3].get<double>() * x[(i + 1) % 3].get<double>();
  }
  movePose((*source)["pose"], way, -far);
  return true;
}

bool cancelOrigin(Json& path, Random& random) {
  return moveOrigin(path, random, false);
}

bool cancelBody(Json& path, Random& random) {
  return moveOrigin(path, random, true);
}

bool cancelShape(Json& path, Random& random) {
  Json* shape = anyShape(path, random);
  if (shape == nullptr) return false;
  const char* key = shape->contains("vertices") ? "vertices" : "points";
  if (!shape->contains(key)) return false;
  const double far = large(random);
  const Json way = {random.normal(), random.normal(), random.normal()};
  movePose((*shape)["pose"], way, far);
  movePoints((*shape)[key], way, -far);
  return true;
}

bool cancelWall(Json& path, Random& random) {
  Json* shape = anyShape(path, random);
  if (shape == nullptr || !shape->contains("normal")) return false;
  const double far = large(random);
  movePose((*shape)["pose"], (*shape)["normal"], far);
  add((*shape)["offset"], -far);
  return true;
}

}  // namespace forgeries
