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
      trial_(path.parts() + 1) {
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
  const auto reachable = [&](std::size_t part, double speed) {
    return reachableInSteps(speed, straightLength(part), path_->straight[part], leastStep_);
  };
  for (std::size_t i = last; i >= first; --i) {
    rates[i] = caps_[i];
    const double most = reachable(i, speedIn(i, rates));
    if (speedOut(i, rates) > most) rates[i] = most / (2.0 * blends_[i].after);
  }
  if (speedOut(first - 1, rates) > reachable(first - 1, speedIn(first - 1, rates)) * kRounded)
    return false;
  for (std::size_t i = first; i <= last; ++i) {
    const double most = reachable(i - 1, speedOut(i - 1, rates));
    if (speedIn(i - 1, rates) > most) rates[i] = most / (2.0 * blends_[i].before);
  }
  return speedIn(last, rates) <= reachable(last, speedOut(last, rates)) * kRounded;
}

double CornerSpeeds::duration(std::size_t first, std::size_t last, const std::vector<double>& rates,
                              double most) const {
  double sum = 0.0;
  for (std::size_t i = first; i <= last; ++i)
    if (rates[i] > 0.0) sum += 1.0 / rates[i];
  for (std::size_t part = first - 1; part <= last && sum < most; ++part)
    sum += fastestProfile(speedOut(part, rates), speedIn(part, rates), straightLength(part),
                          path_->straight[part])
               .duration();
  return sum;
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
