// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bv/obb_rss.hpp"

#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(BoundingVolume<ObbRss>);

ObbRss ObbRss::fit(std::span<const Eigen::Vector3d> points) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points] { return fit(points); });
  }
  // The box serves both: finding its axes is most of the work.
  const Obb obb = Obb::fit(points);
  return {obb, Rss::fitWithin(points, obb)};
}

ObbRss ObbRss::merge(const ObbRss& a, const ObbRss& b) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return merge(a, b); });
  }
  return {Obb::merge(a.obb, b.obb), Rss::merge(a.rss, b.rss)};
}

}  // namespace swept
