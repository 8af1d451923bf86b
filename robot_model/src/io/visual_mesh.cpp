// SPDX-License-Identifier: BSD-3-Clause
#include "io/visual_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace swept::detail {

namespace {

using Place = std::array<float, 3>;

struct PlaceHash {
  std::size_t operator()(const Place& place) const {
    std::size_t hash = 0;
    for (const float value : place)
      hash = hash * 1'000'003 + std::hash<float>{}(value);  // the same for 0 and -0
    return hash;
  }
};

/// Gives each place a number.
class Corners {
 public:
  explicit Corners(VisualMesh& mesh) : mesh_(mesh) {}
  int numberOf(const Eigen::Vector3f& at) {
    const auto [known, isNew] =
        numbers_.try_emplace({at.x(), at.y(), at.z()}, static_cast<int>(mesh_.vertices.size()));
    if (isNew) mesh_.vertices.push_back(at);
    return known->second;
  }

 private:
  VisualMesh& mesh_;
  std::unordered_map<Place, int, PlaceHash> numbers_;
};

bool isTriangle(const Eigen::Vector3i& corners) {
  return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

/// Corners and triangles when all corners within a cell are one.
class Clustering {
 public:
  /// `cells` along the longest side of the mesh.
  Clustering(const VisualMesh& mesh, int cells) : cellOf_(mesh.vertices.size()) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex);
    const float longest = std::max(box.sizes().maxCoeff(), std::numeric_limits<float>::min());
    std::unordered_map<std::uint64_t, int> numbers;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const Eigen::Vector3f at = (mesh.vertices[i] - box.min()) / longest * float(cells);
      std::uint64_t key = 0;
      for (int axis = 0; axis < 3; ++axis)
        key = key << 16 | static_cast<std::uint64_t>(std::clamp(int(at[axis]), 0, cells - 1));
      const auto [known, isNew] = numbers.try_emplace(key, static_cast<int>(sums_.size()));
      if (isNew) sums_.emplace_back(Eigen::Vector4d::Zero());
      cellOf_[i] = known->second;
      sums_[static_cast<std::size_t>(known->second)] +=
          mesh.vertices[i].cast<double>().homogeneous();
    }
    addTriangles(mesh);
  }
  std::size_t count() const { return triangles_.size(); }
  void moveTo(VisualMesh& mesh) {
    mesh.vertices.clear();
    for (const Eigen::Vector4d& sum : sums_)
      mesh.vertices.emplace_back(sum.hnormalized().cast<float>());
    mesh.triangles = std::move(triangles_);
  }

 private:
  /// Each set of corners once, in the order of the mesh.
  void addTriangles(const VisualMesh& mesh) {
    std::vector<std::pair<std::array<int, 3>, std::size_t>> sets;
    std::vector<Eigen::Vector3i> all;
    for (const Eigen::Vector3i& triangle : mesh.triangles) {
      const Eigen::Vector3i corners(cellOf_[triangle[0]], cellOf_[triangle[1]],
                                    cellOf_[triangle[2]]);
      if (!isTriangle(corners)) continue;
      std::array<int, 3> set{corners[0], corners[1], corners[2]};
      std::ranges::sort(set);
      sets.emplace_back(set, all.size());
      all.push_back(corners);
    }
    std::ranges::sort(sets);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < sets.size(); ++i)
      if (i == 0 || sets[i].first != sets[i - 1].first) kept.push_back(sets[i].second);
    std::ranges::sort(kept);
    for (const std::size_t i : kept) triangles_.push_back(all[i]);
  }

  std::vector<int> cellOf_;
  std::vector<Eigen::Vector4d> sums_;  ///< of corners, and how many
  std::vector<Eigen::Vector3i> triangles_;
};

}  // namespace

std::vector<ColouredMesh> colouredMeshes(const MeshFileContent& content,
                                         const Eigen::Vector3d& scale) {
  std::vector<ColouredMesh> meshes;
  std::map<std::uint32_t, std::size_t> places;
  std::vector<Corners> corners;
  for (std::size_t i = 0; i < content.triangles.size(); ++i) {
    const std::uint32_t colour = content.colours.empty() ? kNoColour : content.colours[i];
    const auto [known, isNew] = places.try_emplace(colour, meshes.size());
    if (isNew) {
      meshes.push_back({colour, std::make_shared<VisualMesh>()});
      corners.emplace_back(*meshes.back().mesh);
    }
    Eigen::Vector3i triangle;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& vertex = content.vertices[content.triangles[i][k]];
      const Eigen::Vector3f at = vertex.cwiseProduct(scale).cast<float>();
      if (!at.allFinite()) return {};
      triangle[k] = corners[known->second].numberOf(at);
    }
    if (isTriangle(triangle)) meshes[known->second].mesh->triangles.push_back(triangle);
  }
  for (const ColouredMesh& mesh : meshes) mesh.mesh->trianglesOfFile = mesh.mesh->triangles.size();
  return meshes;
}

void makeCoarser(VisualMesh& mesh, std::size_t most) {
  if (mesh.triangles.size() <= most) return;
  // One cell leaves nothing, which is few enough.
  constexpr int kMostCells = 1 << 14;
  int few = 1, many = kMostCells;
  while (many - few > std::max(1, few / 32)) {
    const int middle = few + (many - few) / 2;
    (Clustering(mesh, middle).count() <= most ? few : many) = middle;
  }
  Clustering(mesh, few).moveTo(mesh);
}

std::size_t evenShare(std::vector<std::size_t> counts, std::size_t inAll) {
  std::ranges::sort(counts);
  std::size_t left = inAll;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::size_t share = left / (counts.size() - i);
    if (counts[i] > share) return share;
    left -= counts[i];
  }
  return counts.empty() ? inAll : counts.back();
}

}  // namespace swept::detail
