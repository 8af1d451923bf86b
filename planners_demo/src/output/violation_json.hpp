// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "output/text_output.hpp"
#include "swept/robot_model/task_constraint.hpp"

namespace swept {

/// `t`, `kind`, `index` in the list of its kind, `excess` (rad or m) and `text`.
Json violationJson(const ConstraintViolation& violation, const TaskConstraint& constraints);

}  // namespace swept
