// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// CheckerOptions::constraints in the form that robot_model/verify reads; an empty list: there are
/// none. Frames in attached bodies are those of the links that carry them.
Json constraintsJson(const Checker& checker);

/// A frame as in these: that of an attached body is in the link that carries it.
Json frameJson(const ConstraintFrame& frame, const Checker& checker);

}  // namespace swept
