// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "motion.hpp"
#include "proof.hpp"

namespace swept::verify {

/// How far a joint may be off; without a value where joints of its type cannot be.
struct JointTube {
  std::optional<double> rotation;     ///< rad
  std::optional<double> translation;  ///< m
};

/// The content of a proof, or of a part of one.
struct Summary {
  std::size_t segments = 0;   ///< between states, or between points of a trajectory
  std::size_t pairs = 0;      ///< of bodies, each over the whole path
  std::size_t intervals = 0;  ///< of a pair or a constraint
  std::size_t planes = 0;     ///< between two sets of elements during an interval
  /// m. Least of all proven distances; infinity: there is no pair.
  double clearance = std::numeric_limits<double>::infinity();
  ///@{
  /// m. The same for pairs with the world, and for pairs of two bodies of the robot.
  double clearanceWorld = std::numeric_limits<double>::infinity();
  double clearanceSelf = std::numeric_limits<double>::infinity();
  ///@}
  /// Pairs that may touch, `hand - shelf`, by who says so.
  std::map<std::string, std::vector<std::string>> allowed = {};
  std::optional<double> duration = {};   ///< s, of a trajectory
  std::vector<std::string> moving = {};  ///< bodies of the world that move
  ///@{
  /// s. What their clock shows at the first and the last point; meaningless if there are none.
  double clockBegin = 0.0, clockEnd = 0.0;
  ///@}
  /// Of every joint of the group, by name; empty: none has one.
  std::map<std::string, JointTube> tube = {};
  /// What holds at every instant besides, in words: `axis (0, 0, 1) of hand within 0.0873 rad of
  /// (0, 0, 1)`.
  std::vector<std::string> constraints = {};

  void add(const Summary& part);
};

/// Checks that intervals without gaps from 0 to 1 prove a pair apart, each by planes between all of
/// a and all of b. Throws Refusal, which starts with `place`.
///
/// `proof` has `intervals`, a list of [begin, end, tree], where b has elements, and `flats`, for
/// each plane or half-space a list of the same kind. A tree is a plane [x, y, z, bound], whose
/// direction from a to b shows that they keep more than `bound` (m), or {"a": [tree, tree]} for the
/// two halves of a's node, or {"b": [tree, tree]}. For a flat it is [side, bound].
Summary checkPair(const Model& model, const Motion& motion, PairToProve pair, const Json& proof,
                  const std::string& place);

}  // namespace swept::verify
