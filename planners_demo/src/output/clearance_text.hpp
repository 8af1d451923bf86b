// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>

#include "output/text_output.hpp"

namespace swept {

/// `0.012 m`. `clearance`: m; infinity where there is no pair.
inline std::string clearanceText(double clearance) {
  return std::isinf(clearance) ? "no pair to check" : shortNumber(clearance) + " m";
}

}  // namespace swept
