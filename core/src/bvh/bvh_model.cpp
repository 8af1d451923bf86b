// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bvh/bvh_model.hpp"

namespace swept {

template class BvhModel<Aabb>;
template class BvhModel<Obb>;
template class BvhModel<Rss>;
template class BvhModel<ObbRss>;
template class BvhModel<KDop<16>>;
template class BvhModel<KDop<18>>;
template class BvhModel<KDop<24>>;

}  // namespace swept
