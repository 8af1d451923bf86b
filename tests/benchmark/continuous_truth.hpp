// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "continuous_fcl.hpp"
#include "mesh_files.hpp"

/// First contacts found without our library: from closed forms, or FCL's distance.
namespace swept::benchmark {

/// Of the two shapes, given still_from_moving.
struct Probe {
  std::function<double(const Eigen::Isometry3d&)> distance;  ///< m; 0 or less: contact
  std::function<bool(const Eigen::Isometry3d&)> touches;
};

/// Steps of the distance over the speed, which may be 1 % too low, cannot pass a contact; where the
/// shapes are closer than `least` (m), steps of that length might pass one that is shallower. The
/// first contact is then bisected to the last bit of t.
inline Truth firstContact(const Probe& probe, const Sweep& sweep, double least) {
  const Eigen::Isometry3d still_from_world = sweep.still->at(0.0).inverse();
  const auto pose = [&](double t) { return still_from_world * sweep.motion->at(t); };
  const auto bisected = [&](double from, double toc) -> Truth {
    for (double middle = 0.5 * (from + toc); from < middle && middle < toc;
         middle = 0.5 * (from + toc))
      (probe.touches(pose(middle)) ? toc : from) = middle;
    return {true, from, toc};
  };
  for (double from = 0.0, t = 0.0;;) {
    const Eigen::Isometry3d here = pose(t);
    const double distance = probe.distance(here);
    if (distance <= 0.0 || probe.touches(here)) return bisected(from, t);
    if (t == 1.0) return {false, 1.0, 1.0};
    from = t;
    t = std::min(1.0, t + std::max(least, 0.99 * distance) / sweep.speed);
  }
}

#ifdef SWEPT_HAS_FCL
inline Probe fclProbe(const FclBodies& bodies) {
  return {[&bodies](const Eigen::Isometry3d& pose) { return bodies.distance(pose); },
          [&bodies](const Eigen::Isometry3d& pose) { return bodies.touches(pose); }};
}

/// Also looks at `samples` instants, lest a distance that is too large hides a contact.
inline Truth sampledFirstContact(const Probe& probe, const Sweep& sweep, double least,
                                 int samples) {
  const Truth truth = firstContact(probe, sweep, least);
  const Eigen::Isometry3d still_from_world = sweep.still->at(0.0).inverse();
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    if (t >= truth.from) break;
    if (probe.touches(still_from_world * sweep.motion->at(t)))
      return {true, std::max(0.0, t - 1.0 / samples), t};
  }
  return truth;
}
#endif

inline double pointSegmentDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

inline double pointTriangleDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                    const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const bool above = (b - a).cross(p - a).dot(normal) >= 0.0 &&
                     (c - b).cross(p - b).dot(normal) >= 0.0 &&
                     (a - c).cross(p - c).dot(normal) >= 0.0;
  if (above) return std::abs((p - a).dot(normal)) / normal.norm();
  return std::min({pointSegmentDistance(p, a, b), pointSegmentDistance(p, b, c),
                   pointSegmentDistance(p, c, a)});
}

/// Of balls around points that stand still and a mesh that moves: every ball against every
/// triangle.
inline Probe cloudProbe(std::vector<Eigen::Vector3d> points, double radius, Soup mesh) {
  const auto distance = [points = std::move(points), radius,
                         mesh = std::move(mesh)](const Eigen::Isometry3d& still_from_mesh) {
    const Eigen::Isometry3d mesh_from_still = still_from_mesh.inverse();
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d p = mesh_from_still * point;
      for (const Eigen::Vector3i& t : mesh.triangles) {
        const auto& v = mesh.vertices;
        least = std::min(least, pointTriangleDistance(p, v[static_cast<std::size_t>(t[0])],
                                                      v[static_cast<std::size_t>(t[1])],
                                                      v[static_cast<std::size_t>(t[2])]));
      }
    }
    return least - radius;
  };
  return {distance, [distance](const Eigen::Isometry3d& pose) { return distance(pose) <= 0.0; }};
}

}  // namespace swept::benchmark
