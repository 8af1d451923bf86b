// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/input_source.hpp"
#include "swept/robot_model/world.hpp"

namespace swept::detail {

/// Warns (InputSource::warnOfUnchecked) of a scene without a body: who names a scene takes Free for
/// an answer about it.
void warnIfEmpty(const World& world, const InputSource& source);

}  // namespace swept::detail
