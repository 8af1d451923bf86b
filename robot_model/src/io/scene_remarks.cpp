// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_remarks.hpp"

namespace swept::detail {

void warnIfEmpty(const World& world, const InputSource& source) {
  // Readers refuse bodies without geometry.
  if (world.bodies().empty() && world.obstacles().empty())
    source.warnOfUnchecked(0,
                           "no body of the scene has geometry: the robot is checked in an "
                           "empty world");
}

}  // namespace swept::detail
