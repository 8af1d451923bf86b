// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/input_source.hpp"
#include "io/robot_parts.hpp"
#include "io/srdf.hpp"
#include "io/urdf_outline.hpp"

namespace swept::detail {

/// Links, joints and variables of a checked URDF, parents first, siblings in the order of the file.
/// The virtual joint, when there is one, comes before all others. Throws InputError.
RobotParts assembleRobot(const UrdfOutline& outline, const SrdfDocument& srdf,
                         const InputSource& urdfSource, const InputSource& srdfSource);

}  // namespace swept::detail
