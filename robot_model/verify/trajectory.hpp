// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "course.hpp"
#include "model.hpp"

namespace swept::verify {

/// Short digests of a trajectory's numbers, in the form of its points. They say which was changed;
/// those of segments say that none was.
Json pointDigests(const Json& trajectory);
/// Compares the two. Throws Refusal, which names the first number that was changed.
void requireSamePoints(const Json& claimed, const Json& trajectory, const Model& model);

/// The points of the `trajectory` of a path file: {"variables": [name, ...], "points": [{"time": s,
/// "positions": [...], "velocities": [...], "accelerations": [...]}, ...]}, the last two optional.
/// Throws Refusal unless the variables are the group's, times increase, all is finite, and no value
/// is beyond its limits at any time.
std::vector<Point> readPoints(const Json& trajectory, const Model& model);

}  // namespace swept::verify
