// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "replay/robot_cases.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/shapes.hpp"

/// Cases with a known answer, read from JSON; planners_demo/README.md has the format.
namespace swept {

enum class PairQuery {
  SignedDistance,  ///< m, negative: length of the shortest separating translation
  Distance,        ///< m, 0 in overlap
  Collide,         ///< yes or no
  FirstContact,    ///< t in [0, 1]
};

/// Two shapes, and what is true about them.
struct PairQuestion {
  PairQuery query;
  Shape a, b;
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();  ///< not for FirstContact
  std::vector<UniformMotion> motions = {};                     ///< for FirstContact: of a and of b
  double scale = 0.0;      ///< m, largest of the shapes' extents (finite) and their offset
  double expected = 0.0;   ///< the true answer: m, or t of a contact; 0 for Collide
  double tolerance = 0.0;  ///< of the answer, in its unit; 0 for Collide
  /// The true answer of Collide, and whether there is a contact for FirstContact to find; empty:
  /// both are right (touching).
  std::optional<bool> hits = {};

  bool isNumber() const {
    return query == PairQuery::FirstContact ? hits == true : query != PairQuery::Collide;
  }
};

/// An entry of the file: a question, or the reason why this program does not answer it.
struct ReplayCase {
  std::string id;
  std::string query;                   ///< as the file names it
  std::optional<PairQuestion> pair;    ///< of two shapes
  std::optional<RobotQuestion> robot;  ///< of a robot in its world
  std::string skipReason;              ///< `query ccd_robot`, `shape robot`; empty with a question
};

/// Calls `visit` with one case after the other; none is kept, so that files may have many, and
/// large ones. Throws InputError, which names the case, the key, its value and what is allowed.
void forEachReplayCase(const std::string& file,
                       const std::function<void(const ReplayCase&)>& visit);

}  // namespace swept
