// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "batch/interrupt.hpp"

namespace swept {

/// The kinds of messages from a worker.
struct WorkerMessage {
  enum class Kind : char {
    Ready = 'r',    ///< takes runs from now on
    Warning = 'w',  ///< for the user
    Error = 'e',    ///< cannot work at all; the text is for the user
    Result = 'd',   ///< of a run it was given: a line of a results file
  };
  Kind kind = Kind::Ready;
  std::string text;
};

/// The worker's end of the line to its parent.
class WorkerLink {
 public:
  explicit WorkerLink(int socket) : socket_(socket) {}

  /// Sends a message. Ends the process when the parent has closed its end. A result has no line
  /// breaks.
  void say(WorkerMessage::Kind kind, const std::string& text) const;
  /// Waits for the next run; none: there will be no more.
  std::optional<std::size_t> nextRun() const;

 private:
  int socket_;
};

/// A worker in a process of its own, seen from its parent. Its stdout and stderr go nowhere.
class WorkerProcess {
 public:
  using Clock = std::chrono::steady_clock;
  using Life = std::function<void(const WorkerLink&)>;

  /// Call it while the process has one thread. An exception that leaves `life` becomes an Error.
  /// `others` are descriptors that the child has to close. Throws UsageError when no process can be
  /// created.
  WorkerProcess(const Interrupt& interrupt, const Life& life, std::span<const int> others);
  /// Kills it if it still runs.
  ~WorkerProcess();
  WorkerProcess(WorkerProcess&& other) noexcept;
  WorkerProcess& operator=(WorkerProcess&& other) noexcept;

  int descriptor() const { return socket_; }
  bool ready() const { return ready_; }
  /// The worker's current run, as a place in the list that both know.
  std::optional<std::size_t> run() const { return run_; }
  Clock::time_point since() const { return since_; }

  void give(std::size_t run);
  void giveNoMore() const;
  /// The complete messages that have come. Blocks when there is nothing to read. False: the worker
  /// has ended.
  bool receive(std::vector<WorkerMessage>& messages);
  /// Waits for its end, and kills it before if that is asked for. Returns, for example, `stopped by
  /// signal 9`; empty when it ended normally.
  std::string reap(bool killFirst);

 private:
  pid_t pid_ = -1;
  int socket_ = -1;
  bool ready_ = false;
  std::optional<std::size_t> run_;
  Clock::time_point since_ = Clock::now();
  std::string unread_;
};

}  // namespace swept
