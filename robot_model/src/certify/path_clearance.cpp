// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/path_clearance.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "certify/motion_check.hpp"
#include "certify/workspace_data.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Adds the bounds of a motion.
void addSegment(const ClearanceInterval& own, std::size_t segment, PathClearanceInterval& all) {
  const double lower = std::min(all.lower, own.lower);
  if (own.upper < all.upper) {
    static_cast<ClearanceInterval&>(all) = own;
    all.segment = segment;
  }
  all.lower = lower;
}

/// Which of the three intervals of a clearance are asked for themselves.
struct Wanted {
  explicit Wanted(ClearanceQuery query)
      : whole(query == ClearanceQuery::Least),
        world(query == ClearanceQuery::ByKind || query == ClearanceQuery::World),
        self(query == ClearanceQuery::ByKind || query == ClearanceQuery::Self) {}
  bool whole, world, self;
};

/// Nothing is nearer than a contact.
bool isDone(const Wanted& wanted, const PathClearance& all) {
  return (!wanted.whole || all.upper == 0.0) && (!wanted.world || all.world.upper == 0.0) &&
         (!wanted.self || all.self.upper == 0.0);
}

/// The least over the kinds that are wanted.
void addKinds(const Wanted& wanted, PathClearance& all) {
  PathClearanceInterval& whole = all;
  all.selfPair = wanted.self && all.self.upper < all.world.upper;
  whole = all.selfPair || !wanted.world ? all.self : all.world;
  if (wanted.world && wanted.self) all.lower = std::min(all.self.lower, all.world.lower);
}

}  // namespace

PathClearance pathClearance(const Checker& checker, const ConfigurationList& states,
                            double accuracy, Workspace& workspace, ClearanceQuery query) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, accuracy, query] {
      return pathClearance(checker, states, accuracy, workspace, query);
    });
  }
  if (states.empty()) throw std::invalid_argument("pathClearance: a path has at least one state");
  for (const ConfigurationView& state : states) checker.requireSize(state);
  if (!(accuracy > 0.0)) {
    throw std::invalid_argument("pathClearance: accuracy " + detail::formatNumber(accuracy) +
                                " m must be greater than zero");
  }
  const Wanted wanted(query);
  PathClearance all;
  if (wanted.whole) all.lower = kInfinity;
  if (wanted.world) all.world.lower = kInfinity;
  if (wanted.self) all.self.lower = kInfinity;
  const std::size_t segments = std::max<std::size_t>(1, states.size() - 1);
  for (std::size_t i = 0; i < segments && !isDone(wanted, all); ++i) {
    const detail::OtherClearances others{wanted.whole ? all.upper : all.world.upper,
                                         all.self.upper};
    const detail::StraightPath path(checker.model_->kinematics, states[i],
                                    states[std::min(i + 1, states.size() - 1)]);
    const MotionClearance own = detail::motionClearance(*checker.model_, path, accuracy, query,
                                                        checker.dataOf(workspace), others);
    all.intervals += own.intervals;
    if (wanted.whole && own.upper < all.upper) all.selfPair = own.selfPair;
    if (wanted.whole) addSegment(own, i, all);
    if (wanted.world) addSegment(own.world, i, all.world);
    if (wanted.self) addSegment(own.self, i, all.self);
  }
  if (!wanted.whole) addKinds(wanted, all);
  return all;
}

}  // namespace swept
