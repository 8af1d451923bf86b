// SPDX-License-Identifier: BSD-3-Clause
#include "certify/state_check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "certify/lane_witness.hpp"
#include "certify/near_pairs.hpp"
#include "certify/obstacle_clock.hpp"
#include "lanes/lane_motion.hpp"
#include "lanes/lane_search.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept::detail {

namespace {

/// Of these pairs, by exact geometry, at the state that the query is at.
Verdict provePairs(PairQuery& query, std::span<const std::uint32_t> pairs) {
  bool proven = true;
  for (const std::uint32_t pair : pairs) {
    const PairAnswer answer = query.prove(pair, 0.0);
    if (answer.status == Separation::Contact) return Verdict::Collision;
    proven = proven && answer.status == Separation::Separated;
  }
  return proven ? Verdict::Free : Verdict::Undecided;
}

bool startAt(PairQuery& query, std::span<const double> q) {
  if (!query.start(q, q)) return false;
  query.moveTo(0.0);
  return true;
}

Verdict checkPairs(const CheckerModel& model, std::span<const double> q,
                   std::span<const std::uint32_t> pairs, WorkspaceData& workspace) {
  PairQuery query(model, workspace);
  return startAt(query, q) ? provePairs(query, pairs) : Verdict::Undecided;
}

Verdict checkAllPairs(const CheckerModel& model, std::span<const double> q,
                      WorkspaceData& workspace) {
  PairQuery query(model, workspace);
  if (!startAt(query, q)) return Verdict::Undecided;
  NearGeometries(model, query, workspace).collect(0.0, workspace.arena);
  return provePairs(query, workspace.arena);
}

/// What the lane tier found out in one lane, and exact geometry about the rest.
Verdict verdictOf(const CheckerModel& model, std::span<const double> q, int lane,
                  WorkspaceData& workspace) {
  const LaneBlock& block = workspace.lanes.block;
  if ((block.contactLanes >> lane & 1U) != 0) {
    if (commonPoint(model, block.contacts[lane])) return Verdict::Collision;
    return checkAllPairs(model, q, workspace);
  }
  takeOpen(lane, workspace.lanes);
  auto& pairs = workspace.lanes.restArena;
  if (pairs.empty()) return Verdict::Free;
  // The one most likely to be in contact first.
  const auto suspect = std::ranges::find(pairs, block.suspect.pair);
  if (suspect != pairs.end()) std::iter_swap(pairs.begin(), suspect);
  return checkPairs(model, q, workspace.lanes.restArena, workspace);
}

}  // namespace

Verdict checkState(const CheckerModel& model, std::span<const double> configuration,
                   WorkspaceData& workspace) {
  const std::span<const double> q = wholeConfiguration(model, configuration, workspace.from);
  const bool fits =
      model.lanes.usable && compileLaneState(model.lanes, model.kinematics, q, workspace.lanes);
  if (!fits) return checkAllPairs(model, q, workspace);
  searchStates(model.lanes, LaneMode::State, LaneContacts::Sought, workspace.lanes);
  const std::uint32_t contacts = workspace.lanes.block.contactLanes;
  return verdictOf(model, q, contacts == 0 ? 0 : std::countr_zero(contacts), workspace);
}

void checkStates(const CheckerModel& model, std::span<const double> states,
                 std::span<Verdict> verdicts, WorkspaceData& workspace) {
  const auto dimension = static_cast<std::size_t>(model.kinematics.dimension);
  for (std::size_t first = 0; first < verdicts.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, verdicts.size() - first);
    const std::span<const double> some = states.subspan(first * dimension, count * dimension);
    const bool fits = count > 1 && dimension > 0 && model.lanes.usable &&
                      compileLaneStates(model.lanes, model.kinematics, some, workspace.lanes);
    if (fits) searchStates(model.lanes, LaneMode::States, LaneContacts::Sought, workspace.lanes);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const std::span<const double> q = some.subspan(lane * dimension, dimension);
      verdicts[first + lane] = fits ? verdictOf(model, q, static_cast<int>(lane), workspace)
                                    : checkState(model, q, workspace);
    }
  }
}

namespace {

/// Least distance over all pieces of the checked pairs at the current state; pieces farther apart
/// than the best so far are given up as soon as that is proven.
template <typename Visitor>
double leastDistance(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace,
                     const Visitor& nearer) {
  double least = std::numeric_limits<double>::infinity();
  NearGeometries(model, query, workspace).forNearest(0.0, [&](const GeometryPair& pair) {
    const PairDistance distance = query.measure(pair, least, tolerance::kDistance);
    if (distance.lower < least) {
      least = distance.lower;
      nearer(pair);
    }
    return least;
  });
  return least;
}

}  // namespace

double stateClearance(const CheckerModel& model, std::span<const double> configuration,
                      WorkspaceData& workspace) {
  const std::span<const double> q = wholeConfiguration(model, configuration, workspace.from);
  PairQuery query(model, workspace);
  if (!startAt(query, q)) return 0.0;
  return leastDistance(model, query, workspace, [](const GeometryPair&) {});
}

StateReport reportState(const CheckerModel& model, std::span<const double> configuration,
                        WorkspaceData& workspace) {
  const std::span<const double> q = wholeConfiguration(model, configuration, workspace.from);
  StateReport report;
  report.finite = std::all_of(q.begin(), q.end(), [](double v) { return std::isfinite(v); });
  for (std::size_t i = 0; i < model.group.variables.size(); ++i) {
    if (!isWithin(q[i], model.kinematics.lower[i], model.kinematics.upper[i])) {
      report.outsideLimits.push_back(model.robot->variables()[model.group.variables[i]].name);
    }
  }
  PairQuery query(model, workspace);
  if (!startAt(query, q)) return report;
  NearGeometries(model, query, workspace).collect(0.0, workspace.arena);
  bool proven = true;
  std::set<std::tuple<std::string, std::string, bool>> reported;
  for (const std::uint32_t i : workspace.arena) {
    const PairAnswer answer = query.prove(i, 0.0);
    proven = proven && answer.status == Separation::Separated;
    if (answer.status != Separation::Contact) continue;
    Witness witness = query.witness(i, 0.0, answer);
    if (reported.insert({witness.bodyA, witness.bodyB, witness.selfPair}).second) {
      report.contacts.push_back(std::move(witness));
    }
  }
  report.clearance = leastDistance(model, query, workspace, [&](const GeometryPair& pair) {
    report.nearestA = model.nameOfA(pair);
    report.nearestB = model.nameOfB(pair);
    report.nearestSelfPair = model.isSelfPair(pair);
  });
  if (!report.contacts.empty()) {
    report.verdict = Verdict::Collision;
  } else if (proven) {
    report.verdict = Verdict::Free;
  }
  return report;
}

}  // namespace swept::detail
