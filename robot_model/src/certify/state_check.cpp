// SPDX-License-Identifier: BSD-3-Clause
#include "certify/state_check.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace swept::detail {

Verdict checkState(const CheckerModel& model, std::span<const double> q, WorkspaceData& workspace) {
  PairQuery query(model, workspace);
  if (!query.start(q, q)) return Verdict::Undecided;
  query.moveTo(0.0);
  bool proven = true;
  for (std::uint32_t i = 0; i < model.pairs.size(); ++i) {
    const PairAnswer answer = query.prove(i, 0.0);
    if (answer.status == Separation::Contact) return Verdict::Collision;
    proven = proven && answer.status == Separation::Separated;
  }
  return proven ? Verdict::Free : Verdict::Undecided;
}

namespace {

/// Least distance over the pairs at the current state; a pair farther than the best so far is given
/// up as soon as that is proven.
template <typename Visitor>
double leastDistance(const CheckerModel& model, PairQuery& query, const Visitor& nearer) {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < model.pairs.size(); ++i) {
    if (query.coarseDistance(model.pairs[i]) >= least) continue;
    const PairDistance distance = query.measure(i, least, tolerance::kDistance);
    if (!(distance.lower < least)) continue;
    least = distance.lower;
    nearer(i);
  }
  return least;
}

}  // namespace

double stateClearance(const CheckerModel& model, std::span<const double> q,
                      WorkspaceData& workspace) {
  PairQuery query(model, workspace);
  if (!query.start(q, q)) return 0.0;
  query.moveTo(0.0);
  return leastDistance(model, query, [](std::uint32_t) {});
}

StateReport reportState(const CheckerModel& model, std::span<const double> q,
                        WorkspaceData& workspace) {
  StateReport report;
  report.finite = std::all_of(q.begin(), q.end(), [](double v) { return std::isfinite(v); });
  for (int i = 0; i < model.kinematics.dimension; ++i) {
    const double slack = tolerance::kLimit;
    const bool inside =
        q[i] >= model.kinematics.lower[i] - slack && q[i] <= model.kinematics.upper[i] + slack;
    if (!inside) {
      report.outsideLimits.push_back(model.robot->variables()[model.group.variables[i]].name);
    }
  }
  PairQuery query(model, workspace);
  if (!query.start(q, q)) return report;
  query.moveTo(0.0);
  bool proven = true;
  std::set<std::pair<std::string, std::string>> reported;
  for (std::uint32_t i = 0; i < model.pairs.size(); ++i) {
    const PairAnswer answer = query.prove(i, 0.0);
    proven = proven && answer.status == Separation::Separated;
    if (answer.status != Separation::Contact) continue;
    Witness witness = query.witness(i, 0.0, answer);
    if (reported.insert({witness.bodyA, witness.bodyB}).second) {
      report.contacts.push_back(std::move(witness));
    }
  }
  report.clearance = leastDistance(model, query, [&](std::uint32_t i) {
    report.nearestA = model.nameOfA(model.pairs[i]);
    report.nearestB = model.nameOfB(model.pairs[i]);
  });
  if (!report.contacts.empty()) {
    report.verdict = Verdict::Collision;
  } else if (proven) {
    report.verdict = Verdict::Free;
  }
  return report;
}

}  // namespace swept::detail
