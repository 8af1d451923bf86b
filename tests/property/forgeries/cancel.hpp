// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "random.hpp"

namespace forgeries {

using Json = nlohmann::ordered_json;

/// Changes of a path file by which large numbers take each other back: almost nothing moves, and
/// doubles lose what is left. False where the path has nothing of the kind; Field says what each
/// is.
bool cancelOffset(Json& path, Random& random);
bool cancelValue(Json& path, Random& random);
bool cancelOrigin(Json& path, Random& random);
bool cancelBody(Json& path, Random& random);
bool cancelShape(Json& path, Random& random);
bool cancelWall(Json& path, Random& random);

}  // namespace forgeries
