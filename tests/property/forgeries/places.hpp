// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "random.hpp"

namespace forgeries {

using Json = nlohmann::ordered_json;

/// A number that takes the digits from others: of few bits, or of all.
double large(Random& random);
/// Of a list; null: it is empty.
Json* any(Json& list, Random& random);
/// Of any body of a path file; null: it has none.
Json* anyShape(Json& path, Random& random);
std::string typeOf(const Json& joint);
/// Whether a joint's one value follows a variable.
bool isSingle(const Json& joint);

}  // namespace forgeries
