// SPDX-License-Identifier: BSD-3-Clause
#include "pivot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trajectories {

namespace {

using swept::JointType;
using State = std::vector<double>;

/// m. Where planar and floating joints go.
constexpr double kRoom = 1.2;

State anywhere(const Stage& stage, Random& random) {
  State q;
  for (const StageVariable& variable : stage.variables) {
    const bool bounded = std::isfinite(variable.lower) && std::isfinite(variable.upper);
    if (bounded)
      q.push_back(variable.lower + random.uniform(0.05, 0.95) * (variable.upper - variable.lower));
    else
      q.push_back(variable.cyclic ? random.uniform(-1.0, 1.0) * std::numbers::pi
                                  : random.uniform(-kRoom, kRoom));
  }
  for (const StageJoint& joint : stage.joints) {
    if (joint.type != JointType::Floating) continue;
    q[joint.first + 2] = random.uniform(-0.2, 1.2);
    Eigen::Map<Eigen::Vector4d>(q.data() + joint.first + 3).normalize();
  }
  // Joints without limits may have turned before.
  for (std::size_t i = 0; i < q.size(); ++i)
    if (stage.variables[i].cyclic && random.chance(0.2))
      q[i] += 2.0 * std::numbers::pi * (random.below(5) - 2);
  return q;
}

}  // namespace

State makePivot(const Stage& stage, swept::Workspace& workspace, swept::Workspace& plainWorkspace,
                Random& random) {
  State open = anywhere(stage, random);
  if (random.chance(0.35)) return open;
  const bool inTube = random.chance(0.6);
  const double time = random.uniform(0.0, 3.0);
  const auto isFree = [&](const State& q) {
    State full = q;
    if (stage.timed) full.push_back(time);
    const swept::Verdict verdict = inTube ? stage.checker.checkState(full, workspace)
                                          : stage.plain.checkState(full, plainWorkspace);
    return verdict == swept::Verdict::Free;
  };
  for (int tries = 0; tries < 50 && !isFree(open); ++tries) open = anywhere(stage, random);
  State blocked = anywhere(stage, random);
  for (int tries = 0; tries < 50 && isFree(blocked); ++tries) blocked = anywhere(stage, random);
  if (!isFree(open) || isFree(blocked)) return open;
  const auto between = [&](double share) {
    State q = open;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += share * (blocked[i] - open[i]);
    for (const StageJoint& joint : stage.joints)
      if (joint.type == JointType::Floating)
        Eigen::Map<Eigen::Vector4d>(q.data() + joint.first + 3).normalize();
    return q;
  };
  double low = 0.0;
  double high = 1.0;
  while (high - low > 1e-4) {
    const double middle = 0.5 * (low + high);
    (isFree(between(middle)) ? low : high) = middle;
  }
  // Seldom to the last bit.
  return between(low * (1.0 - (random.chance(0.9) ? random.decades(-2.5, -0.5) : 0.0)));
}

}  // namespace trajectories
