// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/path_clearance.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "certify/checker_model.hpp"
#include "certify/motion_check.hpp"
#include "io/numbers.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Takes over what is known of a motion.
void addSegment(const ClearanceInterval& own, std::size_t segment, PathClearanceInterval& all) {
  const double lower = std::min(all.lower, own.lower);
  if (own.upper < all.upper) {
    static_cast<ClearanceInterval&>(all) = own;
    all.segment = segment;
  }
  all.lower = lower;
}

/// Of all pairs, from what is known of the two kinds.
void addKinds(PathClearance& all) {
  all.selfPair = all.self.upper < all.world.upper;
  const double lower = std::min(all.self.lower, all.world.lower);
  static_cast<PathClearanceInterval&>(all) = all.selfPair ? all.self : all.world;
  all.lower = lower;
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
  const bool byKind = query == ClearanceQuery::ByKind;
  PathClearance all;
  if (byKind)
    all.world.lower = all.self.lower = kInfinity;
  else
    all.lower = kInfinity;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, states.size() - 1); ++i) {
    const MotionClearance own = detail::motionClearance(
        *checker.model_, states[i], states[std::min(i + 1, states.size() - 1)], accuracy, query,
        checker.dataOf(workspace), {byKind ? all.world.upper : all.upper, all.self.upper});
    all.intervals += own.intervals;
    if (byKind) {
      addSegment(own.world, i, all.world);
      addSegment(own.self, i, all.self);
    } else {
      if (own.upper < all.upper) all.selfPair = own.selfPair;
      addSegment(own, i, all);
    }
    // Nothing is nearer than a contact.
    if (byKind ? all.world.upper == 0.0 && all.self.upper == 0.0 : all.upper == 0.0) break;
  }
  if (byKind) addKinds(all);
  return all;
}

}  // namespace swept
