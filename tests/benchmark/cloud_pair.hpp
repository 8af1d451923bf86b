// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "fcl_peer.hpp"
#include "mesh_files.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/point_cloud.hpp"
#include "timing.hpp"

#ifdef SWEPT_HAS_FCL
#include <octomap/octomap.h>
#endif

/// Two clouds of balls in different poses: the piano and the room of Pan, Chitta, Manocha 2012,
/// section V.D, as clouds; FCL's octrees of the same points beside.
namespace swept::benchmark {

using Points = std::vector<Eigen::Vector3d>;

/// Evenly spread over the triangles' area.
inline Points surfacePoints(const Soup& soup, std::size_t count, unsigned seed) {
  std::vector<double> areas;
  const auto corner = [&](const Eigen::Vector3i& t, int k) { return soup.vertices[t[k]]; };
  for (const Eigen::Vector3i& t : soup.triangles) {
    const Eigen::Vector3d e = corner(t, 1) - corner(t, 0), f = corner(t, 2) - corner(t, 0);
    areas.push_back(0.5 * e.cross(f).norm());
  }
  std::mt19937_64 random(seed);
  std::discrete_distribution<std::size_t> which(areas.begin(), areas.end());
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Points points;
  while (points.size() < count) {
    const Eigen::Vector3i& t = soup.triangles[which(random)];
    double u = share(random), v = share(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Eigen::Vector3d origin = corner(t, 0);
    points.push_back(origin + u * (corner(t, 1) - origin) + v * (corner(t, 2) - origin));
  }
  return points;
}

#ifdef SWEPT_HAS_FCL
/// Of cubes that a ball of `radius` just contains: each contains the point that it is of.
inline std::shared_ptr<fcl::OcTreed> fclOctree(const Points& points, double radius) {
  const auto map = std::make_shared<octomap::OcTree>(2.0 * radius / std::sqrt(3.0));
  for (const Eigen::Vector3d& p : points) map->updateNode(p.x(), p.y(), p.z(), true, true);
  map->updateInnerOccupancy();
  map->prune();
  auto tree = std::make_shared<fcl::OcTreed>(map);
  tree->computeLocalAABB();
  return tree;
}
#endif

/// Poses of the second cloud in the frame of the first.
struct CloudPairWork {
  std::string name;
  Points first, second;
  double radius;  ///< in the unit of the points
  std::vector<Eigen::Isometry3d> poses;
};

/// A row of ours, and of FCL's. Distances are asked for where the clouds are apart, at most `few`:
/// FCL takes up to a second each.
inline void printCloudPair(const CloudPairWork& work, std::size_t few, const MarkdownTable& table) {
  const Shape a = PointCloud::build(work.first, work.radius);
  const Shape b = PointCloud::build(work.second, work.radius);
  std::vector<Eigen::Isometry3d> apart;
  for (const Eigen::Isometry3d& pose : work.poses) {
    if (apart.size() < few && collide(a, b, pose) == Contact::Separate) apart.push_back(pose);
  }
  std::size_t touching = 0;
  double sum = 0.0;  // so that nothing is optimised away
  std::vector<Contestant> collisions{{"swept", [&] {
                                        touching = 0;
                                        for (const Eigen::Isometry3d& pose : work.poses)
                                          touching += collide(a, b, pose) == Contact::Touching;
                                      }}};
  std::vector<Contestant> distances{{"swept", [&] {
                                       for (const Eigen::Isometry3d& pose : apart)
                                         sum += distance(a, b, pose).lower;
                                     }}};
#ifdef SWEPT_HAS_FCL
  const FclPair pair{fclOctree(work.first, work.radius), fclOctree(work.second, work.radius)};
  collisions.push_back({"FCL, octrees", [&] {
                          for (const Eigen::Isometry3d& pose : work.poses)
                            sum += static_cast<double>(pair.contacts(pose, 1, false));
                        }});
  distances.push_back({"FCL, octrees", [&] {
                         for (const Eigen::Isometry3d& pose : apart) sum += pair.distance(pose);
                       }});
#endif
  takeTurns(collisions, 3);
  takeTurns(distances, 1);
  std::vector<std::string> cells{
      work.name, std::to_string(work.first.size()), std::to_string(work.second.size()),
      std::to_string(touching) + " of " + std::to_string(work.poses.size())};
  for (const std::string& cell : comparison(collisions, work.poses.size(), 1e-3))
    cells.push_back(cell);
  for (const std::string& cell : comparison(distances, apart.size(), 1e-3)) cells.push_back(cell);
  table.row(cells);
  if (!(sum >= 0.0)) std::printf("a distance is no number\n");
}

}  // namespace swept::benchmark
