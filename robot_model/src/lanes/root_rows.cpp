// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/root_rows.hpp"

#include <map>
#include <utility>

namespace swept::detail {

std::vector<LaneRootRow> compileRootRows(const LaneModel& lanes) {
  const auto radiusOf = [&](int body) { return lanes.nodes[lanes.rootOfBody[body]].radius; };
  std::map<std::pair<int, int>, std::size_t> known;
  std::vector<LaneRootRow> rows;
  for (std::size_t i = 0; i < lanes.bodyPairs.size(); ++i) {
    const LaneBodyPair& pair = lanes.bodyPairs[i];
    const int eight = pair.bodyB / kLanes;
    const int lane = pair.bodyB % kLanes;
    const auto [at, isNew] = known.try_emplace({pair.bodyA, eight}, rows.size());
    if (isNew) {
      LaneRootRow& added = rows.emplace_back();
      added.radii = added.keep = Row{};
      added.body = pair.bodyA;
      added.eight = eight;
    }
    LaneRootRow& row = rows[at->second];
    row.radii.lane[lane] = radiusOf(pair.bodyA) + radiusOf(pair.bodyB);
    row.keep.lane[lane] = (lanes.margin + pair.extra) * (1.0F + 1e-6F);
    row.pairs[lane] = static_cast<std::int32_t>(i);
    row.checked |= 1U << lane;
  }
  return rows;
}

}  // namespace swept::detail
