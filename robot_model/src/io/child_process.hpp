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

/// Bounds on what a child process may take for one request.
struct ChildLimits {
  unsigned seconds;     ///< CPU time; and at most kWallPerCpu times as long by the clock
  std::uint64_t bytes;  ///< of memory, more than this process had when the child was made
};
inline constexpr unsigned kWallPerCpu = 10;

/// A child that did not come to its end; what() says how it ended: `crashed (signal 6)`.
struct ChildError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs `work` in a copy of this process. Whatever it does to its memory, its threads and itself
/// stays there; it is silent. The copy is made when it is first asked, and answers one request
/// after the other, each within limits of its own. One thread uses it, and outlives it.
class ChildProcess {
 public:
  explicit ChildProcess(ChildWork work);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// What `work` returns of the request, whose parts are put together. Throws ChildError, and
  /// std::system_error where no process can be made; after either, the next request has a new
  /// process. Exceptions of `work` are a ChildError, too; it has to catch those that matter.
  std::string ask(std::span<const std::string_view> request, const ChildLimits& limits);

  /// Whether the process that would answer next has answered before.
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
