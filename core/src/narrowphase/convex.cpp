// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/convex.hpp"

namespace swept::detail::support {

using Eigen::Vector3d;

Vector3d ofPoints(std::span<const Vector3d> points, const Vector3d& d) {
  std::size_t best = 0;
  double most = points[0].dot(d);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double along = points[i].dot(d);
    if (along > most) {
      most = along;
      best = i;
    }
  }
  return points[best];
}

}  // namespace swept::detail::support
