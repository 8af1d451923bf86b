// SPDX-License-Identifier: BSD-3-Clause
#include "batch/ranks.hpp"
#include "command_line/exit_code.hpp"

/// For builds without MPI.
namespace swept {

std::optional<int> mpiRank() {
  return {};
}

void runOnRanks(const RankedBatch&) {
  throw UsageError("this build has no MPI");
}

}  // namespace swept
