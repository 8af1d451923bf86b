// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/blend_search.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace swept::detail {

namespace {

/// Share of a straight part that blends may take. The rest lets speeds change, and times be whole
/// nanoseconds.
constexpr double kForBlends = 63.0 / 64.0;

/// A pattern search (R. Hooke and T. Jeeves, 1961) over the lengths of all blends. The time is not
/// smooth: a blend that may grow is stopped by the deviation, or by its neighbour.
class BlendLengths {
 public:
  BlendLengths(const WayPointPath& path, double deviation, CornerSpeeds& speeds)
      : path_(path), deviation_(deviation), speeds_(speeds) {}

  void search() {
    constexpr double kFirstStep = 0.3, kLastStep = 0.01;
    constexpr int kRounds = 100;
    begin();
    double step = kFirstStep;
    for (int round = 0; round < kRounds && step >= kLastStep; ++round) {
      if (!improveAll(step)) step *= 0.5;
      speeds_.solve();
    }
  }

 private:
  /// Blends of equal lengths, as long as needed for the speeds that the corners might have if the
  /// straight parts were not shortened by blends.
  void begin() {
    std::vector<double> speeds(speeds_.parts() + 1);
    for (std::size_t corner = 1; corner < speeds_.parts(); ++corner) {
      const CornerShape& shape = speeds_.shape(corner);
      if (shape.mustStop()) continue;
      const double fastest =
          std::min(path_.straight[corner - 1].speed, path_.straight[corner].speed);
      const CornerBlend blend = equalBlend(corner, fastest);
      speeds_.set(corner, blend);
      speeds[corner] = 2.0 * blend.before / shape.leastTime(blend);
    }
    const auto slowDown = [&](std::size_t corner, std::size_t neighbour, std::size_t part) {
      speeds[corner] =
          std::min(speeds[corner],
                   reachableSpeed(speeds[neighbour], path_.lengths[part], path_.straight[part]));
    };
    for (std::size_t i = speeds_.parts() - 1; i >= 1; --i) slowDown(i, i + 1, i);
    for (std::size_t i = 1; i < speeds_.parts(); ++i) slowDown(i, i - 1, i - 1);
    for (std::size_t corner = 1; corner < speeds_.parts(); ++corner)
      if (!speeds_.blend(corner).stops()) speeds_.set(corner, equalBlend(corner, speeds[corner]));
    speeds_.solve();
  }

  /// As long as needed for a speed, but at most half of each straight part.
  CornerBlend equalBlend(std::size_t corner, double speed) const {
    const double needed =
        std::max(speeds_.shape(corner).lengthFor(speed), 0.5 * speed * speeds_.leastStep());
    const double half =
        0.5 * kForBlends * std::min(path_.lengths[corner - 1], path_.lengths[corner]);
    const double length = std::min(needed, half);
    return withinDeviation(corner, {length, length});
  }

  bool improveAll(double step) {
    bool improved = false;
    for (std::size_t corner = 1; corner < speeds_.parts(); ++corner)
      if (!speeds_.blend(corner).stops() && improve(corner, step)) improved = true;
    return improved;
  }

  bool improve(std::size_t corner, double step) {
    constexpr double kNoise = 1.0 - 1e-5;  // gains below are not worth a round
    const double longer = 1.0 + step;
    const double shorter = 1.0 / longer;
    const std::array<CornerBlend, 6> factors{{{longer, longer},
                                              {shorter, shorter},
                                              {longer, 1.0},
                                              {shorter, 1.0},
                                              {1.0, longer},
                                              {1.0, shorter}}};
    const CornerWindow window = windowOf(speeds_, corner);
    double time = kNoise * speeds_.duration(window.first, window.last);
    bool improved = false;
    for (const CornerBlend& factor : factors) {
      const CornerBlend now = speeds_.blend(corner);
      const CornerBlend next =
          fitted(corner, {now.before * factor.before, now.after * factor.after});
      if (next.before == now.before && next.after == now.after) continue;
      if (!speeds_.improve(corner, next, time)) continue;
      time *= kNoise;
      improved = true;
    }
    return improved;
  }

  /// Both lengths are made smaller by the same factor.
  CornerBlend withinDeviation(std::size_t corner, const CornerBlend& blend) const {
    constexpr double kInward = 1.0 - 1e-14;
    const double deviation = speeds_.shape(corner).deviation(blend);
    if (deviation <= deviation_) return blend;
    const double factor = kInward * deviation_ / deviation;
    return {factor * blend.before, factor * blend.after};
  }

  CornerBlend fitted(std::size_t corner, const CornerBlend& wanted) const {
    const CornerBlend blend = withinDeviation(corner, wanted);
    const double before = kForBlends * path_.lengths[corner - 1] - speeds_.blend(corner - 1).after;
    const double after = kForBlends * path_.lengths[corner] - speeds_.blend(corner + 1).before;
    return {std::min(blend.before, before), std::min(blend.after, after)};
  }

  const WayPointPath& path_;
  double deviation_;
  CornerSpeeds& speeds_;
};

/// The factor of the largest blend that is accepted, or 0.
double provenShare(const BlendProver& proves, std::size_t wayPoint, const CornerShape& shape,
                   const CornerBlend& blend) {
  constexpr int kHalvings = 6, kRefinements = 3;
  const auto accepts = [&](double share) {
    return proves(
        wayPoint,
        PiecewisePolynomial(
            {0.0, 1.0}, std::vector<Eigen::MatrixXd>(
                            1, shape.coefficients({share * blend.before, share * blend.after}))));
  };
  double refused = 0.0;
  double accepted = 1.0;
  int halvings = 0;
  while (!accepts(accepted)) {
    if (++halvings > kHalvings) return 0.0;
    refused = accepted;
    accepted *= 0.5;
  }
  for (int i = 0; refused > 0.0 && i < kRefinements; ++i) {
    const double middle = 0.5 * (accepted + refused);
    (accepts(middle) ? accepted : refused) = middle;
  }
  return accepted;
}

}  // namespace

void chooseBlends(const WayPointPath& path, double deviation, CornerSpeeds& speeds) {
  if (deviation > 0.0) BlendLengths(path, deviation, speeds).search();
}

void proveBlends(const BlendProver& proves, std::span<const std::size_t> wayPoints,
                 CornerSpeeds& speeds) {
  for (std::size_t corner = 1; corner < speeds.parts(); ++corner) {
    const CornerBlend blend = speeds.blend(corner);
    if (blend.stops()) continue;
    const double share = provenShare(proves, wayPoints[corner], speeds.shape(corner), blend);
    speeds.set(corner, {share * blend.before, share * blend.after});
  }
  speeds.solve();
}

}  // namespace swept::detail
