// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/yaml.hpp"

namespace swept::detail {

/// What a planning scene holds besides the bodies of its world. Throws InputError for what would
/// make more of the robot or of the world than is read (an octomap, padded or scaled links), and
/// warns of what else would change answers (attached objects, a moved base, allowed collisions).
void checkSceneExtras(const YamlPlace& root);

}  // namespace swept::detail
