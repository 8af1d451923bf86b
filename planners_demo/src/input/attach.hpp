// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "command_line/arguments.hpp"
#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// `carried`, and behind it what --attach puts on links: `SHAPE@LINK` or `SHAPE@LINK:X,Y,Z` or with
/// a quaternion behind. A shape is `box:X,Y,Z`, `sphere:R`, `cylinder:R,L` or a mesh file; it is
/// called by its type or by the file's stem, with a number behind from the second of one name on.
/// Throws UsageError, and InputError for a mesh that cannot be used.
std::vector<AttachedBody> attachedBodies(const Arguments& args, const Robot& robot,
                                         const LoadOptions& options,
                                         std::vector<AttachedBody> carried);

}  // namespace swept
