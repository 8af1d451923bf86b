// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/util/Console.h>

#include <string>

#include "swept/robot_model/limits.hpp"

namespace swept::detail {

/// Prints to OMPL's console: `of: elbow is 2.000002 rad, 2e-06 beyond its limit 2: taken to the
/// limit`.
inline void warnOfLimit(const TakenToLimit& taken, const std::string& of) {
  OMPL_WARN("%s: %s", of.c_str(), limitRemark(taken).c_str());
}

}  // namespace swept::detail
