// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "arrays.hpp"
#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "watch.hpp"

namespace swept::python {

/// certifyPath() that `watch` may end. Call it with the GIL held; it is released meanwhile.
PathCertificate certifyTable(const Checker& checker, const Table& states, bool clearances,
                             unsigned threads, const Watch& watch);

/// Throws UsageError for a proof that was not found.
void requireWritten(const WrittenProof& written);

}  // namespace swept::python
