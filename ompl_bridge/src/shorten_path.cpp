// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/base/SpaceInformation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "constraint_steer.hpp"
#include "default_range.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/paths.hpp"

namespace swept {

namespace {

namespace ob = ompl::base;

class Shortening {
 public:
  explicit Shortening(ompl::geometric::PathGeometric& path)
      : path_(path),
        states_(path.getStates()),
        si_(path.getSpaceInformation().get()),
        steer_(detail::steerOf(*si_)) {
    for (ob::State*& state : cut_) state = si_->allocState();
    for (ob::State*& state : best_) state = si_->allocState();
  }
  ~Shortening() {
    for (ob::State* state : cut_) si_->freeState(state);
    for (ob::State* state : best_) si_->freeState(state);
  }
  Shortening(const Shortening&) = delete;
  Shortening& operator=(const Shortening&) = delete;

  void run(const ShorteningOptions& options) {
    joinFarthest();
    if (steer_ != nullptr) joinAlong(options.leastGain);
    if (states_.size() < 3) return;
    const ompl::geometric::PathGeometric joined(path_);
    asked_.assign(states_.size() - 1, true);
    const double leastGain = options.leastGain * path_.length();
    for (int round = 0; round < options.rounds && cutCorners(leastGain); ++round) {
    }
    // Part of a motion that is proven need not be proven by itself, right beside a contact.
    for (std::size_t i = 0; i < asked_.size(); ++i) {
      if (asked_[i] || si_->checkMotion(states_[i], states_[i + 1])) continue;
      path_ = joined;
      return;
    }
  }

 private:
  /// The states between two that are joined are left out.
  void joinFarthest() {
    for (std::size_t i = 0; i + 2 < states_.size(); ++i) {
      for (std::size_t j = states_.size() - 1; j > i + 1; --j) {
        if (!si_->checkMotion(states_[i], states_[j])) continue;
        const auto begin = states_.begin() + static_cast<std::ptrdiff_t>(i) + 1;
        const auto end = states_.begin() + static_cast<std::ptrdiff_t>(j);
        std::for_each(begin, end, [this](ob::State* state) { si_->freeState(state); });
        states_.erase(begin, end);
        break;
      }
    }
  }

  /// The same by several motions that keep the constraints, between states ever nearer to each
  /// other.
  void joinAlong(double leastGain) {
    const double range = detail::defaultRange(*si_);
    for (std::size_t apart = states_.size() - 1; apart > 1; apart /= 2)
      for (std::size_t i = 0; i + apart < states_.size(); ++i)
        replaceAlong(i, i + apart, range, leastGain);
  }

  void replaceAlong(std::size_t from, std::size_t to, double range, double leastGain) {
    double length = 0.0;
    for (std::size_t i = from; i < to; ++i) length += si_->distance(states_[i], states_[i + 1]);
    const double longest = (1.0 - leastGain) * length;
    if (si_->distance(states_[from], states_[to]) > longest) return;
    std::vector<ob::State*> way;
    bool valid = steer_->between(states_[from], states_[to], range, longest, way);
    const ob::State* last = states_[from];
    for (std::size_t i = 0; valid && i <= way.size(); ++i) {
      const ob::State* const next = i < way.size() ? way[i] : states_[to];
      valid = si_->checkMotion(last, next);
      last = next;
    }
    if (valid) {
      const auto begin = states_.begin() + static_cast<std::ptrdiff_t>(from) + 1;
      const auto end = states_.begin() + static_cast<std::ptrdiff_t>(to);
      std::vector<ob::State*> before(begin, end);
      states_.insert(states_.erase(begin, end), way.begin(), way.end());
      way = std::move(before);
    }
    for (ob::State* state : way) si_->freeState(state);
  }

  /// False: none was.
  bool cutCorners(double leastGain) {
    bool any = false;
    for (std::size_t i = 1; i + 1 < states_.size(); ++i) {
      if (!cut(i, leastGain)) continue;
      any = true;
      ++i;  // two corners
    }
    return any;
  }

  bool cut(std::size_t corner, double leastGain) {
    constexpr int kTries = 2;
    constexpr double kMost = 1.0 - 1.0 / (1 << kTries);
    const double before = si_->distance(states_[corner - 1], states_[corner]);
    const double after = si_->distance(states_[corner], states_[corner + 1]);
    const double shorter = std::min(before, after);
    if (!(shorter > 0.0)) return false;
    const auto gainOf = [&](double share) {
      const ob::StateSpace& space = *si_->getStateSpace();
      space.interpolate(states_[corner], states_[corner - 1], share * shorter / before, cut_[0]);
      space.interpolate(states_[corner], states_[corner + 1], share * shorter / after, cut_[1]);
      return 2.0 * share * shorter - si_->distance(cut_[0], cut_[1]);
    };
    if (!(gainOf(kMost) > leastGain)) return false;
    double free = 0.0, refused = 1.0, gain = 0.0;
    for (int i = 0; i < kTries; ++i) {
      const double share = 0.5 * (free + refused);
      const double own = gainOf(share);
      if (si_->checkMotion(cut_[0], cut_[1])) {
        gain = own;
        free = share;
        std::swap(cut_, best_);
      } else {
        refused = share;
      }
    }
    if (!(gain > leastGain)) return false;
    const auto at = static_cast<std::ptrdiff_t>(corner);
    si_->copyState(states_[corner], best_[0]);
    states_.insert(states_.begin() + at + 1, si_->cloneState(best_[1]));
    asked_[corner - 1] = asked_[corner] = false;
    asked_.insert(asked_.begin() + at, true);
    return true;
  }

  ompl::geometric::PathGeometric& path_;
  std::vector<ob::State*>& states_;
  const ob::SpaceInformation* si_;
  std::unique_ptr<detail::ConstraintSteer> steer_;  ///< null: there are no constraints
  std::vector<bool> asked_;                         ///< whether each motion of the path has been
  std::array<ob::State*, 2> cut_, best_;            ///< the ends of a cut
};

}  // namespace

void shortenPath(ompl::geometric::PathGeometric& path, const ShorteningOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { shortenPath(path, options); });
  }
  Shortening(path).run(options);
}

}  // namespace swept
