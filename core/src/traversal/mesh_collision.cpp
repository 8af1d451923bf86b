// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/traversal/mesh_collision.hpp"

namespace swept {

template void collideMeshes(const BvhModel<Aabb>&, const BvhModel<Aabb>&, const Eigen::Isometry3d&,
                            const MeshCollisionOptions&, MeshCollisionResult&, FrontList*);
template void collideMeshes(const BvhModel<Obb>&, const BvhModel<Obb>&, const Eigen::Isometry3d&,
                            const MeshCollisionOptions&, MeshCollisionResult&, FrontList*);
template void collideMeshes(const BvhModel<Rss>&, const BvhModel<Rss>&, const Eigen::Isometry3d&,
                            const MeshCollisionOptions&, MeshCollisionResult&, FrontList*);
template void collideMeshes(const BvhModel<ObbRss>&, const BvhModel<ObbRss>&,
                            const Eigen::Isometry3d&, const MeshCollisionOptions&,
                            MeshCollisionResult&, FrontList*);
template void collideMeshes(const BvhModel<KDop<16>>&, const BvhModel<KDop<16>>&,
                            const Eigen::Isometry3d&, const MeshCollisionOptions&,
                            MeshCollisionResult&, FrontList*);
template void collideMeshes(const BvhModel<KDop<18>>&, const BvhModel<KDop<18>>&,
                            const Eigen::Isometry3d&, const MeshCollisionOptions&,
                            MeshCollisionResult&, FrontList*);
template void collideMeshes(const BvhModel<KDop<24>>&, const BvhModel<KDop<24>>&,
                            const Eigen::Isometry3d&, const MeshCollisionOptions&,
                            MeshCollisionResult&, FrontList*);

}  // namespace swept
