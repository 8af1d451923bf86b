// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "certify/checker_model.hpp"

namespace swept::detail {

/// What a checker has compiled, for questions of this library that its public functions do not
/// offer. Lives as long as the checker.
const CheckerModel& modelOf(const Checker& checker);

}  // namespace swept::detail
