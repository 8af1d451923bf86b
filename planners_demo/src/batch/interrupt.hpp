// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

namespace swept {

/// While it lives, the first SIGINT or SIGTERM is a request to stop, and the second ends the
/// process at once with exit code 130. A signal that was ignored before stays ignored. At most one
/// object at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool requested();
  /// A descriptor for poll that is readable from the request on.
  int descriptor() const;

  /// Calls fork(). The child ignores SIGINT, which a terminal sends to all. SIGTERM and SIGABRT
  /// have their default effect in it, and it cannot outlive the parent (Linux only).
  pid_t forkWorker() const;
};

}  // namespace swept
