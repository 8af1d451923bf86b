// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bench/clock.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// A motion in the order of the group's variables.
struct BenchMotion {
  std::vector<double> from, to;
};

/// What the usual stack says of a motion, and how long it takes.
struct FclResult {
  bool startValid = false;   ///< the motion's start; OMPL takes it for granted, and it is not timed
  bool motionValid = false;  ///< all sampled states but the start
  double nanoseconds = 0.0;  ///< least of all passes

  bool valid() const { return startValid && motionValid; }
};

/// Is FCL part of this build?
bool builtWithFcl();
/// Its version; empty without it.
std::string fclVersion();

/// What a user of OMPL and FCL gets: OMPL's DiscreteMotionValidator at its default resolution
/// (steps of 1 % of the space's extent) in the state space of the group; a state is valid when FCL
/// finds none of the checker's pairs in collision. Meshes are BVHModel<OBBRSS>, the world is in a
/// DynamicAABBTreeCollisionManager. Throws UsageError for a
/// shape that FCL does not have, or without FCL.
std::vector<FclResult> measureFcl(const Checker& checker, const std::vector<BenchMotion>& motions,
                                  int passes, const BenchClock& clock);

}  // namespace swept
