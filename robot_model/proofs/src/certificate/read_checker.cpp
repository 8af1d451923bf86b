// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/read_checker.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "certificate/model_json.hpp"
#include "io/robot_parts.hpp"
#include "output/robot_json.hpp"
#include "robot/joint_types.hpp"
#include "robot/shape_cover.hpp"
#include "swept/core/axis_frame.hpp"
#include "verify/encoding.hpp"
#include "verify/model.hpp"

namespace swept {
namespace {

using detail::RobotParts;
using Eigen::Vector3d;
using verify::at;
using verify::readList;
using verify::readNumber;
using verify::Refusal;

std::string wordOf(const Json& json, const char* key, const std::string& where) {
  const Json& value = at(json, key, where);
  if (!value.is_string()) throw Refusal(where + ": " + key + " is not a text");
  return value.get<std::string>();
}

JointType typeOf(const Json& json, const std::string& where) {
  const std::string word = wordOf(json, "type", where);
  for (const JointType type : {JointType::Fixed, JointType::Revolute, JointType::Continuous,
                               JointType::Prismatic, JointType::Planar, JointType::Floating})
    if (toString(type) == word) return type;
  throw Refusal(where + ": no type of joint '" + word + "'");
}

std::vector<std::string> variableNames(const std::string& joint, JointType type) {
  if (type == JointType::Planar) return {joint + "/x", joint + "/y", joint + "/theta"};
  if (type == JointType::Floating)
    return {joint + "/trans_x", joint + "/trans_y", joint + "/trans_z", joint + "/rot_x",
            joint + "/rot_y",   joint + "/rot_z",   joint + "/rot_w"};
  return type == JointType::Fixed ? std::vector<std::string>{} : std::vector<std::string>{joint};
}

int linkNamed(const RobotParts& parts, const Json& name, const std::string& where) {
  const int link = name.is_string() ? detail::indexOf(parts.links, name.get<std::string>()) : -1;
  if (link < 0) throw Refusal(where + ": no link " + name.dump());
  return link;
}

Joint jointOf(const Json& json, const RobotParts& parts) {
  Joint joint;
  joint.name = wordOf(json, "name", "joints");
  const std::string where = "joint " + joint.name;
  joint.type = typeOf(json, where);
  const Json& parent = at(json, "parent", where);
  joint.parentLink = parent.is_null() ? -1 : linkNamed(parts, parent, where);
  joint.childLink = linkNamed(parts, at(json, "child", where), where);
  joint.parent_from_joint = verify::readPose(at(json, "pose", where), where + ", pose");
  joint.axis = verify::readUnit(json, "axis", where);
  if (joint.type == JointType::Planar) {
    const Vector3d x = verify::readUnit(json, "planar_x", where);
    if (!((x - axisFrame(joint.axis).col(0)).norm() <= 1e-9))
      throw Refusal(where + ": x of its plane is not that of its axis here");
  }
  return joint;
}

/// The joint of each of the group's variables, as an index into `joints` of the file: the one that
/// the variable is named for. Others with the variable mimic it.
std::vector<std::size_t> mastersOf(const Json& model) {
  std::vector<std::size_t> masters;
  for (const Json& variable : readList(model, "variables", "model")) {
    const std::string name = wordOf(variable, "name", "variables");
    const Json& joints = readList(model, "joints", "model");
    std::size_t i = 0;
    const auto isIt = [&](const Json& joint) {
      const std::vector<std::string> own =
          variableNames(joint["name"].get<std::string>(), typeOf(joint, "joints"));
      return !joint["variable"].is_null() && std::ranges::find(own, name) != own.end();
    };
    while (i < joints.size() && !isIt(joints[i])) ++i;
    if (i == joints.size()) throw Refusal("variable " + name + ": it is of no joint");
    masters.push_back(i);
  }
  return masters;
}

Variable variableOf(const Json& json, int joint) {
  const std::string name = wordOf(json, "name", "variables"), where = "variable " + name;
  const auto limit = [&](const char* key, double none) {
    const Json& own = at(json, key, where);
    return own.is_null() ? none : readNumber(own, where);
  };
  constexpr double kNone = std::numeric_limits<double>::infinity();
  return {.name = name,
          .joint = joint,
          .lower = limit("lower", -kNone),
          .upper = limit("upper", kNone),
          .cyclic = at(json, "cyclic", where) == true};
}

/// Variables of a joint outside of the group, which keeps its values.
void addKeptVariables(int index, RobotParts& parts) {
  Joint& joint = parts.joints[static_cast<std::size_t>(index)];
  joint.firstVariable = static_cast<int>(parts.variables.size());
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (const std::string& name : variableNames(joint.name, joint.type))
    parts.variables.push_back(
        {.name = name,
         .joint = index,
         .lower = -kNone,
         .upper = kNone,
         .cyclic = joint.type == JointType::Continuous || name == joint.name + "/theta"});
  if (joint.type == JointType::Fixed) joint.firstVariable = -1;
}

/// Joints, their variables, and the one group.
void addJoints(const Json& model, const std::string& group, RobotParts& parts) {
  const Json& joints = readList(model, "joints", "model");
  const std::vector<std::size_t> masters = mastersOf(model);
  parts.groups = {{.name = group, .joints = {}, .variables = {}, .tipLink = -1}};
  Group& own = parts.groups.front();
  own.variables.assign(masters.size(), -1);
  for (const Json& json : joints) {
    const auto index = static_cast<int>(parts.joints.size());
    Joint& joint = parts.joints.emplace_back(jointOf(json, parts));
    parts.links[static_cast<std::size_t>(joint.childLink)].parentJoint = index;
    const std::string where = "joint " + joint.name;
    const Json& first = at(json, "variable", where);
    if (first.is_null()) {
      addKeptVariables(index, parts);
      continue;
    }
    const auto variable = first.get<std::size_t>();
    if (variable >= masters.size()) throw Refusal(where + ": no variable " + first.dump());
    if (masters[variable] != static_cast<std::size_t>(index)) {
      joint.mimic = Mimic{.master = static_cast<int>(masters[variable]),
                          .multiplier = readNumber(at(json, "multiplier", where), where),
                          .offset = readNumber(at(json, "offset", where), where)};
      continue;
    }
    own.joints.push_back(index);
    own.tipLink = joint.childLink;
    joint.firstVariable = static_cast<int>(parts.variables.size());
    for (int k = 0; k < detail::valueCount(joint.type); ++k) {
      const std::size_t at = variable + static_cast<std::size_t>(k);
      if (at >= masters.size()) throw Refusal(where + ": no variable " + std::to_string(at));
      own.variables[at] = static_cast<int>(parts.variables.size());
      parts.variables.push_back(variableOf(model["variables"][at], index));
    }
  }
}

/// `SRDF` and `SRDF: REASON` of two links: without them, the reason alone.
void addPairs(const Json& model, RobotParts& parts) {
  for (const Json& pair : readList(model, "allowed", "model")) {
    const std::string a = pair[0], b = pair[1], reason = pair[2];
    if (!reason.starts_with("SRDF")) continue;
    parts.disabledPairs.push_back({.linkA = linkNamed(parts, a, "allowed"),
                                   .linkB = linkNamed(parts, b, "allowed"),
                                   .reason = reason.size() > 6 ? reason.substr(6) : ""});
  }
  if (!model.contains("asked")) return;
  for (const Json& pair : model["asked"])
    parts.enabledPairs.push_back(
        {.linkA = linkNamed(parts, pair[0], "asked"), .linkB = linkNamed(parts, pair[1], "asked")});
}

void addRules(const Json& model, CheckerOptions& options) {
  options.margin = readNumber(at(model, "margin", "model"), "margin");
  if (model.contains("margin_self"))
    options.selfMargin = readNumber(model["margin_self"], "margin_self");
  if (model.contains("margin_world"))
    options.worldMargin = readNumber(model["margin_world"], "margin_world");
  const std::string kAllowed = "allowed";
  for (const Json& pair : model["allowed"]) {
    const std::string a = pair[0], b = pair[1], reason = pair[2];
    if (reason.starts_with(kAllowed))
      options.rules.allow(a, b, reason.size() > 9 ? reason.substr(9) : "");
    else if (reason.starts_with("touch link of "))
      for (AttachedBody& body : options.attached)
        if (body.name == b) body.touchLinks.push_back(a);
  }
  if (!model.contains("tracking")) return;
  for (const auto& [joint, tolerance] : model["tracking"].items())
    options.tracking.joints[joint] = {.rotation = tolerance.value("rotation", 0.0),
                                      .translation = tolerance.value("translation", 0.0)};
}

/// Of joints outside of the group.
Eigen::VectorXd referenceOf(const Json& model, const Robot& robot) {
  Eigen::VectorXd reference = robot.defaultState();
  for (std::size_t i = 0; i < robot.joints().size(); ++i) {
    const Joint& joint = robot.joints()[i];
    const Json& json = model["joints"][i];
    if (!json["variable"].is_null() || joint.type == JointType::Fixed) continue;
    const std::string where = "joint " + joint.name;
    const Json& values = readList(json, "values", where);
    if (values.size() != static_cast<std::size_t>(detail::valueCount(joint.type)))
      throw Refusal(where + ": values has another number of values than the joint");
    for (std::size_t k = 0; k < values.size(); ++k)
      reference[joint.firstVariable + static_cast<Eigen::Index>(k)] = readNumber(values[k], where);
  }
  return reference;
}

std::set<std::pair<std::string, std::string>> pairsOf(const Json& model, const char* key) {
  std::set<std::pair<std::string, std::string>> pairs;
  if (!model.contains(key)) return pairs;
  for (const Json& pair : model[key])
    pairs.insert(std::minmax({pair[0].get<std::string>(), pair[1].get<std::string>()}));
  return pairs;
}

/// Names with a `*` would mean others, too.
void requireSamePairs(const Json& model, const Checker& checker) {
  const Json made = modelJson(checker);
  for (const char* key : {"allowed", "asked"})
    if (pairsOf(made, key) != pairsOf(model, key))
      throw Refusal(std::string(key) + ": the names of pairs cannot be rules");
}

bool isOfWorld(const Json& body) {
  return body.contains("waypoints") || at(body, "link", "bodies").is_null();
}

}  // namespace

MovingObstacle CheckerReader::obstacleOf(const Json& body) {
  MovingObstacle obstacle{.name = body["name"].get<std::string>(), .parts = {}, .waypoints = {}};
  for (const Json& json : body["shapes"])
    obstacle.parts.push_back({shapeOf(json).shape, verify::readPose(json["pose"], "bodies")});
  for (const Json& json : body["waypoints"]) {
    const Json& q = json["orientation"];
    MovingObstacle::Waypoint waypoint{readNumber(json["time"], "waypoints"),
                                      Eigen::Isometry3d::Identity()};
    waypoint.world_from_body.translation() = verify::readVector(json["position"], "waypoints");
    waypoint.world_from_body.linear() = Eigen::Quaterniond(q[3].get<double>(), q[0].get<double>(),
                                                           q[1].get<double>(), q[2].get<double>())
                                            .normalized()
                                            .toRotationMatrix();
    obstacle.waypoints.push_back(waypoint);
  }
  return obstacle;
}

std::shared_ptr<const Robot> CheckerReader::robotOf(const Json& path) {
  const Json& model = at(path, "model", "the path");
  RobotParts parts;
  parts.name = wordOf(path, "robot", "the path");
  for (const Json& name : readList(model, "links", "model"))
    parts.links.push_back({.name = name.get<std::string>(), .collision = {}});
  parts.modelFrame = parts.links.empty() ? "" : parts.links.front().name;
  addJoints(model, wordOf(path, "group", "the path"), parts);
  for (const Json& body : readList(model, "bodies", "model")) {
    const int link = detail::indexOf(parts.links, wordOf(body, "name", "bodies"));
    if (link < 0 || isOfWorld(body)) continue;
    for (const Json& json : readList(body, "shapes", "bodies")) {
      ReadShape& own = shapeOf(json);
      if (own.cover == nullptr) own.cover = detail::coverOf(own.shape);
      parts.links[static_cast<std::size_t>(link)].collision.push_back(
          {.shape = own.shape,
           .link_from_shape = verify::readPose(at(json, "pose", "bodies"), "bodies"),
           .source = "",
           .cover = own.cover});
    }
  }
  addPairs(model, parts);
  return RobotBuilder::build(std::move(parts));
}

void CheckerReader::addAttached(const Json& model, CheckerOptions& options) {
  std::set<std::string> links;
  for (const Json& name : model["links"]) links.insert(name.get<std::string>());
  for (const Json& body : model["bodies"]) {
    const std::string name = body["name"];
    if (isOfWorld(body) || links.contains(name)) continue;
    AttachedBody own{.name = name, .link = body["link"].get<std::string>()};
    for (const Json& json : body["shapes"])
      own.parts.push_back({shapeOf(json).shape, verify::readPose(json["pose"], "bodies")});
    options.attached.push_back(std::move(own));
  }
}

void CheckerReader::addWorld(const Json& model, World& world) {
  for (const Json& body : model["bodies"]) {
    if (!isOfWorld(body)) continue;
    if (body.contains("waypoints")) {
      world.add(obstacleOf(body));
      continue;
    }
    WorldBody own{.name = body["name"].get<std::string>(), .parts = {}};
    for (const Json& json : body["shapes"])
      own.parts.push_back({shapeOf(json).shape, verify::readPose(json["pose"], "bodies")});
    world.add(std::move(own));
  }
}

std::shared_ptr<const Checker> CheckerReader::read(const Json& path) {
  const auto robot = robotOf(path);
  const Json& model = path["model"];
  const auto world = std::make_shared<World>();
  addWorld(model, *world);
  CheckerOptions options;
  addAttached(model, options);
  addRules(model, options);
  options.tolerance = readNumber(at(path, "tolerance", "the path"), "tolerance");
  for (const Json& body : model["bodies"]) {
    const std::string name = body["name"];
    double padding = model["paddings"].value(name, 0.0);
    double error = 0.0;
    for (const Json& json : body["shapes"]) error = std::max(error, shapeOf(json).error);
    padding += error;
    if (padding > 0.0) options.rules.pad(name, padding);
  }
  options.reference = referenceOf(model, *robot);
  if (path.contains("constraints"))
    options.constraints = constraintsOf(path["constraints"], *robot);
  auto checker =
      std::make_shared<const Checker>(robot, robot->groups().front().name, world, options);
  requireSamePairs(model, *checker);
  return checker;
}

}  // namespace swept
