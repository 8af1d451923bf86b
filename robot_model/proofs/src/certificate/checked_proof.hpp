// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "certificate/verify_outcome.hpp"
#include "swept/proofs/path_proof.hpp"

namespace swept {

///@{
/// What callers are told of a proof; of a summary, that it holds.
CheckedProof checkedProof(const VerifyOutcome& outcome);
CheckedProof checkedProof(const verify::Summary& summary);
///@}

}  // namespace swept
