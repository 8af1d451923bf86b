// SPDX-License-Identifier: BSD-3-Clause
#include "threads/share_ranges.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace swept::detail {

namespace {

/// Arenas by their number of threads, kept from call to call: oneTBB 2021.8 leaks 7 KB of an arena
/// that is destroyed after two or more threads worked in it. There are as many as were ever used at
/// once.
class Arenas {
 public:
  using Arena = std::unique_ptr<oneapi::tbb::task_arena>;

  Arena take(unsigned threads) {
    {
      const std::lock_guard lock(mutex_);
      std::vector<Arena>& idle = idle_[threads];
      if (!idle.empty()) {
        Arena arena = std::move(idle.back());
        idle.pop_back();
        return arena;
      }
    }
    using oneapi::tbb::task_arena;
    return std::make_unique<task_arena>(threads == 0 ? task_arena::automatic
                                                     : static_cast<int>(threads));
  }
  void giveBack(unsigned threads, Arena arena) {
    const std::lock_guard lock(mutex_);
    idle_[threads].push_back(std::move(arena));
  }

 private:
  std::mutex mutex_;  ///< guards what follows
  std::map<unsigned, std::vector<Arena>> idle_;
};

/// Never destroyed: oneTBB may be destroyed first at the end of the program.
Arenas& arenas() {
  static Arenas& all = *new Arenas;
  return all;
}

/// This many threads, but no more than the program allows oneTBB: it warns about an arena that asks
/// for more.
unsigned allowed(unsigned threads) {
  using oneapi::tbb::global_control;
  const std::size_t most = global_control::active_value(global_control::max_allowed_parallelism);
  return static_cast<unsigned>(std::min<std::size_t>(threads, most));
}

}  // namespace

void shareRanges(std::size_t count, unsigned threads, const std::function<RangeWork()>& makeWork) {
  threads = allowed(threads);
  if (threads == 1 || count <= 1) {
    if (count > 0) makeWork()(0, count);
    return;
  }
  using oneapi::tbb::blocked_range;
  oneapi::tbb::enumerable_thread_specific<RangeWork> works(makeWork);
  Arenas::Arena arena = arenas().take(threads);
  arena->execute([&] {
    oneapi::tbb::parallel_for(
        blocked_range<std::size_t>(0, count),
        [&](const blocked_range<std::size_t>& some) { works.local()(some.begin(), some.end()); });
  });
  arenas().giveBack(threads, std::move(arena));
}

}  // namespace swept::detail
