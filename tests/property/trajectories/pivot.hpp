// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "stage.hpp"

namespace trajectories {

/// A configuration for a curve to pass: anywhere; or on the way between one that is free and one
/// that is not, just before the tube meets something, or just before the robot itself does.
std::vector<double> makePivot(const Stage& stage, swept::Workspace& workspace,
                              swept::Workspace& plainWorkspace, Random& random);

}  // namespace trajectories
