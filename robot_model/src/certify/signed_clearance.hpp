// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "certify/pair_query.hpp"

namespace swept::detail {

/// `gradient`: empty, or as many values as a configuration has.
SignedClearance signedClearance(const CheckerModel& model, std::span<const double> q,
                                std::span<double> gradient, WorkspaceData& workspace);

}  // namespace swept::detail
