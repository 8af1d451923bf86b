// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bv/kdop.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/obb_rss.hpp"
#include "swept/core/bv/rss.hpp"
#include "swept/core/bvh/bv_tree.hpp"
#include "swept/core/bvh/fit_rules.hpp"
#include "swept/core/bvh/model_geometry.hpp"
#include "swept/core/bvh/split_rules.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

/// How a model builds its hierarchy.
template <BoundingVolume BV>
struct BvhOptions {
  SplitFunction split = MeanSplit{};  ///< divides nodes
  /// Bounds nodes. Your own rule is used at refits too; otherwise refits use `FitToChildren`.
  FitFunction<BV> fit = defaultFit<BV>();
  int maxLeaf = 2;  ///< primitives per leaf, at least 1; 2: half the memory of 1 and faster queries
};

/// Triangles, or points with radii, with a hierarchy of bounding volumes over them. Only the
/// surface counts: nothing is inside, as in FCL (`TriangleMesh` has solids).
///
/// One thread builds and refreshes a model. Queries of a model in Built or Updated state are const
/// and may run in any number of threads.
template <BoundingVolume BV>
class BvhModel : public ModelGeometry {
 public:
  using Volume = BV;  ///< of the nodes

  /// An empty model.
  explicit BvhModel(BvhOptions<BV> options = {}) : options_(std::move(options)) {}

  /// Building -> Built. Throws std::invalid_argument without triangles or points.
  void end();
  /// Replacing -> Built.
  void endReplace(Refresh refresh = Refresh::Refit);
  /// Updating -> Updated.
  void endUpdate(Refresh refresh = Refresh::Refit);
  /// -> Empty.
  void clear();

  /// Primitives of the tree are triangle indices, or vertex indices of a point cloud.
  const BvTree<BV>& tree() const { return tree_; }
  /// Bytes, with the object itself.
  std::size_t bytes() const { return sizeof(*this) + tree_.bytes() + geometryBytes(); }

 private:
  void refresh(Refresh how);

  BvhOptions<BV> options_;
  BvTree<BV> tree_;
};

template <BoundingVolume BV>
void BvhModel<BV>::end() {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return end(); });
  }
  requireState("end", {BvhState::Building});
  requirePrimitives();
  refresh(Refresh::Rebuild);
  enter(BvhState::Built);
}

template <BoundingVolume BV>
void BvhModel<BV>::endReplace(Refresh how) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, how] { return endReplace(how); });
  }
  requireState("endReplace", {BvhState::Replacing});
  refresh(how);
  enter(BvhState::Built);
}

template <BoundingVolume BV>
void BvhModel<BV>::endUpdate(Refresh how) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, how] { return endUpdate(how); });
  }
  requireState("endUpdate", {BvhState::Updating});
  refresh(how);
  enter(BvhState::Updated);
}

template <BoundingVolume BV>
void BvhModel<BV>::clear() {
  tree_ = {};
  clearGeometry();
}

template <BoundingVolume BV>
void BvhModel<BV>::refresh(Refresh how) {
  const std::vector<Eigen::Vector3d> points = primitivePoints();
  std::span<const double> balls;
  if (isPointCloud()) balls = radii();
  const PrimitivePoints primitives{points, pointsPerPrimitive(), balls};
  if (how == Refresh::Rebuild) {
    tree_ = BvTree<BV>::build(primitives, options_.split, options_.fit, options_.maxLeaf);
  } else {
    tree_.refit(primitives, refitOf(options_.fit));
  }
}

extern template class BvhModel<Aabb>;
extern template class BvhModel<Obb>;
extern template class BvhModel<Rss>;
extern template class BvhModel<ObbRss>;
extern template class BvhModel<KDop<16>>;
extern template class BvhModel<KDop<18>>;
extern template class BvhModel<KDop<24>>;

}  // namespace swept
