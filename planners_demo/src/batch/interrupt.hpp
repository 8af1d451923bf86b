// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

namespace swept {

/// While it lives, the first SIGINT or SIGTERM is a request to stop, and the second ends the
/// process at once with exit code 130. A signal that was ignored before, stays so. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool requested();
  /// Readable from the request on: for poll.
  int descriptor() const;

  /// fork(), and in the child: SIGINT ignored, for a terminal sends it to all; SIGTERM and SIGABRT
  /// with their usual effect; and no way to outlive the parent (Linux only).
  pid_t forkWorker() const;
};

}  // namespace swept
