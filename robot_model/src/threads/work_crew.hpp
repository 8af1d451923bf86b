// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace swept::detail {

/// Threads that process a queue of work, first in, first out. They end with this object, for the
/// same reason as those of forEachIndex end with the call.
class WorkCrew {
 public:
  /// At most this many threads, including the one that adds work (0: as many as processors). If no
  /// more can be started, the existing ones do all the work.
  explicit WorkCrew(unsigned threads);
  /// Waits until all work is done.
  ~WorkCrew();
  WorkCrew(const WorkCrew&) = delete;
  WorkCrew& operator=(const WorkCrew&) = delete;

  /// Adds work, which must not throw. Only one thread adds; it does some work itself if much is
  /// waiting, so that the queue takes little memory.
  void give(std::function<void()> work);

 private:
  void workUntilNoneIsLeft();
  /// Takes waiting work; empty: there is none, and no more will come.
  std::function<void()> next();
  /// The same, but does not wait for more.
  std::function<void()> nextAtOnce();

  std::mutex mutex_;
  std::condition_variable given_;
  std::deque<std::function<void()>> waiting_;
  bool isAll_ = false;
  std::size_t most_ = 0;  ///< largest number that may wait
  std::vector<std::thread> others_;
};

}  // namespace swept::detail
