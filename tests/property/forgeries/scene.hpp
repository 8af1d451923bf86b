// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "random.hpp"

namespace forgeries {

using Json = nlohmann::ordered_json;

/// A path file without a proof: a robot of up to three joints of any kind, of which one may mimic
/// another, one or two bodies on it and one or two in the world, of all kinds of shapes, and two or
/// three states. Of some the states are points of a trajectory, and in some joints have tolerances.
/// Ordinary numbers.
Json makeScene(Random& random);

/// A direction of length 1, one in three along an axis.
Json unitJson(Random& random);
/// The 12 numbers of a pose, one in three without a turn.
Json poseJson(Random& random, double farthest);

}  // namespace forgeries
