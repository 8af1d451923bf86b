// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/convex.hpp"

#include "simd/farthest_point.hpp"

namespace swept::detail::support {

using Eigen::Vector3d;

Vector3d ofPoints(std::span<const Vector3d> points, const double* coordinates, const Vector3d& d) {
  if (coordinates != nullptr) {
    constexpr std::size_t kLanes = ConvexHull::kLanes;
    const std::size_t padded = (points.size() + kLanes - 1) / kLanes * kLanes;
    const std::size_t found = farthestPoint(coordinates, padded, d.x(), d.y(), d.z());
    return points[found < points.size() ? found : 0];
  }
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
