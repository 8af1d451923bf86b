// SPDX-License-Identifier: BSD-3-Clause
#include "certify/nearest_points.hpp"

#include <algorithm>

#include "certify/waypoint_segments.hpp"

namespace swept::detail {

namespace {

/// Moving obstacles come last, and no link or attached body has the name of one.
int collisionBodyNamed(const CheckerModel& model, const std::string& name) {
  const auto found = std::ranges::find(model.collisionBodies, name, &CollisionBody::name);
  return found == model.collisionBodies.end()
             ? -1
             : static_cast<int>(found - model.collisionBodies.begin());
}

int bodyNamed(const CheckerModel& model, const std::string& name) {
  const auto& bodies = model.world->bodies();
  const auto found = std::ranges::find(bodies, name, &WorldBody::name);
  return found == bodies.end() ? -1 : static_cast<int>(found - bodies.begin());
}

void takeNearest(const CheckerModel& model, PairQuery& query, Witness& witness) {
  const int a = collisionBodyNamed(model, witness.bodyA);
  const int body = witness.selfPair ? -1 : bodyNamed(model, witness.bodyB);
  const int collisionBody = body < 0 ? collisionBodyNamed(model, witness.bodyB) : -1;
  for (std::size_t i = 0; i < model.pairCount(); ++i) {
    const GeometryPair pair = model.pair(i);
    if (model.robotGeometry[pair.a].collisionBody != a) continue;
    const bool same = pair.self ? model.robotGeometry[pair.b].collisionBody == collisionBody
                                : model.worldGeometry[pair.b].body == body;
    if (!same) continue;
    const PairDistance found = query.measure(pair, witness.distance, tolerance::kDistance);
    if (!(found.upper < witness.distance)) continue;
    witness.distance = found.upper;
    witness.pointA = found.pointA;
    witness.pointB = found.pointB;
  }
}

}  // namespace

void takeNearestPoints(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace,
                       Witness& witness) {
  if (!(witness.distance > 0.0)) return;
  if (witness.configuration.empty()) {
    query.moveTo(witness.t, 0.0);
    return takeNearest(model, query, witness);
  }
  WorkspaceData& other = *workspace.besideMotion;  // where the contact was found
  PairQuery beside(model, other, Tube::None);
  if (beside.startAt(fullConfiguration(model, witness.configuration, other.from)))
    takeNearest(model, beside, witness);
}

}  // namespace swept::detail
