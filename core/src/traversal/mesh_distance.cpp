// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/traversal/mesh_distance.hpp"

namespace swept {

template MeshDistanceResult meshDistance(const BvhModel<Aabb>&, const BvhModel<Aabb>&,
                                         const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshDistanceResult meshDistance(const BvhModel<Obb>&, const BvhModel<Obb>&,
                                         const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshDistanceResult meshDistance(const BvhModel<Rss>&, const BvhModel<Rss>&,
                                         const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshDistanceResult meshDistance(const BvhModel<ObbRss>&, const BvhModel<ObbRss>&,
                                         const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshDistanceResult meshDistance(const BvhModel<KDop<16>>&, const BvhModel<KDop<16>>&,
                                         const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshDistanceResult meshDistance(const BvhModel<KDop<18>>&, const BvhModel<KDop<18>>&,
                                         const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshDistanceResult meshDistance(const BvhModel<KDop<24>>&, const BvhModel<KDop<24>>&,
                                         const Eigen::Isometry3d&, const MeshDistanceOptions&);

}  // namespace swept
