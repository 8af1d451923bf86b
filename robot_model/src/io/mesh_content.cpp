// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_content.hpp"

#include <string>
#include <utility>

namespace swept::detail {

void requireFewTriangles(std::uint64_t count) {
  constexpr std::uint64_t kMost = 20'000'000;
  if (count <= kMost) return;
  throw MeshFileError("has more than " + std::to_string(kMost) +
                      " triangles, which is the most allowed");
}

void keepUsedVertices(MeshFileContent& content) {
  std::vector<int> placeOf(content.vertices.size(), -1);
  std::vector<Eigen::Vector3d> used;
  for (Eigen::Vector3i& triangle : content.triangles) {
    for (int& corner : triangle) {
      int& place = placeOf[static_cast<std::size_t>(corner)];
      if (place < 0) {
        place = static_cast<int>(used.size());
        used.push_back(content.vertices[static_cast<std::size_t>(corner)]);
      }
      corner = place;
    }
  }
  content.vertices = std::move(used);
}

}  // namespace swept::detail
