// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string_view>

#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bvh/bv_tree.hpp"
#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/traversal/traversal.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {

namespace detail {

/// The rigid pose that `pose` stands for (`distance.hpp`): itself if it is rigid enough, else the
/// nearest rigid one; NaN if there is none.
Eigen::Isometry3d rigidPose(const Eigen::Isometry3d& pose);

}  // namespace detail

/// Two models and the pose between them: the part of a traversal node that walks their trees. Keeps
/// references to the models.
template <BoundingVolume BV>
class MeshPair {
 public:
  ///@{
  /// See `PairTraversal`; the larger volume is descended first.
  bool isFirstLeaf(int i) const { return first(i).isLeaf(); }
  bool isSecondLeaf(int j) const { return second(j).isLeaf(); }
  bool firstOverSecond(int i, int j) const {
    return first(i).volume.size() > second(j).volume.size();
  }
  std::array<int, 2> firstChildren(int i) const { return {i + 1, first(i).rightChild}; }
  std::array<int, 2> secondChildren(int j) const { return {j + 1, second(j).rightChild}; }
  ///@}
  /// Pose of the second model in the first one's frame, made rigid (`distance.hpp`); NaN if that is
  /// impossible.
  const Eigen::Isometry3d& pose() const { return a_from_b_; }

 protected:
  /// Throws, naming `call`, unless both models can be queried and have triangles.
  MeshPair(const BvhModel<BV>& a, const BvhModel<BV>& b, const Eigen::Isometry3d& a_from_b,
           std::string_view call)
      : a_(a), b_(b), a_from_b_(inDefaultEnvironment([&] { return detail::rigidPose(a_from_b); })) {
    a.requireTriangles(call);
    b.requireTriangles(call);
  }
  ~MeshPair() = default;

  ///@{
  /// Nodes of either tree.
  const typename BvTree<BV>::Node& first(int i) const { return a_.tree().node(i); }
  const typename BvTree<BV>::Node& second(int j) const { return b_.tree().node(j); }
  ///@}
  /// A triangle of b, in a's frame (m).
  TriangleCorners secondCorners(int triangle) const {
    const TriangleCorners c = b_.corners(triangle);
    return {a_from_b_ * c[0], a_from_b_ * c[1], a_from_b_ * c[2]};
  }
  /// Calls visit(t, u) for the triangles t of leaf i and u of leaf j until it returns false.
  template <typename Visit>
  void forEachPair(int i, int j, const Visit& visit) const {
    const auto& m = first(i);
    const auto& n = second(j);
    for (int s = m.first; s < m.first + m.count; ++s) {
      for (int t = n.first; t < n.first + n.count; ++t) {
        if (!visit(a_.tree().order()[s], b_.tree().order()[t])) return;
      }
    }
  }

  const BvhModel<BV>& a_;       ///< the first model
  const BvhModel<BV>& b_;       ///< the second model
  Eigen::Isometry3d a_from_b_;  ///< pose of b
};

}  // namespace swept
