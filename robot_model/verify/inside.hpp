// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "body.hpp"

namespace swept::verify {

enum class Side { Outside, Inside, Unknown };

/// The closed components of a surface, which must outlive this. Triangles with a common edge belong
/// to one component. Triangles that hang on a solid, or have a border, belong to no closed
/// component.
class Enclosure {
 public:
  explicit Enclosure(const Surface& surface);

  /// The position of a point (m, in the surface's frame): whether the crossings of a ray from it to
  /// infinity with a closed component do not cancel (or, if its triangles are not oriented alike,
  /// are odd in number). Rays that come near an edge are replaced by others; Unknown: all of them
  /// do.
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
