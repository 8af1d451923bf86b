// SPDX-License-Identifier: BSD-3-Clause
#include "acm/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace swept::detail {

namespace {

/// Start of a descent.
constexpr std::size_t kStarts = 6;

/// Steps begin with this share of a variable's range ...
constexpr double kFirstStep = 1.0 / 16.0;
/// ... are halved where none leads downhill, and end here.
constexpr double kLastStep = 1e-5;
constexpr int kMostSteps = 400;

/// In [0, 1): the same on every machine, unlike std::uniform_real_distribution.
double unit(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

template <typename Judge>
std::optional<std::vector<double>> firstSample(const JointBox& box, int samples, std::uint64_t seed,
                                               const Judge& judge) {
  std::mt19937_64 random(seed);
  std::vector<double> values(box.lower.size());
  for (int i = 0; i < samples; ++i) {
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = box.lower[k] + unit(random) * (box.upper[k] - box.lower[k]);
    if (judge(values)) return values;
  }
  return std::nullopt;
}

}  // namespace

bool ContactSearch::canSample() const {
  for (std::size_t k = 0; k < chain_.variables().size(); ++k)
    if (!std::isfinite(chain_.limits().upper[k] - chain_.limits().lower[k])) return false;
  return !chain_.variables().empty();
}

double ContactSearch::distanceAt(const Values& values, double enough) {
  if (!chain_.moveTo(values, place_)) return std::numeric_limits<double>::infinity();
  const LinkDistance found = linkDistance(a_, b_, place_, enough, margin_);
  least_ = std::min(least_, found.upper);
  // Without two points to show, a bound is not a contact.
  const bool known = std::isfinite(found.upper) || !(found.lower > margin_);
  return known ? found.upper : found.lower;
}

bool ContactSearch::isContact(const Values& values) {
  return distanceAt(values, margin_) <= margin_;
}

void ContactSearch::keepNearest(double distance, const Values& values) {
  const auto place = std::ranges::upper_bound(nearest_, distance, {}, &Candidate::distance);
  nearest_.insert(place, {distance, values});
  if (nearest_.size() > kStarts) nearest_.pop_back();
}

std::optional<ContactSearch::Values> ContactSearch::findContact(int samples, std::uint64_t seed) {
  if (!canSample()) return std::nullopt;
  return firstSample(chain_.limits(), samples, seed, [&](const Values& values) {
    const bool full = nearest_.size() == kStarts;
    const double enough = full ? nearest_.back().distance : std::numeric_limits<double>::infinity();
    const double distance = distanceAt(values, enough);
    if (distance <= margin_) return true;
    if (!full || distance < enough) keepNearest(distance, values);
    return false;
  });
}

std::optional<ContactSearch::Values> ContactSearch::findApart(int samples, std::uint64_t seed) {
  if (!canSample()) return std::nullopt;
  return firstSample(chain_.limits(), samples, seed,
                     [&](const Values& values) { return !isContact(values); });
}

/// One variable at a time, the better of two steps.
ContactSearch::Candidate ContactSearch::descendFrom(Candidate at) {
  const JointBox& limits = chain_.limits();
  double step = kFirstStep;
  for (int steps = 0; step > kLastStep && steps < kMostSteps;) {
    bool moved = false;
    for (std::size_t k = 0; k < at.values.size() && at.distance > margin_; ++k) {
      for (const double sign : {1.0, -1.0}) {
        Values next = at.values;
        const double size = sign * step * (limits.upper[k] - limits.lower[k]);
        next[k] = std::clamp(next[k] + size, limits.lower[k], limits.upper[k]);
        const double distance = distanceAt(next, at.distance);
        ++steps;
        if (!(distance < at.distance)) continue;
        at = {distance, std::move(next)};
        moved = true;
        break;
      }
    }
    if (at.distance <= margin_) break;
    if (!moved) step *= 0.5;
  }
  return at;
}

std::optional<ContactSearch::Values> ContactSearch::descend(const Values& start) {
  if (!canSample()) return std::nullopt;
  std::vector<Candidate> starts = nearest_;
  if (start.size() == chain_.variables().size()) {
    Values values = start;
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = std::clamp(values[k], chain_.limits().lower[k], chain_.limits().upper[k]);
    const double distance = distanceAt(values, std::numeric_limits<double>::infinity());
    starts.insert(starts.begin(), {distance, std::move(values)});
  }
  for (Candidate& candidate : starts) {
    candidate = descendFrom(std::move(candidate));
    if (candidate.distance <= margin_ && isContact(candidate.values)) return candidate.values;
  }
  return std::nullopt;
}

}  // namespace swept::detail
