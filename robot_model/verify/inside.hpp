// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "body.hpp"

namespace swept::verify {

enum class Side { Outside, Inside, Unknown };

/// The closed components of a surface, which has to outlive it. Triangles with an edge in common
/// are of one component; those that hang on a solid, or have a border, are of none that is closed.
class Enclosure {
 public:
  explicit Enclosure(const Surface& surface);

  /// Where a point (m, in the surface's frame) lies: whether a ray from it to infinity crosses a
  /// closed component, out and in not cancelling each other (or, where its triangles are not
  /// oriented alike, an odd number of times). Rays that come near an edge are replaced by others;
  /// Unknown: all of them do.
  Side sideOf(const Eigen::Vector3d& point) const;

 private:
  struct Component {
    bool closed = true;    ///< every edge has an even number of triangles
    bool oriented = true;  ///< half of which pass it each way
  };
  Side sideAlong(const Eigen::Vector3d& ray, const Eigen::Vector3d& point) const;

  const Surface& surface_;
  Eigen::Vector3d lower_, upper_;  ///< m, box of the surface
  std::vector<int> componentOf_;   ///< per triangle
  std::map<int, Component> components_;
};

}  // namespace swept::verify
