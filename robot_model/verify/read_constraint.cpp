// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "constraint.hpp"
#include "encoding.hpp"
#include "rounding.hpp"

namespace swept::verify {
using Eigen::Vector3d;

std::string briefText(double number) {
  return numberText(number == 0.0 ? 0.0 : number, 3);
}

std::string listText(const Vector3d& numbers) {
  return "(" + briefText(numbers.x()) + ", " + briefText(numbers.y()) + ", " +
         briefText(numbers.z()) + ")";
}

double readMost(const Json& json, const std::string& where) {
  if (json.is_null()) return std::numeric_limits<double>::infinity();
  const double most = readNumber(json, where);
  if (!(most >= 0.0)) throw Refusal(where + ": negative");
  return most;
}

void requireKeys(const Json& json, const std::vector<std::string>& keys, const std::string& where) {
  if (!json.is_object()) throw Refusal(where + ": not an object");
  for (const auto& [key, value] : json.items())
    if (std::ranges::find(keys, key) == keys.end()) throw Refusal(where + ": it has no " + key);
}

Frame readFrame(const Json& json, const char* key, const Model& model, const std::string& where) {
  const Json& own = at(json, key, where);
  const std::string place = where + ", " + key;
  requireKeys(own, {"link", "pose"}, place);
  Frame frame;
  const Json& link = at(own, "link", place);
  if (!link.is_null()) {
    const auto found = link.is_string() ? std::ranges::find(model.links, link.get<std::string>())
                                        : model.links.end();
    if (found == model.links.end()) throw Refusal(place + ": no link " + link.dump());
    frame.link = static_cast<int>(found - model.links.begin());
  }
  frame.link_from_frame = readPose(at(own, "pose", place), place + ", pose");
  if (!(frame.link_from_frame.translation().norm() <= kFarthest))
    throw Refusal(place + ": it is farther than 1e150 m");
  return frame;
}

std::string nameOf(const Frame& frame, const Model& model) {
  return frame.link < 0 ? "the model frame" : model.links[static_cast<std::size_t>(frame.link)];
}

namespace {

std::string readWord(const Json& json, const char* key, const std::string& where) {
  const Json& value = at(json, key, where);
  if (!value.is_string()) throw Refusal(where + ": " + key + " is not a text");
  return value.get<std::string>();
}

/// ` of LINK`, where the place or direction before it is not one of the model frame.
std::string seenFrom(const Frame& reference, const Model& model) {
  return reference.link < 0 ? "" : " of " + nameOf(reference, model);
}

JointRange readJointRange(const Json& json, const Model& model, const std::string& where) {
  requireKeys(json, {"kind", "joint", "value", "cyclic", "position", "above", "below"}, where);
  const std::string name = readWord(json, "joint", where);
  const auto found = std::ranges::find(model.joints, name, &Joint::name);
  if (found == model.joints.end()) throw Refusal(where + ": no joint " + name);
  JointRange range;
  range.joint = static_cast<std::size_t>(found - model.joints.begin());
  // An orientation's numbers are no angles.
  const std::size_t values = std::min<std::size_t>(3, valuesOf(found->kind));
  const Json& value = at(json, "value", where);
  if (!value.is_number_unsigned() || value.get<std::size_t>() >= values)
    throw Refusal(where + ": joint " + name + " has no value " + value.dump());
  range.value = value.get<std::size_t>();
  const Json& cyclic = at(json, "cyclic", where);
  const bool turns =
      found->kind == JointKind::Revolute || (found->kind == JointKind::Planar && range.value == 2);
  if (!cyclic.is_boolean() || (cyclic.get<bool>() && !turns))
    throw Refusal(where + ": cyclic is neither false nor, of an angle, true");
  range.cyclic = cyclic.get<bool>();
  range.position = readNumber(at(json, "position", where), where + ", position");
  range.above = readMost(at(json, "above", where), where + ", above");
  range.below = readMost(at(json, "below", where), where + ", below");
  return range;
}

Regions::Region readRegion(const Json& json, const std::string& where) {
  requireKeys(json, {"type", "size", "pose"}, where);
  const std::string type = readWord(json, "type", where);
  Regions::Region region;
  std::size_t sizes = 3;
  if (type == "sphere") {
    region.type = Regions::Type::Sphere;
    sizes = 1;
  } else if (type == "cylinder") {
    region.type = Regions::Type::Cylinder;
    sizes = 2;
  } else if (type != "box") {
    throw Refusal(where + ": no type of region '" + type + "'");
  }
  const Json& size = readList(json, "size", where);
  if (size.size() != sizes) throw Refusal(where + ": not " + std::to_string(sizes) + " sizes");
  for (const Json& own : size) region.size.push_back(readMost(own, where + ", size"));
  region.reference_from_region = readPose(at(json, "pose", where), where + ", pose");
  return region;
}

Regions readRegions(const Json& json, const Model& model, const std::string& where) {
  requireKeys(json, {"kind", "frame", "reference", "regions"}, where);
  Regions regions{.frame = readFrame(json, "frame", model, where),
                  .reference = readFrame(json, "reference", model, where),
                  .regions = {}};
  for (const Json& region : readList(json, "regions", where))
    regions.regions.push_back(readRegion(region, where + ", regions"));
  if (regions.regions.empty()) throw Refusal(where + ": there is no region");
  return regions;
}

Turned readTurned(const Json& json, const Model& model, const std::string& where) {
  requireKeys(json, {"kind", "frame", "reference", "orientation", "tolerance", "parameterization"},
              where);
  Turned turned{.frame = readFrame(json, "frame", model, where),
                .reference = readFrame(json, "reference", model, where)};
  const Json& xyzw = readList(json, "orientation", where);
  if (xyzw.size() != 4) throw Refusal(where + ": orientation is not four numbers");
  for (Eigen::Index i = 0; i < 4; ++i)
    turned.desired.coeffs()[i] =
        readNumber(xyzw[static_cast<std::size_t>(i)], where + ", orientation");
  if (!(std::abs(turned.desired.norm() - 1.0) <= kUnit))
    throw Refusal(where + ": orientation has not length 1");
  turned.desired.normalize();
  const Json& most = readList(json, "tolerance", where);
  if (most.size() != 3) throw Refusal(where + ": tolerance is not three numbers");
  for (Eigen::Index i = 0; i < 3; ++i)
    turned.most[i] = readMost(most[static_cast<std::size_t>(i)], where + ", tolerance");
  const std::string as = readWord(json, "parameterization", where);
  if (as != "euler_angles" && as != "rotation_vector")
    throw Refusal(where + ": no parameterization '" + as + "'");
  turned.asVector = as == "rotation_vector";
  return turned;
}

Tilted readTilted(const Json& json, const Model& model, const std::string& where) {
  requireKeys(json, {"kind", "frame", "reference", "axis", "direction", "angle"}, where);
  return {.frame = readFrame(json, "frame", model, where),
          .reference = readFrame(json, "reference", model, where),
          .axis = readUnit(json, "axis", where),
          .direction = readUnit(json, "direction", where),
          .most = readMost(at(json, "angle", where), where + ", angle")};
}

Constraint named(const JointRange& own, const Model& model) {
  const Joint& joint = model.joints[own.joint];
  std::string name = "joint " + joint.name;
  if (valuesOf(joint.kind) > 1) {
    constexpr const char* kPlanar[] = {"x", "y", "theta"};
    constexpr const char* kFloating[] = {"x", "y", "z"};
    name +=
        std::string(" in ") + (joint.kind == JointKind::Planar ? kPlanar : kFloating)[own.value];
  }
  return {.name = name,
          .text = name + " from " + briefText(own.position - own.below) + " to " +
                  briefText(own.position + own.above),
          .what = own};
}

std::string sizeText(double size) {
  return std::isinf(size) ? "any" : briefText(size);
}

Constraint named(const Regions& own, const Model& model) {
  const std::string name = "position of " + nameOf(own.frame, model);
  std::string text = "point " + listText(own.frame.link_from_frame.translation()) + " of " +
                     nameOf(own.frame, model) + " in a ";
  for (std::size_t i = 0; i < own.regions.size(); ++i) {
    const Regions::Region& region = own.regions[i];
    if (i > 0) text += " or a ";
    text += region.type == Regions::Type::Box      ? "box of "
            : region.type == Regions::Type::Sphere ? "sphere of radius "
                                                   : "cylinder of radius and length ";
    for (std::size_t k = 0; k < region.size.size(); ++k)
      text += (k == 0 ? "" : " x ") + sizeText(region.size[k]);
    text += " m at " +
            listText((own.reference.link_from_frame * region.reference_from_region).translation());
  }
  return {.name = name, .text = text + seenFrom(own.reference, model), .what = own};
}

Constraint named(const Turned& own, const Model& model) {
  const std::string name = "orientation of " + nameOf(own.frame, model);
  const Eigen::Vector4d& q = own.desired.coeffs();
  return {.name = name,
          .text = name + (own.asVector ? " by a rotation vector" : " by angles") + " within (" +
                  sizeText(own.most.x()) + ", " + sizeText(own.most.y()) + ", " +
                  sizeText(own.most.z()) + ") rad of (" + briefText(q[0]) + ", " + briefText(q[1]) +
                  ", " + briefText(q[2]) + ", " + briefText(q[3]) + ")" +
                  seenFrom(own.reference, model),
          .what = own};
}

Constraint named(const Tilted& own, const Model& model) {
  return {.name = "axis of " + nameOf(own.frame, model),
          .text = "axis " + listText(own.frame.link_from_frame.linear() * own.axis) + " of " +
                  nameOf(own.frame, model) + " within " + sizeText(own.most) + " rad of " +
                  listText(own.reference.link_from_frame.linear() * own.direction) +
                  seenFrom(own.reference, model),
          .what = own};
}

Constraint readConstraint(const Json& json, const Model& model, const std::string& where) {
  const std::string kind = readWord(json, "kind", where);
  if (kind == "joint") return named(readJointRange(json, model, where), model);
  if (kind == "position") return named(readRegions(json, model, where), model);
  if (kind == "orientation") return named(readTurned(json, model, where), model);
  if (kind == "axis") return named(readTilted(json, model, where), model);
  throw Refusal(where + ": no kind '" + kind + "'");
}

}  // namespace

std::vector<Constraint> readConstraints(const Json& list, const Model& model) {
  if (!list.is_array()) throw Refusal("constraints: not a list");
  std::vector<Constraint> constraints;
  for (std::size_t i = 0; i < list.size(); ++i)
    constraints.push_back(readConstraint(list[i], model, "constraint " + std::to_string(i + 1)));
  return constraints;
}

}  // namespace swept::verify
