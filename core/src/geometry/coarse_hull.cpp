// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "geometry/spread_directions.hpp"
#include "simd/farthest_point.hpp"
#include "swept/core/convex_hull.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

namespace {

using detail::spreadDirection;
using Eigen::Vector3d;

}  // namespace

// More points than kFew, and a scan for the farthest costs more than a hierarchy's answer; an outer
// hull of kCoarse of them reaches some hundredths of its width beyond a round body.
ConvexHull ConvexHull::coarser(const ConvexHull& hull) {
  const std::vector<Vector3d>& vertices = hull.vertices();
  if (vertices.size() <= kFew) return hull;
  const std::span<const double> coordinates = hull.coordinates();
  std::vector<char> chosen(vertices.size(), 0);
  std::vector<Vector3d> points;
  for (int i = 0; i < kCoarse; ++i) {
    const Vector3d d = spreadDirection(i, kCoarse);
    // The last lanes repeat the first vertex.
    const std::size_t found =
        detail::farthestPoint(coordinates.data(), coordinates.size() / 3, d.x(), d.y(), d.z());
    const std::size_t best = found < vertices.size() ? found : 0;
    if (chosen[best] == 0) points.push_back(vertices[best]);
    chosen[best] = 1;
  }
  const ConvexHull kept = of(points);
  double farthest = 0.0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (chosen[i] != 0) continue;
    const Eigen::Isometry3d at(Eigen::Translation3d(-vertices[i]));
    farthest = std::max(farthest, distance(Sphere{0.0}, kept, at).upper);
  }
  auto data = std::make_shared<Data>(*kept.data_);
  // Lemma: the distance of a point to a hull is convex in the point, so that of a vertex is the
  // largest. The witnesses that bound it are within rounding of the vertex and of the hull.
  data->error = farthest * (1.0 + 1e-9) + 2.0 * kept.error() + hull.error() +
                4.0 * tolerance::kSupportRounding * hull.extent();
  return ConvexHull(std::move(data));
}

}  // namespace swept
