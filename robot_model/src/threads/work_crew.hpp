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

/// Threads that do what they are given, the first first. They end with this, as those of
/// forEachIndex do with the call, and for the same reason.
class WorkCrew {
 public:
  /// On at most so many threads, the one that gives included (0: as many as there are processors).
  /// Where no more can be started, those that there are do it all.
  explicit WorkCrew(unsigned threads);
  /// All that was given is done.
  ~WorkCrew();
  WorkCrew(const WorkCrew&) = delete;
  WorkCrew& operator=(const WorkCrew&) = delete;

  /// `work` must not throw. One thread gives; it does some itself where much is waiting, so that
  /// what waits takes little memory.
  void give(std::function<void()> work);

 private:
  void workUntilNoneIsLeft();
  /// Some work that waits; empty: there is none, and no more to come.
  std::function<void()> next();
  /// The same, but for what is to come.
  std::function<void()> nextAtOnce();

  std::mutex mutex_;
  std::condition_variable given_;
  std::deque<std::function<void()>> waiting_;
  bool isAll_ = false;
  std::size_t most_ = 0;  ///< that may wait
  std::vector<std::thread> others_;
};

}  // namespace swept::detail
