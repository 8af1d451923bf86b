// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "model.hpp"
#include "rounding.hpp"

namespace swept::verify {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// More would take hours: links and pairs are gone through again and again.
constexpr std::size_t kMaxLinks = 10'000;
constexpr std::size_t kMaxPairs = 10'000'000;

/// Of things of one kind. Each name may occur once.
class Names {
 public:
  explicit Names(std::string kind) : kind_(std::move(kind)) {}
  /// The name itself. Throws Refusal when it is not the first of its kind.
  const std::string& add(const std::string& name) {
    const auto [entry, isNew] = seen_.insert(name);
    if (!isNew) throw Refusal(kind_ + " " + name + ": there are two of this name");
    return *entry;
  }

 private:
  std::string kind_;
  std::set<std::string> seen_;
};

std::string readText(const Json& json, const char* key, const std::string& where) {
  const Json& value = at(json, key, where);
  if (!value.is_string()) throw Refusal(where + ": " + key + " is not a text");
  return value.get<std::string>();
}

/// Index of a name; -1 for null.
int indexOf(const std::vector<std::string>& names, const Json& name, const std::string& where) {
  if (name.is_null()) return -1;
  const auto found =
      name.is_string() ? std::ranges::find(names, name.get<std::string>()) : names.end();
  if (found == names.end()) throw Refusal(where + ": no link " + name.dump());
  return static_cast<int>(found - names.begin());
}

JointKind kindOf(const std::string& type, const std::string& where) {
  if (type == "fixed") return JointKind::Fixed;
  if (type == "revolute" || type == "continuous") return JointKind::Revolute;
  if (type == "prismatic") return JointKind::Prismatic;
  if (type == "planar") return JointKind::Planar;
  if (type == "floating") return JointKind::Floating;
  throw Refusal(where + ": no type of joint '" + type + "'");
}

bool isWhole(double number) {
  return number == std::round(number);
}

void readValues(const Json& json, const Model& model, const std::string& where, Joint& joint) {
  const Json& variable = at(json, "variable", where);
  if (variable.is_null()) {
    for (const Json& value : readList(json, "values", where))
      joint.values.push_back(readNumber(value, where + ", values"));
    if (joint.values.size() != valuesOf(joint.kind))
      throw Refusal(where + ": values has another number of values than the joint");
    return;
  }
  const std::size_t values = valuesOf(joint.kind), count = model.variables.size();
  if (!variable.is_number_unsigned() || values > count ||
      variable.get<std::size_t>() > count - values)
    throw Refusal(where + ": no variable " + variable.dump());
  joint.variable = variable.get<int>();
  joint.multiplier = readNumber(at(json, "multiplier", where), where + ", multiplier");
  joint.offset = readNumber(at(json, "offset", where), where + ", offset");
  const bool several = values > 1;
  if (several && (joint.multiplier != 1.0 || joint.offset != 0.0))
    throw Refusal(where + ": a joint of this type cannot mimic another");
  // One motion would end where the next one does not begin.
  const bool cyclic = !several && values > 0 && model.variables[variable.get<std::size_t>()].cyclic;
  const bool comesBack = joint.kind == JointKind::Revolute && isWhole(joint.multiplier);
  if (cyclic && !comesBack)
    throw Refusal(where + ": a turn of its variable takes it somewhere else");
}

Joint readJoint(const Json& json, const Model& model) {
  const std::string where = "joint " + readText(json, "name", "joints");
  Joint joint;
  joint.name = json["name"];
  joint.kind = kindOf(readText(json, "type", where), where);
  joint.parent = indexOf(model.links, at(json, "parent", where), where);
  joint.child = indexOf(model.links, at(json, "child", where), where);
  if (joint.child < 0 || joint.child <= joint.parent)
    throw Refusal(where + ": links are not in the order of the tree");
  joint.parent_from_joint = readPose(at(json, "pose", where), where + ", pose");
  joint.axis = readUnit(json, "axis", where);
  if (joint.kind == JointKind::Planar) {
    joint.planarX = readUnit(json, "planar_x", where);
    if (!(std::abs(joint.planarX.dot(joint.axis)) <= kUnit))
      throw Refusal(where + ": planar_x is not across the axis");
  }
  readValues(json, model, where, joint);
  return joint;
}

Variable readVariable(const Json& json) {
  const std::string where = "variable " + readText(json, "name", "variables");
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto limit = [&](const char* key, double none) {
    const Json& value = at(json, key, where);
    return value.is_null() ? none : readNumber(value, where + ", " + key);
  };
  const Json& cyclic = at(json, "cyclic", where);
  if (!cyclic.is_boolean()) throw Refusal(where + ": cyclic is neither true nor false");
  return {.name = json["name"],
          .lower = limit("lower", -kNone),
          .upper = limit("upper", kNone),
          .cyclic = cyclic.get<bool>()};
}

void readBody(const Json& json, Model& model) {
  const std::string where = "body " + readText(json, "name", "bodies");
  // A body that moves has no `link`: what knows no waypoints would take null for one that stands.
  const bool moves = json.contains("waypoints");
  if (moves && json.contains("link")) throw Refusal(where + ": it has a link, and waypoints");
  const int link = moves ? -1 : indexOf(model.links, at(json, "link", where), where);
  if (link >= 0 && !model.linkOf.empty() && model.linkOf.back() < 0)
    throw Refusal(where + ": bodies of the robot come before those of the world");
  ShapeParts parts;
  for (const Json& shape : readList(json, "shapes", where))
    readShape(shape, readPose(at(shape, "pose", where), where + ", pose"), where, parts);
  if (link >= 0 && !parts.flats.empty())
    throw Refusal(where + ": a robot has no plane and no half-space");
  if (moves && !parts.flats.empty())
    throw Refusal(where + ": what moves has no plane and no half-space");
  if (moves)
    model.obstacles.emplace(static_cast<int>(model.bodies.size()), readObstacle(json, where));
  model.bodies.emplace_back(json["name"], std::move(parts.elements), std::move(parts.flats),
                            std::move(parts.solids));
  model.linkOf.push_back(link);
}

int bodyNamed(const Model& model, const Json& name, const std::string& where) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (name == model.bodies[i].name()) return static_cast<int>(i);
  throw Refusal(where + ": no body " + name.dump());
}

/// Two bodies, by index, the smaller first.
std::pair<int, int> readPair(const Model& model, const Json& entry, const std::string& where) {
  return std::minmax({bodyNamed(model, entry[0], where), bodyNamed(model, entry[1], where)});
}

void readRules(const Json& json, Model& model) {
  model.margin = readNumber(at(json, "margin", "model"), "model, margin");
  const auto marginOf = [&](const char* key) {
    return json.contains(key) ? readNumber(json[key], std::string("model, ") + key) : model.margin;
  };
  model.selfMargin = marginOf("margin_self");
  model.worldMargin = marginOf("margin_world");
  model.paddings.assign(model.bodies.size(), 0.0);
  for (const auto& [name, metres] : at(json, "paddings", "model").items())
    model.paddings[static_cast<std::size_t>(bodyNamed(model, name, "paddings"))] =
        readNumber(metres, "padding of " + name);
  for (const Json& entry : readList(json, "allowed", "model")) {
    if (!entry.is_array() || entry.size() != 3 || !entry[2].is_string())
      throw Refusal("allowed: not two names and a reason: " + entry.dump());
    model.allowed.emplace(readPair(model, entry, "allowed"), entry[2].get<std::string>());
  }
  if (json.contains("asked"))
    for (const Json& entry : readList(json, "asked", "model")) {
      if (!entry.is_array() || entry.size() != 2)
        throw Refusal("asked: not two names: " + entry.dump());
      model.asked.insert(readPair(model, entry, "asked"));
    }
  const bool negative = std::ranges::any_of(model.paddings, [](double p) { return !(p >= 0.0); });
  const double least = std::min({model.margin, model.selfMargin, model.worldMargin});
  if (negative || !(least >= 0.0)) throw Refusal("model: a margin or padding is negative");
}

}  // namespace

std::size_t valuesOf(JointKind kind) {
  switch (kind) {
    case JointKind::Fixed:
      return 0;
    case JointKind::Revolute:
    case JointKind::Prismatic:
      return 1;
    case JointKind::Planar:
      return 3;
    case JointKind::Floating:
      return 7;
  }
  return 0;
}

const Json& at(const Json& json, const char* key, std::string_view where) {
  if (!json.is_object() || !json.contains(key))
    throw Refusal(std::string(where) + ": there is no " + key);
  return json[key];
}

const Json& readList(const Json& json, const char* key, std::string_view where) {
  const Json& value = at(json, key, where);
  if (!value.is_array()) throw Refusal(std::string(where) + ": " + key + " is not a list");
  return value;
}

double readNumber(const Json& json, const std::string& where) {
  if (!json.is_number()) throw Refusal(where + ": not a number: " + json.dump());
  const double number = json.get<double>();
  if (!std::isfinite(number)) throw Refusal(where + ": not a finite number");
  return number;
}

Vector3d readUnit(const Json& json, const char* key, const std::string& where) {
  Vector3d axis = readVector(at(json, key, where), where + ", " + key);
  if (!(std::abs(axis.norm() - 1.0) <= kUnit))
    throw Refusal(where + ": " + key + " has not length 1");
  // Turned about an axis that is too long by 1e-12, points would move apart by four times that.
  return axis.normalized();
}

Vector3d readVector(const Json& json, const std::string& where) {
  if (!json.is_array() || json.size() != 3) throw Refusal(where + ": not three numbers");
  return {readNumber(json[0], where), readNumber(json[1], where), readNumber(json[2], where)};
}

Isometry3d readPose(const Json& json, const std::string& where) {
  if (!json.is_array() || json.size() != 12) throw Refusal(where + ": not 12 numbers");
  Isometry3d pose = Isometry3d::Identity();
  for (Eigen::Index i = 0; i < 9; ++i)
    pose.linear()(i / 3, i % 3) = readNumber(json[static_cast<std::size_t>(i)], where);
  for (Eigen::Index i = 0; i < 3; ++i)
    pose.translation()[i] = readNumber(json[static_cast<std::size_t>(9 + i)], where);
  const Eigen::Matrix3d error =
      pose.linear().transpose() * pose.linear() - Eigen::Matrix3d::Identity();
  if (!(error.cwiseAbs().maxCoeff() <= kUnit) || !(pose.linear().determinant() > 0.0))
    throw Refusal(where + ": not a rotation");
  return pose;
}

Model readModel(const Json& json) {
  Model model;
  Names links("link"), variables("variable"), joints("joint"), bodies("body");
  for (const Json& name : readList(json, "links", "model")) {
    if (!name.is_string()) throw Refusal("links: not a text: " + name.dump());
    model.links.push_back(links.add(name.get<std::string>()));
    if (model.links.size() > kMaxLinks)
      throw Refusal("model: more than " + std::to_string(kMaxLinks) + " links");
  }
  for (const Json& variable : readList(json, "variables", "model")) {
    model.variables.push_back(readVariable(variable));
    variables.add(model.variables.back().name);
  }
  model.jointOf.assign(model.links.size(), -1);
  for (const Json& joint : readList(json, "joints", "model")) {
    model.joints.push_back(readJoint(joint, model));
    joints.add(model.joints.back().name);
    int& above = model.jointOf[static_cast<std::size_t>(model.joints.back().child)];
    if (above >= 0)
      throw Refusal("joint " + model.joints.back().name + ": a second one above its link");
    above = static_cast<int>(model.joints.size()) - 1;
  }
  for (const Json& body : readList(json, "bodies", "model")) {
    readBody(body, model);
    bodies.add(model.bodies.back().name());
  }
  const auto ofRobot =
      static_cast<std::size_t>(std::ranges::count_if(model.linkOf, [](int l) { return l >= 0; }));
  if (ofRobot > 0 && model.bodies.size() > kMaxPairs / ofRobot)
    throw Refusal("model: more than " + std::to_string(kMaxPairs) + " pairs of bodies");
  readRules(json, model);
  if (json.contains("tracking")) readTracking(json["tracking"], model);
  return model;
}

}  // namespace swept::verify
