// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "random.hpp"

namespace forgeries {

using Json = nlohmann::ordered_json;

/// Gives the points of a trajectory the states as their positions, whatever became of these.
void takePositions(Json& path);

/// Gives a path file a proof that claims all that the checker believes: planes whose bounds are
/// what it computes itself. What it does not believe, it claims too. Throws verify::Refusal where
/// the model is refused.
void claimMost(Json& path, Random& random);

/// Makes all digests fit what the file says.
void sign(Json& path);

}  // namespace forgeries
