// SPDX-License-Identifier: BSD-3-Clause
// A traversal node of one's own: which points of a cloud of balls touch a mesh. The library's
// recursion does the walking; the node says what the hierarchies are and what is tested. Exits 0 if
// every pair of ball and triangle, tested one by one, gives the same points.
#include <cstdio>
#include <set>

#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/traversal/traversal.hpp"

namespace {

using Eigen::Vector3d;
using Model = swept::BvhModel<swept::Aabb>;

bool ballTouches(const Model& cloud, int point, const Model& mesh, int triangle) {
  const Vector3d& p = cloud.vertices()[point];
  const double gap = swept::triangleDistance({p, p, p}, mesh.corners(triangle)).upper;
  return gap <= cloud.radii()[point];
}

struct CloudMeshNode {
  const Model& cloud;
  const Model& mesh;
  std::set<int> touching;  // points
  int leafTests = 0;

  bool isFirstLeaf(int i) const { return cloud.tree().node(i).isLeaf(); }
  bool isSecondLeaf(int j) const { return mesh.tree().node(j).isLeaf(); }
  bool firstOverSecond(int i, int j) const {
    return cloud.tree().node(i).volume.size() > mesh.tree().node(j).volume.size();
  }
  std::array<int, 2> firstChildren(int i) const { return {i + 1, cloud.tree().node(i).rightChild}; }
  std::array<int, 2> secondChildren(int j) const { return {j + 1, mesh.tree().node(j).rightChild}; }
  bool bvTesting(int i, int j) const {
    return !cloud.tree().node(i).volume.overlaps(mesh.tree().node(j).volume);
  }
  void leafTesting(int i, int j) {
    ++leafTests;  // the models below have one primitive per leaf
    const int point = cloud.tree().order()[cloud.tree().node(i).first];
    const int triangle = mesh.tree().order()[mesh.tree().node(j).first];
    if (ballTouches(cloud, point, mesh, triangle)) touching.insert(point);
  }
  bool canStop() const { return false; }  // all points are wanted
};
static_assert(swept::CollisionTraversal<CloudMeshNode>);

}  // namespace

int main() {
  const auto somewhere = [] { return Vector3d(Vector3d::Random()); };
  const swept::BvhOptions<swept::Aabb> options{.maxLeaf = 1};
  Model cloud(options);
  Model mesh(options);
  cloud.begin();
  mesh.begin();
  for (int i = 0; i < 300; ++i) {
    cloud.addPoint(somewhere(), 0.05);
    const Vector3d a = somewhere();
    mesh.addTriangle(a, a + 0.2 * somewhere(), a + 0.2 * somewhere());
  }
  cloud.end();
  mesh.end();

  CloudMeshNode node{cloud, mesh, {}};
  swept::collisionTraverse(node);

  std::set<int> expected;
  for (int point = 0; point < 300; ++point) {
    for (int triangle = 0; triangle < 300; ++triangle) {
      if (ballTouches(cloud, point, mesh, triangle)) expected.insert(point);
    }
  }
  std::printf("%zu balls touch, %d pairs tested\n", node.touching.size(), node.leafTests);
  return !expected.empty() && node.touching == expected && node.leafTests < 9000 ? 0 : 1;
}
