// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "geometry/spread_directions.hpp"
#include "geometry/support_points.hpp"
#include "swept/core/convex_hull.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

namespace {

using detail::spreadDirection;
using Eigen::Vector3d;

}  // namespace

// The support data of kCoarse points stays in the fastest cache, that of many more does not. An
// outer hull with so few points reaches some hundredths of its width beyond a round body.
ConvexHull ConvexHull::coarser(const ConvexHull& hull) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return coarser(hull); });
  }
  const std::vector<Vector3d>& vertices = hull.vertices();
  if (vertices.size() <= kFew) return hull;
  std::vector<Vector3d> points;
  for (int i = 0; i < kCoarse; ++i)
    points.push_back(hull.supportPoints().farthest(spreadDirection(i, kCoarse)));
  const ConvexHull kept = of(points);
  double farthest = 0.0;
  for (const Vector3d& vertex : vertices) {
    const Eigen::Isometry3d at(Eigen::Translation3d(-vertex));
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
