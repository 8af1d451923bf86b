// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/json_value.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

/// Whether readReplayShape() knows this `type`.
bool isReplayShape(const std::string& type);

/// A shape of a case; planners_demo/README.md has the format. Throws InputError.
Shape readReplayShape(const JsonValue& shape);

}  // namespace swept
