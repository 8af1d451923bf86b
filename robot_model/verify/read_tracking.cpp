// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <string>

#include "model.hpp"

namespace swept::verify {
namespace {

bool isSingle(const Joint& joint) {
  return valuesOf(joint.kind) == 1;
}

/// Whether two joints have a value in common.
bool shareValues(const Joint& a, const Joint& b) {
  if (a.variable < 0 || b.variable < 0 || valuesOf(b.kind) == 0) return false;
  const auto endOf = [](const Joint& joint) {
    return joint.variable + static_cast<int>(valuesOf(joint.kind));
  };
  return a.variable < endOf(b) && b.variable < endOf(a);
}

double readTolerance(const Json& json, const char* key, bool has, const std::string& where) {
  if (!json.contains(key)) return 0.0;
  if (!has) throw Refusal(where + ": a joint of this type has no " + key);
  const double tolerance = readNumber(json[key], where + ", " + key);
  if (!(tolerance >= 0.0)) throw Refusal(where + ": " + key + " is negative");
  return tolerance;
}

/// What a joint that follows a variable is off where the variable is off by `value`.
void widen(Joint& joint, const Variable& variable, double value) {
  const double own = std::abs(joint.multiplier) * value;
  if (joint.kind == JointKind::Revolute) {
    joint.tolerance.rotation = std::max(joint.tolerance.rotation, own);
    return;
  }
  joint.tolerance.translation = std::max(joint.tolerance.translation, own);
  const double first = joint.multiplier * variable.lower + joint.offset;
  const double last = joint.multiplier * variable.upper + joint.offset;
  joint.lower = std::min(first, last);
  joint.upper = std::max(first, last);
}

/// Of one joint, and of all that follow its variable.
void addTolerance(const Joint& joint, const Tolerance& tolerance, const std::string& where,
                  Model& model) {
  for (Joint& other : model.joints) {
    if (!shareValues(joint, other)) continue;
    if (isSingle(joint) && isSingle(other))
      widen(other, model.variables[static_cast<std::size_t>(other.variable)],
            std::max(tolerance.rotation, tolerance.translation));
    else if (other.name == joint.name)
      other.tolerance = tolerance;
    else
      throw Refusal(where + ": joint " + other.name + " has some of its values");
  }
}

}  // namespace

void readTracking(const Json& tracking, Model& model) {
  if (!tracking.is_object()) throw Refusal("tracking: not tolerances by joint");
  for (const auto& [name, json] : tracking.items()) {
    const std::string where = "tracking of joint " + name;
    const auto joint = std::ranges::find(model.joints, name, &Joint::name);
    if (joint == model.joints.end()) throw Refusal(where + ": there is no such joint");
    if (joint->variable < 0 || valuesOf(joint->kind) == 0)
      throw Refusal(where + ": the group does not move it");
    if (joint->multiplier != 1.0)
      throw Refusal(where + ": it follows another joint, and so does its tolerance");
    if (!json.is_object()) throw Refusal(where + ": not a rotation and a translation");
    for (const auto& [key, value] : json.items())
      if (key != "rotation" && key != "translation")
        throw Refusal(where + ": neither rotation nor translation: " + key);
    const Tolerance tolerance{
        .rotation = readTolerance(json, "rotation", joint->kind != JointKind::Prismatic, where),
        .translation =
            readTolerance(json, "translation", joint->kind != JointKind::Revolute, where)};
    addTolerance(*joint, tolerance, where, model);
  }
}

}  // namespace swept::verify
