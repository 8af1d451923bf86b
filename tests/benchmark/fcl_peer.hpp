// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef SWEPT_HAS_FCL
// The peer's headers are not held to our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <fcl/fcl.h>

#include <vector>
#pragma GCC diagnostic pop

#include <memory>

#include "mesh_files.hpp"

/// FCL on the same inputs, the way its users call it.
namespace swept::benchmark {

template <typename Volume>
std::shared_ptr<fcl::BVHModel<Volume>> fclModel(const Soup& soup) {
  auto model = std::make_shared<fcl::BVHModel<Volume>>();
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(soup.triangles.size());
  for (const Eigen::Vector3i& t : soup.triangles)
    triangles.emplace_back(static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]),
                           static_cast<std::size_t>(t[2]));
  model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(soup.vertices.size()));
  model->addSubModel(soup.vertices, triangles);
  model->endModel();
  model->computeLocalAABB();
  return model;
}

/// A pair of geometries; the second moves.
struct FclPair {
  std::shared_ptr<fcl::CollisionGeometryd> a, b;

  /// Number of contacts, up to `most`; with points and depths if asked to.
  std::size_t contacts(const Eigen::Isometry3d& a_from_b, std::size_t most, bool points) const {
    const fcl::CollisionRequestd request(most, points);
    fcl::CollisionResultd result;
    return fcl::collide(a.get(), fcl::Transform3d::Identity(), b.get(), fcl::Transform3d(a_from_b),
                        request, result);
  }
  double distance(const Eigen::Isometry3d& a_from_b) const {
    const fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result;
    fcl::distance(a.get(), fcl::Transform3d::Identity(), b.get(), fcl::Transform3d(a_from_b),
                  request, result);
    return result.min_distance;
  }
};

}  // namespace swept::benchmark
#endif
