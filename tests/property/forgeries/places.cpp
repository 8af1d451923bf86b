// SPDX-License-Identifier: BSD-3-Clause
#include "places.hpp"

#include <cmath>

namespace forgeries {

double large(Random& random) {
  const double number = random.sign() * random.scale(0.0, 18.0);
  return random.chance(0.3) ? std::round(number) + 0.125 : number;
}

Json* any(Json& list, Random& random) {
  return list.empty() ? nullptr : &list[random.below(list.size())];
}

Json* anyShape(Json& path, Random& random) {
  Json* body = any(path["model"]["bodies"], random);
  return body == nullptr ? nullptr : any((*body)["shapes"], random);
}

std::string typeOf(const Json& joint) {
  return joint["type"];
}

bool isSingle(const Json& joint) {
  const std::string type = typeOf(joint);
  return !joint["variable"].is_null() &&
         (type == "prismatic" || type == "revolute" || type == "continuous");
}

}  // namespace forgeries
