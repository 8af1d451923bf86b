// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "output/text_output.hpp"
#include "verify/intervals.hpp"

namespace swept {

/// What came of checking a proof.
struct VerifyOutcome {
  std::string refusal;      ///< the first place where it does not hold; empty: it holds
  verify::Summary summary;  ///< where it holds

  bool holds() const { return refusal.empty(); }
};

/// A path file that has a `proof`. Throws InputError where it is none.
Json pathWithProof(const std::string& file);

/// Checks the proof of a path against the model that is in it, where there is one, and `other`,
/// which is null or another one of what has to be the same. One of them is there.
VerifyOutcome verified(const Json& path, const Json& other);

}  // namespace swept
