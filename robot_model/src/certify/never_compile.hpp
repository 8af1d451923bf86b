// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "certify/checker_model.hpp"

namespace swept::detail {

/// Finds the pairs of links that never meet within the limits of the robot's joints, with a small
/// budget for each: BodyPair::never. `like`: as for compileChecker; nothing is proven anew then.
void findNever(const CheckerModel* like, CheckerModel& model);

}  // namespace swept::detail
