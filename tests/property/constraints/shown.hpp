// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "case.hpp"

namespace swept {
class Checker;
}

namespace constraints {

/// Whether the checker of proofs shows the constraints, from what a file would have of them. It
/// cannot say of curves whose pieces are no controller's.
std::optional<bool> isShown(const Case& of, const swept::Checker& checker,
                            std::span<const int> order);

}  // namespace constraints
