// SPDX-License-Identifier: BSD-3-Clause
#include "constraint_steer.hpp"

#include <algorithm>
#include <cmath>

#include "space_bounds.hpp"
#include "used_checker.hpp"

namespace swept::detail {

namespace {

namespace ob = ompl::base;

/// Of the tolerances: where projected states are. The rest is for the motions between them, which
/// leave the manifold in the middle by the square of their length.
constexpr double kProjectionShare = 0.5;
/// Of the tolerances: what a motion may use at its samples. The proof needs the rest.
constexpr double kMostUsed = 0.98;
/// How often a step is halved until the straight motion keeps the constraints.
constexpr int kHalvings = 5;
/// A step comes nearer by this share of its length, at least.
constexpr double kLeastProgress = 0.1;
/// A projection moves a state no farther than so many steps.
constexpr double kMostDetour = 2.0;

ConstraintProjection projectionIn(const ob::StateSpace& space, const Checker& checker) {
  const SpaceBounds bounds = boundsOf(space, checker);
  return ConstraintProjection(checker).within(bounds.lower, bounds.upper);
}

}  // namespace

ConstraintSteer::ConstraintSteer(const ob::StateSpacePtr& space, const Checker& checker)
    : space_(space),
      conversion_(checker.robot(), checker.group()),
      projection_(projectionIn(*space, checker)),
      workspace_(projection_),
      q_(static_cast<std::size_t>(conversion_.dimension())),
      middle_(space->allocState()) {}

ConstraintSteer::~ConstraintSteer() {
  space_->freeState(middle_);
}

bool ConstraintSteer::project(ob::State* state) {
  conversion_.toConfiguration(state, q_);
  if (!projection_.project(q_, {.share = kProjectionShare}, workspace_)) return false;
  conversion_.toState(q_, state);
  return true;
}

/// Samples: the ends are known to keep them.
bool ConstraintSteer::keeps(const ob::State* from, const ob::State* to) {
  for (const double t : {0.5, 0.25, 0.75}) {
    space_->interpolate(from, to, t, middle_);
    conversion_.toConfiguration(middle_, q_);
    if (!(projection_.usedShare(q_, workspace_) <= kMostUsed)) return false;
  }
  return true;
}

bool ConstraintSteer::step(const ob::State* from, const ob::State* to, double range,
                           ob::State* reached) {
  const double distance = space_->distance(from, to);
  double length = std::min(range, distance);
  for (int i = 0; i <= kHalvings; ++i, length *= 0.5) {
    if (length < distance) {
      space_->interpolate(from, to, length / distance, reached);
      if (!project(reached)) continue;
      if (space_->distance(from, reached) > kMostDetour * length) continue;
      if (space_->distance(reached, to) > distance - kLeastProgress * length) return false;
    } else {
      space_->copyState(reached, to);
    }
    if (keeps(from, reached)) return true;
  }
  return false;
}

bool ConstraintSteer::between(const ob::State* from, const ob::State* to, double range,
                              double longest, std::vector<ob::State*>& states) {
  const ob::State* last = from;
  double length = 0.0;
  for (;;) {
    ob::State* const next = space_->allocState();
    states.push_back(next);
    if (!step(last, to, range, next)) return false;
    length += space_->distance(last, next);
    if (length > longest) return false;
    if (space_->equalStates(next, to)) {
      space_->freeState(next);
      states.pop_back();
      return true;
    }
    last = next;
  }
}

std::unique_ptr<ConstraintSteer> steerOf(const ob::SpaceInformation& si) {
  const std::shared_ptr<const Checker> checker = checkerOf(si);
  if (checker == nullptr || checker->options().constraints.empty()) return nullptr;
  return std::make_unique<ConstraintSteer>(si.getStateSpace(), *checker);
}

}  // namespace swept::detail
