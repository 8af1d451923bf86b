// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "trajectory/corner_blend.hpp"
#include "trajectory/way_point_path.hpp"

namespace swept::detail {

/// The speeds at which a path passes its corners. A corner's *rate* (1/s) is one over the time of
/// its blend; 0: the robot stops. Corner i is at the begin of the straight part i, so the first and
/// the last point of the path are corners too, at which the robot stops.
///
/// Lemma: the time of the path falls with each rate. What limits the rates is a cap for each of
/// them, and that a straight part must allow the change between the speeds at its ends. So the
/// largest rates are optimal, and a pass backwards over the braking and then one forwards over the
/// accelerating finds them (Pham and Pham 2018). With ramps the second pass can only lower speeds
/// from which the robot brakes, which needs less length then: the result keeps all limits.
class CornerSpeeds {
 public:
  /// Of a path that stops at each corner. `leastStep`: s, between two points of the trajectory.
  /// Refers to the path.
  CornerSpeeds(const WayPointPath& path, double leastStep);

  /// Number of straight parts, and of corners without the first one.
  std::size_t parts() const { return path_->parts(); }
  /// Of an inner corner: from 1 to parts() - 1.
  const CornerShape& shape(std::size_t corner) const { return shapes_[corner - 1]; }
  const CornerBlend& blend(std::size_t corner) const { return blends_[corner]; }
  double rate(std::size_t corner) const { return rates_[corner]; }  ///< 1/s
  double leastStep() const { return leastStep_; }                   ///< s, between two points
  /// rad or m, of what the blends leave of a straight part.
  double straightLength(std::size_t part) const {
    return path_->lengths[part] - blends_[part].after - blends_[part + 1].before;
  }
  /// s, from the begin of the blend at `first` to the end of that at `last`, and of the straight
  /// parts beside them.
  double duration(std::size_t first, std::size_t last) {
    return duration(first, last, rates_, std::numeric_limits<double>::infinity());
  }

  /// Replaces the blend at an inner corner. The rates are right after the next solve().
  void set(std::size_t corner, const CornerBlend& blend);
  /// Finds the largest rates.
  void solve();
  /// Replaces the blend at an inner corner if that lowers the duration of its neighbourhood to less
  /// than `most` (s), where the corner and its neighbours may change their rates. The rates still
  /// keep all limits, but may not be the largest.
  bool improve(std::size_t corner, const CornerBlend& blend, double& most);

 private:
  double speedOut(std::size_t part, const std::vector<double>& rates) const {
    return 2.0 * blends_[part].after * rates[part];
  }
  double speedIn(std::size_t part, const std::vector<double>& rates) const {
    return 2.0 * blends_[part + 1].before * rates[part + 1];
  }
  double capOf(std::size_t corner) const;
  bool solve(std::size_t first, std::size_t last, std::vector<double>& rates) const;
  /// `most` (s): a duration that is no less need not be the whole.
  double duration(std::size_t first, std::size_t last, const std::vector<double>& rates,
                  double most);
  double partDuration(std::size_t part, const std::vector<double>& rates);

  /// The fastest way along a straight part that was asked for last.
  struct KnownDuration {
    double from = -1.0, to = -1.0;  ///< rad/s or m/s
    double length = 0.0;            ///< rad or m
    double seconds = 0.0;
  };

  const WayPointPath* path_;
  double leastStep_;
  std::vector<CornerShape> shapes_;  ///< of the inner corners
  std::vector<CornerBlend> blends_;  ///< of all corners, as the following
  std::vector<double> caps_;
  std::vector<double> rates_;
  std::vector<double> trial_;
  std::vector<KnownDuration> known_;  ///< of each straight part
};

/// The neighbourhood of a corner: the first and the last inner corner beside it, or itself.
struct CornerWindow {
  std::size_t first;
  std::size_t last;
};
CornerWindow windowOf(const CornerSpeeds& speeds, std::size_t corner);

}  // namespace swept::detail
