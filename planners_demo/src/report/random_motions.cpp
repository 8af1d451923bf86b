// SPDX-License-Identifier: BSD-3-Clause
#include "report/random_motions.hpp"

#include <ompl/base/ScopedState.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>

#include "command_line/exit_code.hpp"
#include "swept/ompl_bridge/state_space.hpp"

namespace swept {
namespace {

namespace ob = ompl::base;

constexpr int kAttempts = 100'000;       // for one free state
constexpr double kShortestShare = 0.02;  // of the space's maximum extent

}  // namespace

struct RandomMotions::Space {
  explicit Space(const Checker& checker)
      : space(makeStateSpace(checker.robot(), checker.group())),
        conversion(checker.robot(), checker.group()),
        from(space),
        to(space) {
    space->setup();
    sampler = space->allocStateSampler();
  }

  std::vector<double> configuration(const ob::ScopedState<>& state) const {
    std::vector<double> q(static_cast<std::size_t>(conversion.dimension()));
    conversion.toConfiguration(state.get(), q);
    return q;
  }

  ob::StateSpacePtr space;
  StateConversion conversion;
  ob::ScopedState<> from, to;
  ob::StateSamplerPtr sampler;
  ompl::RNG random;
};

RandomMotions::RandomMotions(const ReportWorld& world, const Checker& checker)
    : world_(world),
      checker_(checker),
      workspace_(checker),
      space_(std::make_unique<Space>(checker)) {}

RandomMotions::~RandomMotions() = default;

bool RandomMotions::isFree(const std::vector<double>& q) {
  return checker_.checkState(q, workspace_) == Verdict::Free;
}

std::vector<double> RandomMotions::state() {
  space_->sampler->sampleUniform(space_->to.get());
  return space_->configuration(space_->to);
}

std::vector<double> RandomMotions::freeState() {
  for (int i = 0; i < kAttempts; ++i)
    if (std::vector<double> q = state(); isFree(q)) return q;
  throw UsageError(world_.name + ": of " + std::to_string(kAttempts) +
                   " random states none is proven free");
}

ReportMotion RandomMotions::next() {
  ReportMotion motion;
  motion.from = freeState();
  space_->conversion.toState(motion.from, space_->from.get());
  ob::StateSpace& space = *space_->space;
  for (int i = 0; i < kAttempts; ++i) {
    space_->sampler->sampleUniform(space_->to.get());
    const double wanted = space.getMaximumExtent() *
                          std::exp(space_->random.uniformReal(std::log(kShortestShare), 0));
    const double whole = space.distance(space_->from.get(), space_->to.get());
    if (wanted < whole)
      space.interpolate(space_->from.get(), space_->to.get(), wanted / whole, space_->to.get());
    motion.to = space_->configuration(space_->to);
    motion.length = std::min(wanted, whole);
    if (motion.length > 0.0 && isFree(motion.to)) return motion;
  }
  throw UsageError(world_.name + ": of " + std::to_string(kAttempts) +
                   " random motions none ends in a state that is proven free");
}

}  // namespace swept
