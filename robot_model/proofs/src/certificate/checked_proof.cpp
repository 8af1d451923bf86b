// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/checked_proof.hpp"

#include <map>
#include <string>

namespace swept {
namespace {

std::map<std::string, JointTolerance> tubeOf(const verify::Summary& summary) {
  std::map<std::string, JointTolerance> tube;
  for (const auto& [joint, tolerance] : summary.tube)
    tube[joint] = {.rotation = tolerance.rotation.value_or(0.0),
                   .translation = tolerance.translation.value_or(0.0)};
  return tube;
}

}  // namespace

CheckedProof checkedProof(const VerifyOutcome& outcome) {
  if (!outcome.holds()) return {.refusal = outcome.refusal, .notChecked = {}};
  return checkedProof(outcome.summary);
}

CheckedProof checkedProof(const verify::Summary& summary) {
  return {.refusal = {},
          .segments = summary.segments,
          .pairs = summary.pairs,
          .intervals = summary.intervals,
          .planes = summary.planes,
          .clearance = summary.clearance,
          .clearanceWorld = summary.clearanceWorld,
          .clearanceSelf = summary.clearanceSelf,
          .notChecked = summary.allowed,
          .duration = summary.duration,
          .tube = tubeOf(summary),
          .constraints = summary.constraints,
          .moving = summary.moving,
          .clockBegin = summary.clockBegin,
          .clockEnd = summary.clockEnd};
}

}  // namespace swept
