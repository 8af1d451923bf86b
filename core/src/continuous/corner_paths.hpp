// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "continuous/corner_hull.hpp"
#include "swept/core/continuous/impact.hpp"

namespace swept::detail {

/// The corners at both ends of the motion.
struct CornerPaths {
  Corners start;
  Corners end;
};

inline void setCorner(CornerPaths& paths, int k, const LinearPath& a, const LinearPath& b,
                      double scale) {
  const Eigen::Vector3d start = scale * a.start - scale * b.start;
  const Eigen::Vector3d end = scale * a.end - scale * b.end;
  paths.start.x[k] = start.x();
  paths.start.y[k] = start.y();
  paths.start.z[k] = start.z();
  paths.end.x[k] = end.x();
  paths.end.y[k] = end.y();
  paths.end.z[k] = end.z();
}

/// Largest coordinate; NaN or infinite unless all of them are finite.
inline double sizeOf(const CornerPaths& paths) {
  double most = 0.0;
  double poison = 0.0;
  for (const Corners* corners : {&paths.start, &paths.end}) {
    for (int k = 0; k < 4; ++k) {
      const double x = std::abs(corners->x[k]);
      const double y = std::abs(corners->y[k]);
      const double z = std::abs(corners->z[k]);
      most = std::max(most, std::max(x, std::max(y, z)));
      poison += 0.0 * x + 0.0 * y + 0.0 * z;
    }
  }
  return most + poison;
}

inline void rescale(Corners& corners, double scale) {
  for (int k = 0; k < 4; ++k) {
    corners.x[k] *= scale;
    corners.y[k] *= scale;
    corners.z[k] *= scale;
  }
}

inline void interpolate(const CornerPaths& paths, double t, Corners& corners) {
  const double rest = 1.0 - t;
  for (int k = 0; k < 4; ++k) corners.x[k] = rest * paths.start.x[k] + t * paths.end.x[k];
  for (int k = 0; k < 4; ++k) corners.y[k] = rest * paths.start.y[k] + t * paths.end.y[k];
  for (int k = 0; k < 4; ++k) corners.z[k] = rest * paths.start.z[k] + t * paths.end.z[k];
}

/// Whether all the numbers are above the threshold, or all below its negative.
inline bool beyond(const std::array<double, 4>& a, const std::array<double, 4>& b,
                   double threshold) {
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (int k = 0; k < 4; ++k) {
    least = std::min(least, std::min(a[k], b[k]));
    most = std::max(most, std::max(a[k], b[k]));
  }
  return least > threshold || most < -threshold;
}

}  // namespace swept::detail
