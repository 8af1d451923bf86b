// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/lane_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <variant>

#include "model/pair_model.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/compile/single.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;

constexpr double kPi = std::numbers::pi;

void assignRows(const Matrix3d& from, float (&to)[9]) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) to[3 * r + c] = static_cast<float>(from(r, c));
}

LanePath pathFrom(std::span<const int> bodies, std::span<const double> arms) {
  return {{bodies.begin(), bodies.end()}, {arms.begin(), arms.end()}};
}

class LaneCompiler {
 public:
  LaneCompiler(const ConstraintModel& task, const SimdModel& simd) : task_(task), simd_(simd) {}

  LaneConstraint operator()(const JointRange& /*own*/) const { return {}; }

  LaneConstraint operator()(const Tilt& own) const {
    LaneConstraint lane;
    lane.test = own.angle < kPi ? LaneTest::Tilt : LaneTest::Always;
    lane.first = vectorOf(own.axis);
    limit(0, own.angle, lane);
    return lane;
  }

  LaneConstraint operator()(const EulerTolerances& own) const {
    LaneConstraint lane;
    lane.test = LaneTest::Euler;
    lane.first = vectorOf(own.z);
    lane.second = vectorOf(own.x);
    for (int i = 0; i < 3; ++i) limit(i, own.tolerance[i], lane);
    lane.limited[1] = own.tolerance.y() < 0.5 * kPi;
    return lane;
  }

  LaneConstraint operator()(const RotationVectorTolerances& own) const {
    const ConstrainedLink& link = task_.links[own.link];
    LaneConstraint lane;
    lane.test = own.tolerance.minCoeff() < kPi ? LaneTest::RotationVector : LaneTest::Always;
    lane.first.carrier = link.tool;
    lane.first.observer = link.reference;
    lane.first.carried = pathFrom(link.toolPath, {});
    lane.first.observed = pathFrom(link.referencePath, {});
    assignRows(own.reference_from_frame.transpose() * bodyFromLane(link.reference),
               lane.first.axes);
    assignRows(bodyFromLane(link.tool).transpose() * own.tool_from_frame * own.desired.transpose(),
               lane.turn);
    for (int i = 0; i < 3; ++i) limit(i, own.tolerance[i], lane);
    return lane;
  }

  LaneConstraint operator()(const Regions& own) const {
    LaneConstraint lane;
    lane.test = LaneTest::Regions;
    lane.first = vectorOf(own.point);
    for (const ConstraintRegion& region : own.regions) lane.regions.push_back(regionOf(region));
    return lane;
  }

 private:
  Matrix3d bodyFromLane(int body) const {
    return simd_.bodyFromLane[static_cast<std::size_t>(body)];
  }

  LaneVector vectorOf(const SeenVector& seen) const {
    const ConstrainedLink& link = task_.links[seen.link];
    const std::vector<int>& toCarrier = seen.fromTool ? link.toolPath : link.referencePath;
    const std::vector<int>& toObserver = seen.fromTool ? link.referencePath : link.toolPath;
    const std::span<const double> arms =
        seen.isDirection ? std::span(seen.directionArms) : std::span(seen.carrier.arms);
    LaneVector lane;
    lane.carrier = seen.fromTool ? link.tool : link.reference;
    lane.observer = seen.fromTool ? link.reference : link.tool;
    lane.isDirection = seen.isDirection;
    const Matrix3d observer = bodyFromLane(lane.observer);
    assign(bodyFromLane(lane.carrier).transpose() * seen.local, lane.local);
    assign(observer.transpose() * seen.observer_from_frame.translation(), lane.origin);
    assignRows(seen.observer_from_frame.linear().transpose() * observer, lane.axes);
    lane.carried = pathFrom(toCarrier, arms.subspan(link.first));
    lane.observed = seen.isDirection
                        ? pathFrom(toObserver, {})
                        : pathFrom(toObserver, std::span(seen.observer.arms).subspan(link.first));
    if (!seen.isDirection) lane.magnitude = seen.magnitude;
    return lane;
  }

  static void limit(int i, double angle, LaneConstraint& lane) {
    const double most = std::min(angle, kPi);
    lane.limited[i] = angle < kPi;
    lane.wide[i] = angle > 0.5 * kPi;
    lane.sine[i] = singleBelow(std::sin(most));
    lane.cosine[i] = singleAbove(std::cos(most));
    lane.tolerance[i] = singleBelow(most);
  }

  static LaneRegion regionOf(const ConstraintRegion& region) {
    LaneRegion lane;
    lane.type = region.type;
    const Isometry3d& frame = region.reference_from_region;
    assignRows(frame.linear().transpose(), lane.axes);
    assign(frame.translation(), lane.center);
    lane.rounding = singleAbove(obstacleRounding(0.0, frame.translation().norm()));
    const bool round = region.type != ConstraintRegion::Type::Box;
    for (int i = 0; i < 3; ++i)
      lane.size[i] = singleBelow((round && i == 0 ? 1.0 : 0.5) * region.size[i]);
    return lane;
  }

  const ConstraintModel& task_;
  const SimdModel& simd_;
};

}  // namespace

LaneConstraints compileLaneConstraints(const PairModel& model, const ConstraintModel& constraints,
                                       const SimdModel& simd) {
  LaneConstraints lanes;
  if (!simd.usable || !model.tube.empty() || !model.world->obstacles().empty()) return lanes;
  for (const CompiledConstraint& own : constraints.constraints)
    lanes.constraints.push_back(std::visit(LaneCompiler(constraints, simd), own.what));
  if (std::ranges::all_of(lanes.constraints,
                          [](const LaneConstraint& own) { return own.test == LaneTest::None; }))
    lanes.constraints.clear();
  return lanes;
}

}  // namespace swept::detail
