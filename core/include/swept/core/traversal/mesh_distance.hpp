// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bv/kdop.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/obb_rss.hpp"
#include "swept/core/bv/rss.hpp"
#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"
#include "swept/core/traversal/mesh_pair.hpp"
#include "swept/core/traversal/traversal.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {

/// The accuracy that a distance query may give up to save time: upper - lower <= absolute +
/// relative * upper, plus rounding.
struct MeshDistanceOptions {
  double absoluteTolerance = 0.0;  ///< m, >= 0
  double relativeTolerance = 0.0;  ///< no unit, 0 to 1
};

/// lower <= distance <= upper: `lower` is proven, rounding included, `upper` is the distance of the
/// two points. For a non-finite pose [0, infinity].
struct MeshDistanceResult {
  double lower = 0.0;                                      ///< m
  double upper = std::numeric_limits<double>::infinity();  ///< m; 0 exactly if triangles touch
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();        ///< m, a's frame
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();        ///< m, a's frame
  int triangleA = -1;                                      ///< triangle of pointA; -1: no witness
  int triangleB = -1;                                      ///< triangle of pointB
  TraversalEffort effort;                                  ///< effort of the traversal
};

/// Branch and bound: the best distance so far, and the least bound of what was dismissed.
class DistanceSearch {
 public:
  /// Starts without a bound.
  explicit DistanceSearch(const MeshDistanceOptions& options) : options_(options) {}

  /// Whether something at least `bound` away cannot matter. Remembers the bound it dismisses. Does
  /// not dismiss NaN.
  bool dismiss(double bound, double upper) {
    if (!(bound >= upper * (1.0 - options_.relativeTolerance) - options_.absoluteTolerance)) {
      return false;
    }
    lower_ = std::min(lower_, bound);
    return true;
  }
  /// `lower` (m) is proven for a pair of leaves that was tested.
  void examined(double lower) { lower_ = std::min(lower_, lower); }
  /// m; proven for everything that was dismissed or examined.
  double lower(double upper) const { return std::clamp(lower_, 0.0, upper); }

 private:
  MeshDistanceOptions options_;
  double lower_ = std::numeric_limits<double>::infinity();
};

/// The value of bvTesting for overlapping volumes: negative, so it proves nothing. It is less the
/// nearer their centres are: such volumes are visited first.
inline double rankOfOverlap(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return -1.0 / (b - a).squaredNorm();
}

/// Traversal node of two triangle models: nearest points.
template <BoundingVolume BV>
class MeshDistanceNode : public MeshPair<BV> {
 public:
  /// Throws as meshDistance does. Improves `result` if a pair is nearer.
  MeshDistanceNode(const BvhModel<BV>& a, const BvhModel<BV>& b, const Eigen::Isometry3d& a_from_b,
                   const MeshDistanceOptions& options, MeshDistanceResult& result)
      : MeshPair<BV>(a, b, a_from_b, "meshDistance"),
        search_(options),
        // Lemma: a corner placed in a's frame is off by at most 4 roundings of its coordinates' sum
        // in each coordinate.
        rounding_(inDefaultEnvironment([&] {
          return tolerance::kSupportRounding *
                 (b.extent() + a_from_b.translation().template lpNorm<1>());
        })),
        out_(result) {}

  ///@{
  /// See `DistanceTraversal`.
  double bvTesting(int i, int j) {
    ++out_.effort.bvTests;
    const BV& volume = this->first(i).volume;
    const BV& other = this->second(j).volume;
    const double bound = volume.distanceBound(other, this->a_from_b_);
    if (bound > 0.0) return bound;
    return rankOfOverlap(this->a_from_b_ * other.center(), volume.center());
  }
  void leafTesting(int i, int j) {
    this->forEachPair(i, j, [&](int t, int u) {
      ++out_.effort.leafTests;
      const TriangleDistance d =
          triangleDistance(this->a_.corners(t), this->secondCorners(u), out_.upper);
      search_.examined(d.lower - rounding_);
      if (d.upper < out_.upper) {
        out_.upper = d.upper;
        out_.pointA = d.pointA;
        out_.pointB = d.pointB;
        out_.triangleA = t;
        out_.triangleB = u;
      }
      return out_.upper > 0.0;
    });
  }
  bool canStop(double bound) { return search_.dismiss(std::max(0.0, bound), out_.upper); }
  ///@}
  /// Call it after the traversal.
  void finish() { out_.lower = search_.lower(out_.upper); }

 private:
  DistanceSearch search_;
  double rounding_;  ///< m
  MeshDistanceResult& out_;
};

/// Distance (m) of the surfaces of two models; `a_from_b` is the pose of b in a's frame. Throws
/// BvhStateError or std::invalid_argument for models that are not built or have no triangles.
template <BoundingVolume BV>
MeshDistanceResult meshDistance(const BvhModel<BV>& a, const BvhModel<BV>& b,
                                const Eigen::Isometry3d& a_from_b,
                                const MeshDistanceOptions& options = {}) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return meshDistance(a, b, a_from_b, options); });
  }
  MeshDistanceResult result;
  MeshDistanceNode<BV> node(a, b, a_from_b, options, result);
  if (!node.pose().matrix().allFinite()) return result;
  distanceTraverse(node);
  node.finish();
  return result;
}

extern template MeshDistanceResult meshDistance(const BvhModel<Aabb>&, const BvhModel<Aabb>&,
                                                const Eigen::Isometry3d&,
                                                const MeshDistanceOptions&);
extern template MeshDistanceResult meshDistance(const BvhModel<Obb>&, const BvhModel<Obb>&,
                                                const Eigen::Isometry3d&,
                                                const MeshDistanceOptions&);
extern template MeshDistanceResult meshDistance(const BvhModel<Rss>&, const BvhModel<Rss>&,
                                                const Eigen::Isometry3d&,
                                                const MeshDistanceOptions&);
extern template MeshDistanceResult meshDistance(const BvhModel<ObbRss>&, const BvhModel<ObbRss>&,
                                                const Eigen::Isometry3d&,
                                                const MeshDistanceOptions&);
extern template MeshDistanceResult meshDistance(const BvhModel<KDop<16>>&,
                                                const BvhModel<KDop<16>>&, const Eigen::Isometry3d&,
                                                const MeshDistanceOptions&);
extern template MeshDistanceResult meshDistance(const BvhModel<KDop<18>>&,
                                                const BvhModel<KDop<18>>&, const Eigen::Isometry3d&,
                                                const MeshDistanceOptions&);
extern template MeshDistanceResult meshDistance(const BvhModel<KDop<24>>&,
                                                const BvhModel<KDop<24>>&, const Eigen::Isometry3d&,
                                                const MeshDistanceOptions&);

}  // namespace swept
