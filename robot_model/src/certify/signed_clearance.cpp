// SPDX-License-Identifier: BSD-3-Clause
#include "certify/signed_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "certify/near_pairs.hpp"
#include "certify/waypoint_segments.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// rad or m. Step of a difference quotient. Rates are exact for a step of any size, except those of
/// a quaternion, for which this is small enough.
constexpr double kStep = 1e-6;
/// Smallest step, in units of the spacing of doubles at the value. No more than needed, since
/// obstacles turn and clocks may count large numbers.
constexpr double kFewestUlps = 4.0;

/// The least distance so far, and its pair.
struct NearestApart {
  SignedClearance clearance;
  GeometryPair pair;
  bool known = false;

  NearestApart() {
    clearance.lower = std::numeric_limits<double>::infinity();
    clearance.upper = std::numeric_limits<double>::infinity();
  }
  void add(const GeometryPair& other, const SignedClearance& found) {
    const double lower = std::min(clearance.lower, found.lower);
    if (!known || found.upper < clearance.upper) {
      clearance = found;
      pair = other;
      known = true;
    }
    clearance.lower = lower;
  }
};

SignedClearance apart(const PairDistance& distance) {
  SignedClearance found{distance.lower, distance.upper, distance.pointA, distance.pointB,
                        Vector3d::Zero()};
  const Vector3d between = distance.pointB - distance.pointA;
  const double length = between.norm();
  if (length > 0.0) found.normal = between / length;
  return found;
}

NearestApart nearestApart(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace) {
  NearestApart nearest;
  NearGeometries(model, query, workspace).forNearest(0.0, [&](const GeometryPair& pair) {
    const double enough = nearest.clearance.lower;
    const PairDistance distance = query.measure(pair, enough, tolerance::kDistance);
    if (distance.lower < enough) nearest.add(pair, apart(distance));
    return nearest.clearance.lower;
  });
  return nearest;
}

/// The deepest of the pairs whose boxes overlap. All other pairs are apart.
NearestApart deepest(const CheckerModel& model, PairQuery& query, WorkspaceData& workspace) {
  NearestApart nearest;
  NearGeometries(model, query, workspace).collect(0.0, workspace.pairs);
  for (const std::uint32_t index : workspace.pairs) {
    const GeometryPair& pair = model.pair(index);
    if (query.coarseDistance(pair) > 0.0 || query.measure(pair, 0.0, 0.0).lower > 0.0) continue;
    nearest.add(pair, query.measureSigned(pair, tolerance::kDistance));
  }
  // Pairs that are apart need no more.
  nearest.clearance.lower = std::min(nearest.clearance.lower, 0.0);
  return nearest;
}

/// The value one step away that the joint's limits allow. The same value: no step is possible.
double stepFrom(const KinematicModel& model, std::size_t value, double q) {
  const double ulps = kFewestUlps * std::numeric_limits<double>::epsilon() * std::abs(q);
  const double step = std::max(kStep, ulps);
  if (q + step <= model.upper[value]) return q + step;
  return q - step >= model.lower[value] ? q - step : q;
}

/// The relative velocity of the pair's points along the normal, for each value of the
/// configuration.
void differentiate(const CheckerModel& model, PairQuery& query, std::span<const double> q,
                   const NearestApart& nearest, std::span<double> gradient,
                   WorkspaceData& workspace) {
  const SignedClearance& found = nearest.clearance;
  std::ranges::copy(q, workspace.probe.begin());
  const std::span<const double> from = fullConfiguration(model, q, workspace.from);
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    gradient[i] = 0.0;
    workspace.probe[i] = stepFrom(model.kinematics, i, q[i]);
    const double step = workspace.probe[i] - q[i];  // rounding has changed it
    const std::span<const double> to = fullConfiguration(model, workspace.probe, workspace.to);
    const StraightPath path(model.kinematics, from, to);
    if (step != 0.0 && query.start(path)) {
      query.moveTo(0.0, 0.0);
      const Vector3d velocity = query.velocity(nearest.pair, found.pointA, found.pointB);
      gradient[i] = found.normal.dot(velocity) / step;
    }
    workspace.probe[i] = q[i];
  }
}

}  // namespace

SignedClearance signedClearance(const CheckerModel& model, std::span<const double> configuration,
                                std::span<double> gradient, WorkspaceData& workspace) {
  std::ranges::fill(gradient, 0.0);
  const std::span<const double> q = fullConfiguration(model, configuration, workspace.from);
  PairQuery query(model, workspace);
  if (!query.startAt(q)) return {};
  NearestApart nearest = nearestApart(model, query, workspace);
  if (!(nearest.clearance.lower > 0.0)) {
    const NearestApart overlap = deepest(model, query, workspace);
    if (overlap.known) nearest = overlap;
  }
  if (nearest.known && !gradient.empty()) {
    differentiate(model, query, configuration, nearest, gradient, workspace);
  }
  return nearest.clearance;
}

}  // namespace swept::detail
