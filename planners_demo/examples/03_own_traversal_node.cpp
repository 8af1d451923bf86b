// SPDX-License-Identifier: BSD-3-Clause
// Your own traversal node: which balls of a cloud touch a surface. The library's recursion walks
// the two hierarchies. Exits 0 if a loop over all balls finds the same.
#include <iostream>
#include <set>

#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/height_field.hpp"
#include "swept/core/traversal/traversal.hpp"

using Model = swept::BvhModel<swept::Aabb>;

struct BallsOnSurface {
  const Model& balls;
  const Model& surface;
  std::set<int> touching = {};

  const auto& first(int i) const { return balls.tree().node(i); }
  const auto& second(int j) const { return surface.tree().node(j); }
  bool isFirstLeaf(int i) const { return first(i).isLeaf(); }
  bool isSecondLeaf(int j) const { return second(j).isLeaf(); }
  bool firstOverSecond(int i, int j) const {
    return first(i).volume.size() > second(j).volume.size();
  }
  std::array<int, 2> firstChildren(int i) const { return {i + 1, first(i).rightChild}; }
  std::array<int, 2> secondChildren(int j) const { return {j + 1, second(j).rightChild}; }
  bool bvTesting(int i, int j) const { return !first(i).volume.overlaps(second(j).volume); }
  void leafTesting(int i, int j) {
    const int ball = balls.tree().order()[first(i).first];  // the models have one per leaf
    const Eigen::Vector3d& p = balls.vertices()[ball];
    const auto corners = surface.corners(surface.tree().order()[second(j).first]);
    if (swept::triangleDistance({p, p, p}, corners).upper <= balls.radii()[ball])
      touching.insert(ball);
  }
  bool canStop() const { return false; }  // all balls are wanted
};

int main() {
  const auto hills = swept::heightField(2.0, 2.0, 0.3 * Eigen::MatrixXd::Random(30, 30), -0.5);
  Model balls({.maxLeaf = 1}), surface({.maxLeaf = 1});
  balls.begin();
  for (int i = 0; i < 500; ++i) balls.addPoint(Eigen::Vector3d::Random(), 0.05);
  balls.end();
  surface.begin();
  surface.addMesh(hills.vertices(), hills.triangles());
  surface.end();
  BallsOnSurface node{balls, surface};
  swept::collisionTraverse(node);
  const auto same =
      swept::TriangleMesh::build(hills.vertices(), hills.triangles(), swept::MeshInterior::Surface);
  std::set<int> expected;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Isometry3d at(Eigen::Translation3d(balls.vertices()[i]));
    if (collide(same, swept::makeSphere(0.05), at) == swept::Contact::Touching) expected.insert(i);
  }
  std::cout << node.touching.size() << " of 500 balls touch, expected " << expected.size() << '\n';
  return !expected.empty() && node.touching == expected ? 0 : 1;
}
