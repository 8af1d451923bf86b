// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace swept::detail {

/// Bounds on what a child process may take.
struct ChildLimits {
  unsigned seconds;     ///< CPU time; and at most kWallPerCpu times as long by the clock
  std::uint64_t bytes;  ///< of memory, more than this process has
};
inline constexpr unsigned kWallPerCpu = 10;

/// A child that did not come to its end; what() says how it ended: `crashed (signal 6)`.
struct ChildError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs `work` in a copy of this process and returns what it returned. Whatever it does to its
/// memory, its threads and itself stays there; it is silent. Exceptions of `work` are a ChildError,
/// too; it has to catch those that matter. Throws std::system_error where no process can be made.
std::string runInChild(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace swept::detail
