// SPDX-License-Identifier: BSD-3-Clause
#include "certify/nearest_points.hpp"

namespace swept::detail {

void takeNearestPoints(const CheckerModel& model, PairQuery& query, Witness& witness) {
  for (const GeometryPair& pair : model.pairs) {
    if (!(witness.distance > 0.0)) return;
    const bool same = model.isSelfPair(pair) == witness.selfPair &&
                      model.nameOfA(pair) == witness.bodyA && model.nameOfB(pair) == witness.bodyB;
    if (!same) continue;
    const PairDistance found = query.measure(pair, witness.distance, tolerance::kDistance);
    if (!(found.upper < witness.distance)) continue;
    witness.distance = found.upper;
    witness.pointA = found.pointA;
    witness.pointB = found.pointB;
  }
}

}  // namespace swept::detail
