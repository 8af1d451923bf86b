// SPDX-License-Identifier: BSD-3-Clause
#include "bench/peer.hpp"

#include "bench/fcl.hpp"
#include "command_line/exit_code.hpp"

namespace swept {

void requirePeer(const Arguments& args) {
  if (args.against.empty()) return;
  if (!builtWithFcl())
    throw UsageError("--against fcl: this build has no FCL; install it and configure again");
  if (largestMargin(args) > 0.0)
    throw UsageError(
        "--against fcl needs a margin of 0: whether FCL finds a collision is not a "
        "matter of distance");
}

}  // namespace swept
