// SPDX-License-Identifier: BSD-3-Clause
#include "errors.hpp"

#include <algorithm>

#include "places.hpp"

namespace forgeries {
namespace {

Real tolerance(const Json& entry, const char* key) {
  return entry.contains(key) ? Real(entry[key].get<double>()) : Real(0);
}

Vec drawDirection(Random& random) {
  const Vec way{Real(random.normal()), Real(random.normal()), Real(random.normal())};
  return way * (1 / way.norm());
}

/// Shorter by less than doubles tell: of a length that is rounded to more, no more is left.
Real within(const Real& most, Random& random) {
  return random.sign() * most * (1 - Real("1e-40"));
}

/// Whether a joint that slides follows the variable.
bool slides(const Json& model, std::size_t variable) {
  return std::ranges::any_of(model["joints"], [&](const Json& joint) {
    return joint["variable"] == variable && typeOf(joint) == "prismatic";
  });
}

Real clipped(const Json& variable, const Real& value, const Real& error) {
  Real own = error;
  if (!variable["lower"].is_null()) {
    const Real room = Real(variable["lower"].get<double>()) - value;
    own = std::max(own, std::min(room, Real(0)));
  }
  if (!variable["upper"].is_null()) {
    const Real room = Real(variable["upper"].get<double>()) - value;
    own = std::min(own, std::max(room, Real(0)));
  }
  return own;
}

}  // namespace

Errors drawErrors(const Json& path, const ExactMotion& motion, const Real& t, Random& random) {
  Errors errors;
  const Json& model = path["model"];
  if (!model.contains("tracking")) return errors;
  for (const Json& joint : model["joints"]) {
    const std::string name = joint["name"];
    if (!model["tracking"].contains(name)) continue;
    const Json& entry = model["tracking"][name];
    const Real rotation = tolerance(entry, "rotation"), slide = tolerance(entry, "translation");
    if (isSingle(joint)) {
      const std::size_t variable = joint["variable"];
      Real& own = errors.values[variable];
      const Real drawn = within(std::max(rotation, slide), random);
      if (abs(drawn) > abs(own)) own = drawn;
      if (slides(model, variable))
        own = clipped(model["variables"][variable], motion.valueOf(variable, t), own);
      continue;
    }
    errors.rotation[name] = within(rotation, random);
    errors.axes[name] = drawDirection(random);
    Vec way = drawDirection(random);
    if (typeOf(joint) == "planar") {
      way = way.cross(vecOf(joint["axis"]));
      way = way * (1 / way.norm());
    }
    errors.slides[name] = way * within(slide, random);
  }
  return errors;
}

}  // namespace forgeries
