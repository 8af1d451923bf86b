// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// A link, an attached body or a body of the world as it is checked.
struct CertifiedBody {
  std::string name;       ///< the robot's or the world's: what rules are about
  std::string proofName;  ///< of this body alone
  int link = -1;          ///< that it moves with; -1: the world
  struct Part {
    Shape shape;
    Eigen::Isometry3d body_from_shape;
  };
  std::vector<Part> parts;
  const MovingObstacle* moving = nullptr;  ///< it moves like this, in the checker's world
};

/// The bodies with geometry, the robot's first, in the order of modelJson()'s bodies. Where a body
/// of the world has the name of a link, its name in the proof ends in ` (world)`, repeated until no
/// other body has that name.
std::vector<CertifiedBody> certifiedBodies(const Checker& checker);

/// The model that a proof is about, in the form that robot_model/verify reads: kinematics, geometry
/// bit for bit, margins, pairs that may touch, tolerances of joints, waypoints of what moves.
Json modelJson(const Checker& checker);

/// 12 numbers: the rotation by rows, then the translation (m).
Json poseJson(const Eigen::Isometry3d& pose);

/// Throws UsageError if something of the world moves: `what` has no times, or more than one clock.
void requireStanding(const Checker& checker, const std::string& what);

/// Throws UsageError if something that moves turns by about half a turn between two times without
/// another number between them: a proof does not tell which way round.
void requireTimesOfTurns(const Checker& checker);

/// Throws UsageError, beginning with `where`, for the first name or reason in modelJson() that is
/// not UTF-8.
void requireModelNames(const Checker& checker, const std::string& where);

}  // namespace swept
