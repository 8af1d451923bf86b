// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stop_token>
#include <string>

#include "output/text_output.hpp"
#include "verify/intervals.hpp"

namespace swept {

/// The result of verifying a proof.
struct VerifyOutcome {
  std::string refusal;      ///< the first place where it does not hold; empty: it holds
  verify::Summary summary;  ///< where it holds

  bool holds() const { return refusal.empty(); }
};

/// Throws InputError unless what a file has is a path with a `proof`.
void requireProof(const Json& path, const std::string& file);
/// Reads such a file. Throws InputError for any other one.
Json pathWithProof(const std::string& file);

/// Verifies the proof of a path against the model in its file, where there is one, and against
/// `other`, where that is not null. At least one of the two must be there. The other model must be
/// the same. Throws SearchStopped soon after `stop` is requested.
VerifyOutcome verified(const Json& path, const Json& other, const std::stop_token& stop = {});

}  // namespace swept
