// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "row.hpp"
#include "sample.hpp"

namespace extremes {

Answer judgeCollide(const Sample& sample);
Answer judgeDistance(const Sample& sample);
Answer judgeSignedDistance(const Sample& sample);
/// Of b, which moves along the normal of the touch. Nothing where the first contact is not known.
std::optional<Answer> judgeContinuous(const Sample& sample, Random& random);

}  // namespace extremes
