// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/yaml.hpp"
#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/collision_rules.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept::detail {

/// A moveit_msgs/AllowedCollisionMatrix: which pairs of names may collide.
class SceneMatrix {
 public:
  /// Throws InputError for one that is not square or not symmetric, a name that is given twice, and
  /// a value that is neither true nor false.
  explicit SceneMatrix(const YamlPlace& matrix);

  /// The matrix is empty: the robot's own matrix counts.
  bool isEmpty() const { return places_.empty() && defaults_.empty(); }
  bool hasEntries() const { return !places_.empty(); }
  /// Looks a pair up as MoveIt does (AllowedCollisionMatrix::getAllowedCollision). If both names
  /// have an entry, the entry counts. Otherwise the defaults count, and one that checks is enough
  /// to check. Without either the pair is checked.
  bool allows(const std::string& a, const std::string& b) const;

 private:
  std::optional<bool> defaultOf(const std::string& name) const;
  void readEntries(const YamlPlace& names, const YamlPlace& rows);
  void readDefaults(const YamlPlace& names, const YamlPlace& values);

  std::map<std::string, std::size_t> places_;
  std::vector<std::vector<bool>> allowed_;
  std::map<std::string, bool> defaults_;
};

/// Pairs of bodies, by their names.
using NamePairs = std::vector<std::pair<std::string, std::string>>;

/// The rules by which the matrix, in place of the SRDF's, differs from the SRDF and the robot's
/// joints. Links that a joint connects are checked where the matrix does not allow them. Touch
/// links may touch, and so may the attached bodies of `touching`, whatever the matrix says
/// (MoveIt's collisionCallback). Names of nothing here have no effect. Throws std::invalid_argument
/// for a body with a `*` in its name that a rule would have to name.
CollisionRules rulesOf(const SceneMatrix& matrix, const Robot& robot,
                       const std::vector<AttachedBody>& attached, const World& world,
                       const NamePairs& touching);

}  // namespace swept::detail
