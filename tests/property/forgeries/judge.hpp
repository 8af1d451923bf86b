// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "exact.hpp"
#include "random.hpp"

namespace forgeries {

/// What exact arithmetic finds untrue in the proof of a path file that was accepted; empty:
/// nothing. Of every interval it looks at the ends, the middle and some times between, and at
/// errors that the joints may have there: each two elements need a plane that separates them by its
/// bound, and the bound has to be above the margin. Of solid meshes it looks where bodies are at
/// the beginning.
std::string refutation(const Json& path, Random& random);

/// m. How far the elements of two bodies are apart along a direction from a to b, in the frame of
/// the link that carries both, at t on a segment. `errors`: draws what joints are off; null: none
/// is.
Real separation(const Json& path, std::size_t segment, const std::string& a, const std::string& b,
                const Json& direction, double t, Random* errors = nullptr);
/// m. How far the elements of a are from a wall of b, on its side 1 or -1.
Real wallSeparation(const Json& path, std::size_t segment, const std::string& a,
                    const std::string& b, std::size_t wall, int side, double t,
                    Random* errors = nullptr);

}  // namespace forgeries
