// SPDX-License-Identifier: BSD-3-Clause
#include "output/clearance_text.hpp"

#include <cmath>

#include "text/escaped_text.hpp"

namespace swept {
namespace {

NearestPair nearestOf(const ClearanceInterval& clearance) {
  return {.clearance = clearance.lower, .bodyA = clearance.bodyA, .bodyB = clearance.bodyB};
}

std::string nearestText(const std::string& bodyA, const std::string& bodyB) {
  return bodyA.empty() ? "" : ", nearest " + escapedLine(bodyA + " - " + bodyB);
}

std::string kindText(const std::string& kind, const NearestPair& pair) {
  if (std::isinf(pair.clearance)) return kind + ": no pair to check";
  return kind + " " + clearanceText(pair.clearance) + nearestText(pair.bodyA, pair.bodyB);
}

}  // namespace

Clearances clearancesOf(const MotionClearance& clearance) {
  return {nearestOf(clearance.world), nearestOf(clearance.self)};
}

void takeLeast(const Clearances& other, Clearances& least) {
  if (other.world.clearance < least.world.clearance) least.world = other.world;
  if (other.self.clearance < least.self.clearance) least.self = other.self;
}

std::string clearanceText(double clearance) {
  return std::isinf(clearance) ? "no pair to check" : shortNumber(clearance) + " m";
}

std::string clearanceText(const Clearances& clearances) {
  const bool self = clearances.selfIsLess();
  const NearestPair& least = self ? clearances.self : clearances.world;
  if (std::isinf(least.clearance)) return "no pair to check";
  return "clearance " + clearanceText(least.clearance) + nearestText(least.bodyA, least.bodyB) +
         (self ? " (self); " + kindText("world", clearances.world)
               : " (world); " + kindText("self", clearances.self));
}

std::string boundsText(const ClearanceInterval& clearance) {
  if (std::isinf(clearance.lower)) return "no pair to check";
  return shortNumber(clearance.lower) + " m or more, and no more than " +
         shortNumber(clearance.upper) + " m (at t = " + shortNumber(clearance.t) + ")" +
         nearestText(clearance.bodyA, clearance.bodyB);
}

void addClearances(const Clearances& clearances, Json& json) {
  const auto add = [&](const std::string& kind, const NearestPair& pair) {
    json["clearance_" + kind] = finiteOrNull(pair.clearance);
    json["nearest_" + kind] = nearestJson(pair.bodyA, pair.bodyB);
  };
  add("world", clearances.world);
  add("self", clearances.self);
}

Json boundsJson(const ClearanceInterval& clearance) {
  return {{"lower", finiteOrNull(clearance.lower)},
          {"upper", finiteOrNull(clearance.upper)},
          {"t", clearance.t},
          {"nearest", nearestJson(clearance.bodyA, clearance.bodyB)}};
}

Json nearestJson(const std::string& bodyA, const std::string& bodyB) {
  return bodyA.empty() ? Json(nullptr) : Json::array({bodyA, bodyB});
}

}  // namespace swept
