// SPDX-License-Identifier: BSD-3-Clause
#include "simd/tables/table_candidates.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <tuple>

#include "model/pair_model.hpp"
#include "simd/tables/pair_separation_table.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Number of tables with the finest cells, some 0.6 MB each: if cells are twice as coarse, four
/// times as many take as much.
constexpr std::size_t kFineTables = 128;

struct Candidate {
  std::int32_t bodyPair = 0;
  int joints = 0;
  float gap = 0.0F;  ///< m
};

/// Joints from a body up to one that carries it; more than a table can have if one of them does not
/// turn.
int turningJoints(const PairModel& model, int body, int reference) {
  int joints = 0;
  for (; body != reference && joints <= PairSeparationTable::kMostJoints;
       body = model.kinematics.bodies[body].parent)
    joints += turns(model.kinematics.bodies[body].type) ? 1 : PairSeparationTable::kMostJoints + 1;
  return joints;
}

std::vector<Candidate> allCandidates(const PairModel& model, const SimdModel& simd,
                                     const std::vector<char>& never) {
  std::vector<Candidate> found;
  for (std::size_t i = 0; i < simd.bodyPairs.size(); ++i) {
    if (never[i] != 0) continue;
    const SimdBodyPair& bodies = simd.bodyPairs[i];
    const int reference = simd.references[bodies.reference].body;
    const int joints = turningJoints(model, bodies.bodyA, reference) +
                       turningJoints(model, bodies.bodyB, reference);
    if (joints <= PairSeparationTable::kMostJoints)
      found.push_back({static_cast<std::int32_t>(i), joints});
  }
  return found;
}

/// Bodies in the reference configuration; free slides at their joint. Only for a choice.
std::vector<Isometry3d> referencePoses(const PairModel& model) {
  const KinematicModel& kinematics = model.kinematics;
  std::vector<double> q;
  for (const int variable : model.group.variables)
    q.push_back((*model.options.reference)[static_cast<Eigen::Index>(variable)]);
  std::vector<BodyState> states(kinematics.bodies.size());
  for (std::size_t i = 1; i < states.size(); ++i) {
    const MovingBody& body = kinematics.bodies[i];
    JointMotion motion;
    if (!slidesFreely(body.type) && !compileJoint(kinematics, body, q, q, motion)) motion = {};
    states[i] = bodyAt(body, motion, 0.0, states[body.parent]);
  }
  std::vector<Isometry3d> poses;
  for (const BodyState& state : states) poses.push_back(state.world_from_body);
  return poses;
}

void measureGaps(const PairModel& model, const SimdModel& simd,
                 std::vector<Candidate>& candidates) {
  const std::vector<Isometry3d> poses = referencePoses(model);
  std::vector<Vector3d> centers(poses.size(), Vector3d::Zero());
  std::vector<float> radii(poses.size(), 0.0F);
  for (std::size_t body = 0; body < poses.size(); ++body) {
    if (simd.rootOfBody[body] < 0) continue;
    const SimdNode& root = simd.nodes[simd.rootOfBody[body]];
    const Vector3d center(root.center[0], root.center[1], root.center[2]);
    centers[body] = poses[body] * (simd.bodyFromLane[body] * center);
    radii[body] = root.radius;
  }
  for (Candidate& candidate : candidates) {
    const SimdBodyPair& bodies = simd.bodyPairs[candidate.bodyPair];
    const double apart = (centers[bodies.bodyA] - centers[bodies.bodyB]).norm();
    candidate.gap = static_cast<float>(apart) - radii[bodies.bodyA] - radii[bodies.bodyB];
    // NaN has no order.
    if (!(candidate.gap < std::numeric_limits<float>::max()))
      candidate.gap = std::numeric_limits<float>::max();
  }
}

}  // namespace

TableCandidates tableCandidates(const PairModel& model, const SimdModel& simd,
                                const std::vector<char>& never, std::size_t most) {
  std::vector<Candidate> candidates = allCandidates(model, simd, never);
  if (candidates.size() > most) {
    measureGaps(model, simd, candidates);
    std::ranges::partial_sort(candidates, candidates.begin() + static_cast<std::ptrdiff_t>(most),
                              {}, [](const Candidate& candidate) {
                                return std::tuple(candidate.joints, candidate.gap,
                                                  candidate.bodyPair);
                              });
    candidates.resize(most);
  }
  TableCandidates result;
  for (const Candidate& candidate : candidates) result.bodyPairs.push_back(candidate.bodyPair);
  std::ranges::sort(result.bodyPairs);
  const auto fits = [&](int coarseness) {
    const auto times = static_cast<std::size_t>(coarseness);
    return candidates.size() <= kFineTables * times * times;
  };
  while (!fits(result.coarseness)) result.coarseness *= 2;
  return result;
}

}  // namespace swept::detail
