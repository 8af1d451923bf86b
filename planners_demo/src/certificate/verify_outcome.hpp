// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "verify/intervals.hpp"

namespace swept {

/// What came of checking a proof.
struct VerifyOutcome {
  std::string refusal;      ///< the first place where it does not hold; empty: it holds
  verify::Summary summary;  ///< where it holds

  bool holds() const { return refusal.empty(); }
};

}  // namespace swept
