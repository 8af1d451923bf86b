// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/bv/kdop.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/obb_rss.hpp"
#include "swept/core/bv/rss.hpp"

namespace swept::test {

/// Every bounding volume there is, for suites that are the same for each.
using AllVolumes = testing::Types<Aabb, Obb, Rss, ObbRss, KDop<16>, KDop<18>, KDop<24>>;

}  // namespace swept::test
