// SPDX-License-Identifier: BSD-3-Clause
#include "certify/state_check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "certify/motion_check.hpp"
#include "certify/near_pairs.hpp"
#include "certify/nearest_points.hpp"
#include "certify/simd_witness.hpp"
#include "certify/waypoint_segments.hpp"
#include "constraints/constraint_proof.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/search/simd_search.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept::detail {

namespace {

/// The verdict on these pairs, by exact geometry, at the query's state.
Verdict provePairs(PairQuery& query, std::span<const std::uint32_t> pairs) {
  bool proven = true;
  for (const std::uint32_t pair : pairs) {
    const PairAnswer answer = query.prove(pair, 0.0);
    if (answer.status == Separation::Contact) return Verdict::Collision;
    if (answer.status == Separation::Separated) continue;
    if (query.tubeContact(pair, answer)) return Verdict::Collision;
    proven = false;
  }
  return proven ? Verdict::Free : Verdict::Undecided;
}

Verdict checkPairs(const CheckerModel& model, std::span<const double> q,
                   std::span<const std::uint32_t> pairs, WorkspaceData& workspace) {
  PairQuery query(model, workspace);
  return query.startAt(q) ? provePairs(query, pairs) : Verdict::Undecided;
}

Verdict checkAllPairs(const CheckerModel& model, std::span<const double> q,
                      WorkspaceData& workspace) {
  PairQuery query(model, workspace);
  if (!query.startAt(q)) return Verdict::Undecided;
  NearGeometries(model, query, workspace).collect(0.0, workspace.pairs);
  return provePairs(query, workspace.pairs);
}

bool isContact(const CheckerModel& model, std::span<const double> q, const SimdContact& contact,
               WorkspaceData& workspace) {
  PairQuery query(model, workspace);
  const GeometryPair pair = model.pair(contact.pair);
  if (pair.self && !query.startAt(q)) return false;
  return contactPoints(model, query, pair, contact).has_value();
}

/// The verdict on the state in one lane: by the SIMD tier, and by exact geometry for what it left
/// open.
Verdict verdictOf(const CheckerModel& model, std::span<const double> q, int lane,
                  WorkspaceData& workspace) {
  const SimdBlock& block = workspace.simd.block;
  if ((block.contactLanes >> lane & 1U) != 0) {
    if (isContact(model, q, block.contacts[lane], workspace)) return Verdict::Collision;
    return checkAllPairs(model, q, workspace);
  }
  std::vector<std::uint32_t>& pairs = workspace.pairs;
  takeOpen(lane, block, pairs);
  if (pairs.empty()) return Verdict::Free;
  // Examine the likeliest contact first.
  const auto likelyContact = std::ranges::find(pairs, block.likelyContact.pair);
  if (likelyContact != pairs.end()) std::iter_swap(pairs.begin(), likelyContact);
  return checkPairs(model, q, pairs, workspace);
}

Verdict checkAlone(const CheckerModel& model, std::span<const double> configuration,
                   WorkspaceData& workspace) {
  const std::span<const double> q = fullConfiguration(model, configuration, workspace.from);
  const bool fits =
      model.simd.usable && compileSimdState(model.simd, model.kinematics, q, workspace.simd);
  if (!fits) return checkAllPairs(model, q, workspace);
  searchStates(model.simd, SimdMode::State, SimdContacts::Sought, workspace.simd);
  const std::uint32_t contacts = workspace.simd.block.contactLanes;
  return verdictOf(model, q, contacts == 0 ? 0 : std::countr_zero(contacts), workspace);
}

/// Of the constraints alone.
Verdict taskVerdict(const CheckerModel& model, std::span<const double> configuration,
                    WorkspaceData& workspace) {
  if (model.constraints.empty()) return Verdict::Free;
  return proveConstraints(constraintsOf(model, workspace), configuration).verdict;
}

/// In a tube, planes between hulls may prove of a motion that stays where it is what exact geometry
/// leaves open: they take the largest error at each vertex, not in a box around all of them.
Verdict settled(const CheckerModel& model, std::span<const double> configuration, Verdict verdict,
                WorkspaceData& workspace) {
  if (verdict != Verdict::Undecided || model.tube.empty()) return verdict;
  const MotionCertificate still =
      certifyMotion(model, configuration, configuration, MotionQuery::VerdictOnly, workspace);
  return still.verdict == Verdict::Free ? Verdict::Free : Verdict::Undecided;
}

}  // namespace

Verdict checkState(const CheckerModel& model, std::span<const double> configuration,
                   WorkspaceData& workspace) {
  const Verdict task = taskVerdict(model, configuration, workspace);
  if (task == Verdict::Violation) return task;
  const Verdict pairs =
      settled(model, configuration, checkAlone(model, configuration, workspace), workspace);
  return pairs == Verdict::Free ? task : pairs;
}

void checkStates(const CheckerModel& model, std::span<const double> states,
                 std::span<Verdict> verdicts, WorkspaceData& workspace) {
  const auto dimension = static_cast<std::size_t>(model.kinematics.dimension);
  for (std::size_t first = 0; first < verdicts.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, verdicts.size() - first);
    const std::span<const double> some = states.subspan(first * dimension, count * dimension);
    const bool fits = count > 1 && dimension > 0 && model.simd.usable &&
                      compileSimdStates(model.simd, model.kinematics, some, workspace.simd);
    if (fits) searchStates(model.simd, SimdMode::States, SimdContacts::Sought, workspace.simd);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::span<const double> q = some.subspan(lane * dimension, dimension);
      verdicts[first + lane] = fits ? verdictOf(model, q, static_cast<int>(lane), workspace)
                                    : checkAlone(model, q, workspace);
    }
    // Only now: it needs the workspace.
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::span<const double> q = some.subspan(lane * dimension, dimension);
      Verdict& verdict = verdicts[first + lane];
      verdict = settled(model, q, verdict, workspace);
      const Verdict task = taskVerdict(model, q, workspace);
      if (verdict == Verdict::Free || task == Verdict::Violation) verdict = task;
    }
  }
}

namespace {

/// The nearest pair at the current state.
struct Nearest {
  double lower = std::numeric_limits<double>::infinity();  ///< m
  std::optional<GeometryPair> pair;
};

struct NearestOfKinds {
  Nearest world, self;
};

/// The nearest of all pieces of the checked pairs. A distance query stops once its pair is proven
/// farther apart than the best so far.
NearestOfKinds nearestPairs(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace) {
  NearestOfKinds found;
  NearGeometries(model, query, workspace).forNearestByKind(0.0, [&](const GeometryPair& pair) {
    Nearest& least = model.isSelfPair(pair) ? found.self : found.world;
    const PairDistance distance = query.measure(pair, least.lower, tolerance::kDistance);
    if (distance.lower < least.lower) least = {distance.lower, pair};
    return least.lower;
  });
  return found;
}

NearestPair named(const CheckerModel& model, const Nearest& nearest) {
  NearestPair result{.clearance = nearest.lower, .bodyA = {}, .bodyB = {}};
  if (!nearest.pair) return result;
  result.bodyA = model.nameOfA(*nearest.pair);
  result.bodyB = model.nameOfB(*nearest.pair);
  return result;
}

}  // namespace

double stateClearance(const CheckerModel& model, std::span<const double> configuration,
                      WorkspaceData& workspace) {
  const std::span<const double> q = fullConfiguration(model, configuration, workspace.from);
  PairQuery query(model, workspace);
  if (!query.startAt(q)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  NearGeometries(model, query, workspace).forNearest(0.0, [&](const GeometryPair& pair) {
    least = std::min(least, query.measure(pair, least, tolerance::kDistance).lower);
    return least;
  });
  return least;
}

StateReport reportState(const CheckerModel& model, std::span<const double> configuration,
                        WorkspaceData& workspace) {
  const std::span<const double> q = fullConfiguration(model, configuration, workspace.from);
  StateReport report;
  report.constraintsHold = model.constraints.empty();
  report.finite = std::all_of(q.begin(), q.end(), [](double v) { return std::isfinite(v); });
  for (std::size_t i = 0; i < model.group.variables.size(); ++i) {
    if (!isWithin(q[i], model.kinematics.lower[i], model.kinematics.upper[i])) {
      report.outsideLimits.push_back(model.robot->variables()[model.group.variables[i]].name);
    }
  }
  PairQuery query(model, workspace);
  if (!query.startAt(q)) return report;
  NearGeometries(model, query, workspace).collect(0.0, workspace.pairs);
  bool proven = true;
  std::set<std::tuple<std::string, std::string, bool>> reported;
  for (const std::uint32_t i : workspace.pairs) {
    const PairAnswer answer = query.prove(i, 0.0);
    if (answer.status == Separation::Separated) continue;
    proven = false;
    std::optional<Witness> witness;
    if (answer.status == Separation::Contact)
      witness = query.witness(i, 0.0, answer);
    else
      witness = query.tubeContact(i, answer);
    if (!witness) continue;
    if (reported.insert({witness->bodyA, witness->bodyB, witness->selfPair}).second) {
      report.contacts.push_back(*std::move(witness));
    }
  }
  for (Witness& contact : report.contacts) takeNearestPoints(model, query, workspace, contact);
  const NearestOfKinds nearest = nearestPairs(model, query, workspace);
  report.world = named(model, nearest.world);
  report.self = named(model, nearest.self);
  report.nearestSelfPair = report.self.clearance < report.world.clearance;
  const NearestPair& least = report.nearestSelfPair ? report.self : report.world;
  report.clearance = least.clearance;
  report.nearestA = least.bodyA;
  report.nearestB = least.bodyB;
  // In a tube, checkState() proves what exact geometry alone leaves open: by tables, and by planes.
  if (!report.contacts.empty()) {
    report.verdict = Verdict::Collision;
  } else if (proven || (!model.tube.empty() &&
                        checkState(model, configuration, workspace) == Verdict::Free)) {
    report.verdict = Verdict::Free;
  }
  if (model.constraints.empty()) return report;
  const Verdict task =
      proveConstraints(constraintsOf(model, workspace), q, &report.violations).verdict;
  report.constraintsHold = task == Verdict::Free;
  if (report.verdict == Verdict::Free || task == Verdict::Violation) report.verdict = task;
  return report;
}

}  // namespace swept::detail
