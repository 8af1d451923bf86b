// SPDX-License-Identifier: BSD-3-Clause
#include "mesh.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace oracle {
namespace {

void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent,
             const Vector3d& scale, std::vector<Vector3d>& vertices, std::vector<Face>& faces) {
  const aiMatrix4x4 pose = parent * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    const int base = static_cast<int>(vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D p = pose * mesh.mVertices[v];
      vertices.push_back(scale.cwiseProduct(Vector3d(p.x, p.y, p.z)));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      const auto* k = face.mIndices;
      faces.push_back({base + static_cast<int>(k[0]), base + static_cast<int>(k[1]),
                       base + static_cast<int>(k[2])});
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c)
    collect(scene, *node.mChildren[c], pose, scale, vertices, faces);
}

enum class Crossing { No, FromFront, FromBack, TooClose };

/// Whether, and to which side, the ray p + s d (s > 0) crosses the triangle; TooClose when it
/// grazes the border.
Crossing crossing(const Triangle& t, const Vector3d& p, const Vector3d& d) {
  const Vector3d u = t[1] - t[0], v = t[2] - t[0], h = d.cross(v), w = p - t[0], q = w.cross(u);
  const double det = u.dot(h);
  const double size = std::max(u.norm(), v.norm());
  if (std::abs(det) <= 1e-12 * size * size) {
    // Seen edge-on: a thin line that matters only when the ray comes near it.
    for (int i = 0; i < 3; ++i)
      if (segmentDistance(t[i], t[(i + 1) % 3], p, p + 1e3 * d) < 1e-9) return Crossing::TooClose;
    return Crossing::No;
  }
  const double a = w.dot(h) / det, b = d.dot(q) / det, s = v.dot(q) / det;
  // Wide enough that a ray which goes through a crack grazes its borders.
  constexpr double kBorder = 1e-6;
  if (s < 0 || a < -kBorder || b < -kBorder || a + b > 1 + kBorder) return Crossing::No;
  if (a < kBorder || b < kBorder || a + b > 1 - kBorder) return Crossing::TooClose;
  return det > 0 ? Crossing::FromFront : Crossing::FromBack;
}

bool rayMeets(const Mesh::Node& box, const Vector3d& p, const Vector3d& inverse) {
  const Eigen::Array3d slack = (box.half.array() + 1e-9);
  const Eigen::Array3d s = (box.center.array() - slack - p.array()) * inverse.array();
  const Eigen::Array3d e = (box.center.array() + slack - p.array()) * inverse.array();
  return s.min(e).maxCoeff() <= s.max(e).minCoeff() && s.max(e).minCoeff() >= 0;
}

}  // namespace

Mesh::Mesh(const std::vector<Vector3d>& vertices, const std::vector<Face>& given, double crack) {
  MeshParts parts = partsOf(vertices, given, crack);
  if (parts.faces.empty()) throw std::runtime_error("mesh without triangles");
  part_ = std::move(parts.part);
  closed_ = std::move(parts.closed);
  oriented_ = std::move(parts.oriented);
  closedParts_ = static_cast<int>(std::count(closed_.begin(), closed_.end(), 1));
  std::vector<char> seen(closed_.size(), 0);
  for (size_t f = 0; f < part_.size(); ++f) {
    const Face& face = parts.faces[f];
    triangles_.push_back({vertices[face[0]], vertices[face[1]], vertices[face[2]]});
    if (!seen[part_[f]]) representatives_.push_back(vertices[face[0]]);
    seen[part_[f]] = 1;
  }
  split(0, static_cast<int>(triangles_.size()));
}

Mesh Mesh::read(const std::filesystem::path& file, const Vector3d& scale) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(file.string(), aiProcess_Triangulate);
  if (!scene || !scene->mRootNode)
    throw std::runtime_error(file.string() + ": " + importer.GetErrorString());
  std::vector<Vector3d> vertices;
  std::vector<Face> faces;
  collect(*scene, *scene->mRootNode, aiMatrix4x4(), Vector3d::Ones(), vertices, faces);
  double largest = 0;
  for (Vector3d& vertex : vertices) {
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
    vertex = vertex.cwiseProduct(scale);
  }
  // Two steps of single precision: what may come of one corner in a file; or 1e-5 of its size.
  Vector3d lower = vertices.front(), upper = lower;
  for (const Vector3d& vertex : vertices)
    lower = lower.cwiseMin(vertex), upper = upper.cwiseMax(vertex);
  const double rounding = 0x1p-22 * largest * scale.cwiseAbs().minCoeff();
  Mesh mesh(vertices, faces, std::max(rounding, 1e-5 * (upper - lower).maxCoeff()));
  // Of each of three coordinates; assimp keeps them, and places them, in single precision.
  mesh.rounding_ = std::sqrt(3.0) * 0x1p-22 * largest * scale.cwiseAbs().maxCoeff();
  return mesh;
}

int Mesh::split(int first, int last) {
  Vector3d lower = triangles_[first][0], upper = lower;
  for (int i = first; i < last; ++i)
    for (const Vector3d& p : triangles_[i]) lower = lower.cwiseMin(p), upper = upper.cwiseMax(p);
  const int index = static_cast<int>(nodes_.size());
  nodes_.push_back({(lower + upper) / 2, (upper - lower) / 2, -1, -1, first, last - first});
  if (last - first <= 2) return index;
  int axis;
  (upper - lower).maxCoeff(&axis);
  std::vector<int> order(last - first);
  std::iota(order.begin(), order.end(), first);
  auto middle = [&](int i) {
    return triangles_[i][0][axis] + triangles_[i][1][axis] + triangles_[i][2][axis];
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return middle(a) < middle(b); });
  std::vector<Triangle> sorted;
  std::vector<int> parts;
  for (const int i : order) sorted.push_back(triangles_[i]), parts.push_back(part_[i]);
  std::copy(sorted.begin(), sorted.end(), triangles_.begin() + first);
  std::copy(parts.begin(), parts.end(), part_.begin() + first);
  const int half = (first + last) / 2;
  const int left = split(first, half), right = split(half, last);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

bool Mesh::countCrossings(const Vector3d& p, const Vector3d& direction,
                          std::vector<Crossings>& found) const {
  found.assign(closed_.size(), {});
  const Vector3d inverse = direction.cwiseInverse();
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (!rayMeets(node, p, inverse)) continue;
    if (node.left >= 0) {
      stack.push_back(node.left);
      stack.push_back(node.right);
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const Crossing c = crossing(triangles_[i], p, direction);
      if (c == Crossing::TooClose) return false;
      if (c == Crossing::No) continue;
      ++found[part_[i]].all;
      found[part_[i]].winding += c == Crossing::FromBack ? 1 : -1;
    }
  }
  return true;
}

bool Mesh::encloses(const Vector3d& p) const {
  const Node& root = nodes_.front();
  if (closedParts_ == 0 || ((p - root.center).cwiseAbs().array() > root.half.array()).any())
    return false;
  std::vector<Crossings> found;
  for (int attempt = 0; attempt < 20; ++attempt) {
    // Any direction will do; grazing an edge asks for another.
    const double a = 0.7390851 + 2.3999632 * attempt, z = 0.31 + 0.03 * attempt;
    const Vector3d direction(std::cos(a), std::sin(a), z);
    if (!countCrossings(p, direction, found)) continue;
    for (size_t k = 0; k < found.size(); ++k)
      if (closed_[k] && (oriented_[k] ? found[k].winding != 0 : found[k].all % 2 != 0)) return true;
    return false;
  }
  return false;
}

double Mesh::distanceTo(const Vector3d& p) const {
  if (encloses(p)) return 0;
  double best = INFINITY;
  for (const Triangle& t : triangles_) best = std::min(best, (closestPoint(t, p) - p).norm());
  return best;
}

}  // namespace oracle
