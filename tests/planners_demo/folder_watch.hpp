// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

#include "batch.hpp"

/// Sees what a program writes while it writes it, on machines of any speed.
namespace swept::test {

/// Wakes at each change in a folder; made before the program starts, it misses none.
class FolderWatch {
 public:
  explicit FolderWatch(const std::string& folder);
  ~FolderWatch();
  FolderWatch(const FolderWatch&) = delete;
  FolderWatch& operator=(const FolderWatch&) = delete;

  /// Until `condition` holds, which is asked after each change; false when it still does not once
  /// the program has ended, or after half a minute.
  template <typename Condition>
  bool waitFor(const RunningProgram& program, const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition()) {
      if (program.ended() || std::chrono::steady_clock::now() > end) return condition();
      waitForChange();
    }
    return true;
  }

 private:
  /// For a moment at most: the program may end without one.
  void waitForChange();

  int descriptor_;
};

}  // namespace swept::test
