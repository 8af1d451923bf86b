// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "point_cloud/line_cell.hpp"

namespace swept::detail {

/// Standard deviations of the noise: no look of an EventIntegral is farther from the mean.
inline constexpr double kFarthestLook = 32.0;

/// m. Error of positions and distances, besides their rounding, if squares of small numbers
/// underflow: far above the root of the least double.
inline constexpr double kPositionUnderflow = 1e-140;

/// Whether the square of a spread (m) keeps its digits. If not, only far and deep positions can be
/// distinguished.
inline bool hasDigits(double spread) {
  return spread > 1e-140 && spread < 1e140;
}

/// A probability: proven bounds and an estimate.
struct ProbabilityRange {
  double lower = 0.0;
  double upper = 1.0;
  double estimate = 0.5;

  double gap() const { return upper - lower; }
};

/// The probability that an event occurs at a position with Gaussian noise: bounds that are refined
/// step by step.
///
/// Positions have coordinates in which the noise is standard normal. The last of them is along the
/// transformed normal of the event's boundary, so that most lines along it cross the boundary
/// steeply. Certificates bound rectangles of such lines, the one with the widest bounds first
/// (best-first cubature).
class EventIntegral {
 public:
  struct Noise {
    Eigen::Vector3d mean;    ///< m
    Eigen::Matrix3d factor;  ///< m, F F^T is the covariance; not zero
    double spread;           ///< m, the largest standard deviation, rounded up
    double rounding;         ///< m, of positions, and of the frame that `look` speaks of
    bool isConvex;           ///< the positions for which the event occurs are a convex set
  };
  /// Performs one look, at the mean.
  EventIntegral(const Noise& noise, LookAt look);

  /// One step. False if no step could improve the bounds.
  bool refine();

  const ProbabilityRange& range() const { return range_; }
  int looks() const { return looks_; }

 private:
  Finding lookAt(const Eigen::Vector3d& position, LineCell* cell);
  void boundByFirst(const Finding& first);
  void makeFrame();
  void makeCells();
  void lookAlong(LineCell& cell);
  Eigen::Vector3d approach(LineCell& cell, const Interval& gap, Finding& finding);
  void lookBesides(LineCell& cell, const Eigen::Vector3d& position, const Finding& finding,
                   double within);
  double width(const LineCell& cell, int axis) const;
  std::array<LineCell, 2> halves(const LineCell& cell, std::size_t axis) const;
  void split(const LineCell& cell);
  void push(LineCell cell);
  LineCell pop();
  void updateRange();

  Noise noise_;
  LookAt look_;
  NoiseFrame frame_;
  ProbabilityRange first_;  ///< by the first look
  ProbabilityRange range_;
  std::vector<Certificate> common_;  ///< of the first look
  std::vector<LineCell> cells_;      ///< a heap, the widest gap first
  double least_ = 0.0;               ///< sums over the cells
  double most_ = 0.0;
  double estimate_ = 0.0;
  double depth_ = 0.0;  ///< m, radius of the balls that fit on the event's side of its boundary
  int looks_ = 0;
};

}  // namespace swept::detail
