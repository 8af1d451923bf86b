// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/root_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace swept::detail {

std::vector<LaneRootRow> compileRootRows(const LaneModel& lanes) {
  const auto radiusOf = [&](int body) { return lanes.nodes[lanes.rootOfBody[body]].radius; };
  const std::size_t eights = (lanes.bodies.size() + kLanes - 1) / kLanes;
  // Of a first body and each eight others, the index into rows; -1: none yet.
  std::vector<std::vector<std::int32_t>> known(lanes.bodies.size());
  std::vector<LaneRootRow> rows;
  for (std::size_t i = 0; i < lanes.bodyPairs.size(); ++i) {
    const LaneBodyPair& pair = lanes.bodyPairs[i];
    const int eight = pair.bodyB / kLanes;
    const int lane = pair.bodyB % kLanes;
    if (known[pair.bodyA].empty()) known[pair.bodyA].resize(eights, -1);
    std::int32_t& at = known[pair.bodyA][eight];
    if (at < 0) {
      at = static_cast<std::int32_t>(rows.size());
      LaneRootRow& added = rows.emplace_back();
      added.radii = added.keep = Row{};
      added.body = pair.bodyA;
      added.eight = eight;
    }
    LaneRootRow& row = rows[at];
    row.radii.lane[lane] = radiusOf(pair.bodyA) + radiusOf(pair.bodyB);
    row.keep.lane[lane] = (lanes.margin + pair.extra) * (1.0F + 1e-6F);
    row.pairs[lane] = static_cast<std::int32_t>(i);
    row.checked |= 1U << lane;
  }
  return rows;
}

}  // namespace swept::detail
