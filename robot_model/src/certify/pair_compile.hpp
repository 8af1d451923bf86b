// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept::detail {

struct CheckerModel;

/// Which pairs of the model's geometry are checked, with their margins, and the lists of pairs of
/// bodies. Throws std::invalid_argument for a rule about a body that is not there.
void compilePairs(CheckerModel& model);

}  // namespace swept::detail
