// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "geometry/error_model.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

/// m; far more than the loss of underflowing products together, each at most the least denormal.
inline constexpr double kVolumeUnderflow = 1e-300;

/// m^2; above this, squares and sums of some keep their digits.
inline constexpr double kLeastSquare = 1e-290;

/// m; possible error of a gap, where `sum` (m) is the sum of the absolute values of all numbers
/// involved.
inline double volumeMargin(double sum) {
  return kVolumeRounding * sum + kVolumeUnderflow;
}

/// Loss of a lower bound by the rounding of its own last operations, and by the lengths of axes.
inline constexpr double kBoundShrink = 1.0 - kVolumeRounding;

/// Two boxes, seen along the axes of the first.
struct BoxPair {
  Eigen::Matrix3d rotation;  ///< columns: the axes of b
  Eigen::Vector3d offset;    ///< m, from the middle of a to that of b
  Eigen::Vector3d halfA;     ///< m
  Eigen::Vector3d halfB;     ///< m
  double margin;             ///< m; only a gap of more than this is proven
};

/// m, sum of absolute values.
inline double magnitude(const Eigen::Vector3d& v) {
  return std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
}

/// m; gap along axis k of the first box.
inline double gapAlongA(const BoxPair& p, int k) {
  return std::abs(p.offset[k]) - p.halfA[k] - std::abs(p.rotation(k, 0)) * p.halfB[0] -
         std::abs(p.rotation(k, 1)) * p.halfB[1] - std::abs(p.rotation(k, 2)) * p.halfB[2];
}

/// m; gap along axis k of the second box.
inline double gapAlongB(const BoxPair& p, int k) {
  const double offset = p.rotation(0, k) * p.offset[0] + p.rotation(1, k) * p.offset[1] +
                        p.rotation(2, k) * p.offset[2];
  return std::abs(offset) - p.halfB[k] - std::abs(p.rotation(0, k)) * p.halfA[0] -
         std::abs(p.rotation(1, k)) * p.halfA[1] - std::abs(p.rotation(2, k)) * p.halfA[2];
}

/// m; gap along axis i of the first x axis j of the second box, times the length of this axis,
/// which need not be 1.
inline double gapAlongEdges(const BoxPair& p, int i, int j) {
  const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
  const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
  const double offset = p.offset[i2] * p.rotation(i1, j) - p.offset[i1] * p.rotation(i2, j);
  return std::abs(offset) - p.halfA[i1] * std::abs(p.rotation(i2, j)) -
         p.halfA[i2] * std::abs(p.rotation(i1, j)) - p.halfB[j1] * std::abs(p.rotation(i, j2)) -
         p.halfB[j2] * std::abs(p.rotation(i, j1));
}

/// True only if one of the six face axes separates the boxes. NaN separates nothing.
inline bool separatedByFaces(const BoxPair& p) {
  for (int k = 0; k < 3; ++k) {
    if (gapAlongA(p, k) > p.margin) return true;
  }
  for (int k = 0; k < 3; ++k) {
    if (gapAlongB(p, k) > p.margin) return true;
  }
  return false;
}

/// True only if one of the nine edge axes separates the boxes. An axis of nearly parallel edges is
/// nearly zero, and so is the gap along it: the margin rules it out.
inline bool separatedByEdges(const BoxPair& p) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (gapAlongEdges(p, i, j) > p.margin) return true;
    }
  }
  return false;
}

/// The part of a gap that is proven, squared.
inline double provenSquare(double gap, double margin) {
  const double proven = gap - margin;
  return proven > 0.0 ? proven * proven : 0.0;
}

/// m; 0 unless it is a finite positive number large enough to have kept its digits.
inline double boundFromSquare(double squared) {
  if (!(squared > kLeastSquare)) return 0.0;
  const double bound = kBoundShrink * std::sqrt(squared);
  return bound < std::numeric_limits<double>::infinity() ? bound : 0.0;
}

/// m^2; squared lower bound on the distance. Along each of three orthonormal axes, the vector
/// between two points has at least the component of the gap: the squares add up.
inline double squaredFaceBound(const BoxPair& p) {
  double alongA = 0.0;
  double alongB = 0.0;
  for (int k = 0; k < 3; ++k) {
    alongA += provenSquare(gapAlongA(p, k), p.margin);
    alongB += provenSquare(gapAlongB(p, k), p.margin);
  }
  return alongA > alongB ? alongA : alongB;
}

/// m^2; squared lower bound from the nine edge axes.
inline double squaredEdgeBound(const BoxPair& p) {
  // The length of the axis is about a sine; below this it is too inaccurate to divide by.
  constexpr double kLeastSquared = 1e-6;
  double best = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double square = provenSquare(gapAlongEdges(p, i, j), p.margin);
      if (!(square > best * 1e-6)) continue;
      // Do not use the cosine: the axes of b may be longer than one.
      const double across = p.rotation((i + 1) % 3, j), along = p.rotation((i + 2) % 3, j);
      const double squaredLength = across * across + along * along + kVolumeRounding;
      if (squaredLength < kLeastSquared) continue;
      const double bound = square / squaredLength;
      if (bound > best) best = bound;
    }
  }
  return best;
}

}  // namespace swept::detail
