// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/traversal/mesh_self_collision.hpp"

namespace swept {

template void selfCollideMesh(const BvhModel<Aabb>&, const MeshCollisionOptions&,
                              MeshCollisionResult&);
template void selfCollideMesh(const BvhModel<Obb>&, const MeshCollisionOptions&,
                              MeshCollisionResult&);
template void selfCollideMesh(const BvhModel<Rss>&, const MeshCollisionOptions&,
                              MeshCollisionResult&);
template void selfCollideMesh(const BvhModel<ObbRss>&, const MeshCollisionOptions&,
                              MeshCollisionResult&);
template void selfCollideMesh(const BvhModel<KDop<16>>&, const MeshCollisionOptions&,
                              MeshCollisionResult&);
template void selfCollideMesh(const BvhModel<KDop<18>>&, const MeshCollisionOptions&,
                              MeshCollisionResult&);
template void selfCollideMesh(const BvhModel<KDop<24>>&, const MeshCollisionOptions&,
                              MeshCollisionResult&);

}  // namespace swept
