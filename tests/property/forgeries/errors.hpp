// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "exact.hpp"
#include "random.hpp"

namespace forgeries {

/// Errors of all joints at t, each nearly as large as `tracking` allows: no sliding joint is beyond
/// its limits. Without `tracking`: none.
Errors drawErrors(const Json& path, const ExactMotion& motion, const Real& t, Random& random);

}  // namespace forgeries
