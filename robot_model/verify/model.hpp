// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "body.hpp"
#include "obstacle.hpp"

/// Checks the proof in a path file. Nothing here searches, and nothing is shared with the library
/// that found the proof; README.md says what is trusted.
namespace swept::verify {

using Json = nlohmann::ordered_json;

/// The error in a path file, and its place: `segment 2, hand - shelf, 0.25 to 0.5: ...`.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class JointKind : std::uint8_t { Fixed, Revolute, Prismatic, Planar, Floating };
/// How many values a joint has.
std::size_t valuesOf(JointKind kind);

/// How far a joint may be from where its values put it, at every instant anew: a revolute joint by
/// a rotation, a prismatic one by a translation, a planar or floating one by both in any direction.
struct Tolerance {
  double rotation = 0.0;     ///< rad
  double translation = 0.0;  ///< m
};

/// The child's frame in the parent's: parent_from_joint, then the motion by the values. A revolute
/// joint turns about `axis`, a prismatic one slides along it, a planar one slides orthogonally to
/// it and turns about it.
struct Joint {
  std::string name;
  JointKind kind = JointKind::Fixed;
  int parent = -1;  ///< link; -1: the model frame
  int child = 0;    ///< link
  Eigen::Isometry3d parent_from_joint = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();    ///< unit, joint frame
  Eigen::Vector3d planarX = Eigen::Vector3d::Zero();  ///< unit, joint frame; planar only
  int variable = -1;        ///< into the configuration: the first of the joint's values; -1: none
  double multiplier = 1.0;  ///< value = multiplier * configuration + offset
  double offset = 0.0;      ///< rad or m
  std::vector<double> values = {};  ///< of a joint that the group does not move
  Tolerance tolerance = {};
  /// m. Where a prismatic joint with a tolerance ends: none of what it allows is beyond.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

/// rad or m. How far beyond a limit a value may be: 1e-5, and the rounding of such a decimal. The
/// proof is about the value as it is.
constexpr double kLimit = 1.000001e-5;
/// Where something was changed.
inline const std::string kChanged = ": is not as it was when the path was certified";

/// One number of a configuration.
struct Variable {
  std::string name;
  double lower, upper;  ///< rad or m
  bool cyclic;          ///< takes the shorter way round
};

/// The data of a robot, its attached bodies and its world that motions of one group need. Links,
/// attached bodies and bodies of the world are all `bodies`; the robot's come first.
struct Model {
  std::vector<std::string> links;  ///< parents first
  std::vector<Joint> joints;       ///< parents first
  std::vector<int> jointOf;        ///< per link: the joint above it; -1: none
  std::vector<Variable> variables;
  std::vector<Body> bodies;
  std::vector<int> linkOf;  ///< per body: the link that it moves with; -1: the world
  /// How bodies of the world move, by index; the others stand.
  std::map<int, Obstacle> obstacles;
  double clock = 0.0;  ///< s, what the clock of `obstacles` shows at a trajectory's time 0
  /// Pairs of bodies, by index, smaller first, that may touch, and who says so.
  std::map<std::pair<int, int>, std::string> allowed;
  /// Likewise, links that a joint connects and that must stay apart all the same.
  std::set<std::pair<int, int>> asked;
  double margin = 0.0;  ///< m
  /// m, of pairs of two bodies of the robot, and of pairs with the world; `margin` if the file has
  /// no other.
  double selfMargin = 0.0, worldMargin = 0.0;
  std::vector<double> paddings;  ///< m, per body
  bool withWorld(int a, int b) const { return linkOf[a] < 0 || linkOf[b] < 0; }
  /// m: the distance that a pair must keep.
  double marginOf(int a, int b) const {
    return (withWorld(a, b) ? worldMargin : selfMargin) + paddings[a] + paddings[b];
  }
};

/// Reads the `model` of a path file. Throws Refusal.
Model readModel(const Json& json);

/// Reads `tracking` of a model, the tolerances of its joints, into the joints. Throws Refusal.
void readTracking(const Json& tracking, Model& model);

/// The parts of a link's shape. Throws Refusal. `frame` is body_from_shape.
struct ShapeParts {
  std::vector<Element> elements;
  std::vector<Flat> flats;
  std::vector<Surface> solids;
};
void readShape(const Json& json, const Eigen::Isometry3d& frame, const std::string& where,
               ShapeParts& parts);

/// A pose is 12 numbers: the rotation by rows, then the translation (m).
Eigen::Isometry3d readPose(const Json& json, const std::string& where);
Eigen::Vector3d readVector(const Json& json, const std::string& where);
/// `json[key]`, a vector of length 1.
Eigen::Vector3d readUnit(const Json& json, const char* key, const std::string& where);
double readNumber(const Json& json, const std::string& where);
/// `json[key]`. Throws Refusal if it is missing.
const Json& at(const Json& json, const char* key, std::string_view where);
/// The same, of a list.
const Json& readList(const Json& json, const char* key, std::string_view where);

}  // namespace swept::verify
