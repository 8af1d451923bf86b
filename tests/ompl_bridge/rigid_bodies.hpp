// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "swept/robot_model/robot.hpp"

/// Rigid bodies that float freely, and meshes made of blocks. `Soup` is any type with `vertices`
/// (Vector3d) and `triangles` (Vector3i).
namespace swept::test {

/// Some of the blocks between the planes of a grid.
struct BlockGrid {
  using Block = std::array<std::size_t, 3>;     ///< the planes that it begins at
  std::array<std::vector<double>, 3> planes{};  ///< m, ascending, across x, y, z
  std::vector<Block> blocks{};

  bool has(const Block& block) const { return std::ranges::find(blocks, block) != blocks.end(); }
  Eigen::Vector3d corner(const Block& at) const {
    return {planes[0][at[0]], planes[1][at[1]], planes[2][at[2]]};
  }
};

/// Side of a block across `axis`: two triangles that face outward.
template <typename Soup>
void appendSide(const BlockGrid& grid, BlockGrid::Block at, std::size_t axis, bool upper,
                Soup& soup) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const int first = static_cast<int>(soup.vertices.size());
  if (upper) ++at[axis];
  soup.vertices.push_back(grid.corner(at));
  ++at[u];
  soup.vertices.push_back(grid.corner(at));
  ++at[v];
  soup.vertices.push_back(grid.corner(at));
  --at[u];
  soup.vertices.push_back(grid.corner(at));
  for (const int k : {1, 2})
    soup.triangles.emplace_back(first, first + k + (upper ? 0 : 1), first + k + (upper ? 1 : 0));
}

/// The surface of all blocks together: closed, with nothing between neighbours.
template <typename Soup>
Soup blockMesh(const BlockGrid& grid) {
  Soup soup;
  for (const BlockGrid::Block& block : grid.blocks) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      BlockGrid::Block below = block, above = block;
      --below[axis];  // wraps around at the first plane, where no block is
      ++above[axis];
      if (!grid.has(below)) appendSide(grid, block, axis, false, soup);
      if (!grid.has(above)) appendSide(grid, block, axis, true, soup);
    }
  }
  return soup;
}

template <typename Soup>
void writeObj(const Soup& soup, const std::filesystem::path& file) {
  std::ofstream stream(file);
  stream << std::setprecision(9);  // the readers keep floats
  for (const Eigen::Vector3d& v : soup.vertices)
    stream << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
  for (const Eigen::Vector3i& t : soup.triangles)
    stream << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  if (!stream.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

/// A robot of one link, `body`, that is the mesh and floats by the joint `place`; its group is
/// `all`. Throws InputError.
inline std::shared_ptr<const Robot> floatingBody(const std::filesystem::path& mesh) {
  const std::string urdf =
      "<?xml version='1.0'?>\n<robot name='rigid'>\n<link name='body'><collision><geometry>"
      "<mesh filename='file://" +
      std::filesystem::absolute(mesh).string() + "'/></geometry></collision></link>\n</robot>\n";
  const std::string srdf =
      "<?xml version='1.0'?>\n<robot name='rigid'>\n<virtual_joint name='place' type='floating' "
      "parent_frame='world' child_link='body'/>\n</robot>\n";
  return Robot::parse(urdf, "rigid.urdf", srdf, "rigid.srdf");
}

}  // namespace swept::test
