// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

/// How clearances look. Those of pairs with the world and those of the robot's own bodies are told
/// apart everywhere: links that are always near each other would hide the world.
namespace swept {

/// Of both kinds; proven lower bounds.
struct Clearances {
  NearestPair world;
  NearestPair self;

  bool selfIsLess() const { return self.clearance < world.clearance; }
};

inline Clearances clearancesOf(const StateReport& report) {
  return {report.world, report.self};
}
Clearances clearancesOf(const MotionClearance& clearance);
/// Of a path: what is least so far, and what another motion of it keeps.
void takeLeast(const Clearances& other, Clearances& least);

/// `0.012 m`. `clearance`: m; infinity where there is no pair.
std::string clearanceText(double clearance);
/// `clearance 0.012 m, nearest forearm - wrist (self); world 0.21 m, nearest hand - shelf`; the
/// lesser first. `no pair to check` without pairs.
std::string clearanceText(const Clearances& clearances);
/// `0.011 m or more, and no more than 0.012 m (at t = 0.5), nearest hand - shelf`.
std::string boundsText(const ClearanceInterval& clearance);

/// `clearance_world`, `nearest_world`, and the same of self. Null without pairs.
void addClearances(const Clearances& clearances, Json& json);
/// `{"lower", "upper", "t", "nearest"}`.
Json boundsJson(const ClearanceInterval& clearance);
/// `[a, b]`; null without names.
Json nearestJson(const std::string& bodyA, const std::string& bodyB);

}  // namespace swept
