// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/corner_speeds.hpp"

#include <algorithm>

namespace swept::detail {

namespace {

/// Speeds that must fit each other may miss it by their rounding; the slack of the limits is
/// larger.
constexpr double kRounded = 1.0 + 1e-12;

}  // namespace

CornerWindow windowOf(const CornerSpeeds& speeds, std::size_t corner) {
  return {std::max<std::size_t>(corner, 2) - 1, std::min(corner + 1, speeds.parts() - 1)};
}

CornerSpeeds::CornerSpeeds(const WayPointPath& path, double leastStep)
    : path_(&path),
      leastStep_(leastStep),
      blends_(path.parts() + 1),
      caps_(path.parts() + 1),
      rates_(path.parts() + 1),
      trial_(path.parts() + 1),
      known_(path.parts()) {
  for (std::size_t corner = 1; corner < path.parts(); ++corner) shapes_.emplace_back(path, corner);
}

double CornerSpeeds::capOf(std::size_t corner) const {
  const CornerBlend& blend = blends_[corner];
  return blend.stops() ? 0.0 : 1.0 / std::max(leastStep_, shape(corner).leastTime(blend));
}

void CornerSpeeds::set(std::size_t corner, const CornerBlend& blend) {
  blends_[corner] = blend;
  caps_[corner] = capOf(corner);
}

void CornerSpeeds::solve() {
  if (parts() > 1) solve(1, parts() - 1, rates_);
}

/// False if the rates of the corners beside do not allow any.
bool CornerSpeeds::solve(std::size_t first, std::size_t last, std::vector<double>& rates) const {
  // The speed at one end of a part, if the other end's allows it, or else the largest that does.
  const auto allowed = [&](std::size_t part, double wanted, double other) {
    const double length = straightLength(part);
    const StraightLimits& limits = path_->straight[part];
    if (reachableWithRoom(other, wanted, length, limits, leastStep_)) return wanted;
    return std::min(wanted, reachableInSteps(other, length, limits, leastStep_));
  };
  for (std::size_t i = last; i >= first; --i) {
    rates[i] = caps_[i];
    const double out = speedOut(i, rates);
    const double most = allowed(i, out, speedIn(i, rates));
    if (out > most) rates[i] = most / (2.0 * blends_[i].after);
  }
  const double out = speedOut(first - 1, rates);
  if (out > allowed(first - 1, out, speedIn(first - 1, rates)) * kRounded) return false;
  for (std::size_t i = first; i <= last; ++i) {
    const double in = speedIn(i - 1, rates);
    const double most = allowed(i - 1, in, speedOut(i - 1, rates));
    if (in > most) rates[i] = most / (2.0 * blends_[i].before);
  }
  const double in = speedIn(last, rates);
  return in <= allowed(last, in, speedOut(last, rates)) * kRounded;
}

double CornerSpeeds::duration(std::size_t first, std::size_t last, const std::vector<double>& rates,
                              double most) {
  double sum = 0.0;
  for (std::size_t i = first; i <= last; ++i)
    if (rates[i] > 0.0) sum += 1.0 / rates[i];
  for (std::size_t part = first - 1; part <= last && sum < most; ++part)
    sum += partDuration(part, rates);
  return sum;
}

double CornerSpeeds::partDuration(std::size_t part, const std::vector<double>& rates) {
  const double from = speedOut(part, rates);
  const double to = speedIn(part, rates);
  const double length = straightLength(part);
  KnownDuration& known = known_[part];
  if (from != known.from || to != known.to || length != known.length)
    known = {from, to, length, fastestProfile(from, to, length, path_->straight[part]).duration()};
  return known.seconds;
}

bool CornerSpeeds::improve(std::size_t corner, const CornerBlend& blend, double& most) {
  const CornerWindow window = windowOf(*this, corner);
  const CornerBlend before = blends_[corner];
  const double cap = caps_[corner];
  set(corner, blend);
  trial_[window.first - 1] = rates_[window.first - 1];
  trial_[window.last + 1] = rates_[window.last + 1];
  if (solve(window.first, window.last, trial_)) {
    const double time = duration(window.first, window.last, trial_, most);
    if (time < most) {
      most = time;
      std::copy(trial_.begin() + static_cast<std::ptrdiff_t>(window.first),
                trial_.begin() + static_cast<std::ptrdiff_t>(window.last) + 1,
                rates_.begin() + static_cast<std::ptrdiff_t>(window.first));
      return true;
    }
  }
  blends_[corner] = before;
  caps_[corner] = cap;
  return false;
}

}  // namespace swept::detail
