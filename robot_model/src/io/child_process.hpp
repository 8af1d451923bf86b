// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/child_life.hpp"

namespace swept::detail {

/// Limits on the resources of a child process for one request.
struct ChildLimits {
  unsigned seconds;     ///< CPU time; and at most kWallPerCpu times as long by the clock
  std::uint64_t bytes;  ///< of memory, more than this process had when the child was made
};
inline constexpr unsigned kWallPerCpu = 10;

/// A child ended before its answer was complete; what() says how: `crashed (signal 6)`.
struct ChildError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs `work` in a copy of this process. Whatever `work` does to its memory, its threads and
/// itself stays in the copy, and it prints nothing. The first request makes the copy. It answers
/// one request after the other, each within its own limits. Use from one thread, which must outlive
/// it.
class ChildProcess {
 public:
  explicit ChildProcess(ChildWork work);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Returns what `work` returns for the request, which is the concatenation of the parts. Throws
  /// ChildError, and std::system_error where no process can be made; after either, the next request
  /// starts a new process. An exception that leaves `work` becomes a ChildError too, so `work` has
  /// to catch those that matter.
  std::string ask(std::span<const std::string_view> request, const ChildLimits& limits);

  /// Whether the process that will answer the next request has answered one before.
  bool hasAnswered() const { return answered_; }

  /// The next request has a new process.
  void end();

 private:
  class Process;
  ChildWork work_;
  std::unique_ptr<Process> process_;
  bool answered_ = false;
};

}  // namespace swept::detail
