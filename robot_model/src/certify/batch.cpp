// SPDX-License-Identifier: BSD-3-Clause
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"

#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

/// States are checked eight at a time. Ranges for threads are multiples of eight, so the groups of
/// eight do not depend on the threads.
constexpr std::size_t kTogether = 8;
constexpr std::size_t kBlocksPerTask = 16;
constexpr std::size_t kMotionsPerTask = 8;

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

/// Calls `work(begin, end, workspace)` for ranges of up to `grain` of [0, count). Leaves the
/// program's other limits on oneTBB as they are.
template <typename Work>
void forRanges(const Checker& checker, std::size_t count, std::size_t grain, unsigned threads,
               const Work& work) {
  const std::size_t ranges = (count + grain - 1) / grain;
  const auto run = [&](std::size_t first, std::size_t last, Workspace& workspace) {
    for (std::size_t i = first; i != last; ++i)
      work(i * grain, std::min(count, (i + 1) * grain), workspace);
  };
  threads = allowed(threads);
  if (threads == 1 || ranges <= 1) {
    if (ranges == 0) return;
    Workspace workspace(checker);
    return run(0, ranges, workspace);
  }
  using oneapi::tbb::blocked_range;
  oneapi::tbb::enumerable_thread_specific<Workspace> workspaces(
      [&checker] { return Workspace(checker); });
  Arenas::Arena arena = arenas().take(threads);
  arena->execute([&] {
    oneapi::tbb::parallel_for(blocked_range<std::size_t>(0, ranges),
                              [&](const blocked_range<std::size_t>& some) {
                                run(some.begin(), some.end(), workspaces.local());
                              });
  });
  arenas().giveBack(threads, std::move(arena));
}

}  // namespace

bool Checker::checkStates(PackedConfigurations states, std::span<Verdict> verdicts,
                          unsigned threads, const std::stop_token& stop) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, states, verdicts, threads] { return checkStates(states, verdicts, threads, stop); });
  }
  requireSizes(states, verdicts.size());
  const auto each = static_cast<std::size_t>(dimension());
  std::atomic<bool> all = true;
  forRanges(*this, verdicts.size(), kTogether * kBlocksPerTask, threads,
            [&](std::size_t begin, std::size_t end, Workspace& workspace) {
              const std::span<Verdict> own = verdicts.subspan(begin, end - begin);
              if (stop.stop_requested()) {
                std::ranges::fill(own, Verdict::Undecided);
                all = false;
                return;
              }
              checkStates(states.subspan(begin * each, (end - begin) * each), own, workspace);
            });
  return all;
}

bool Checker::certifyMotions(PackedConfigurations from, PackedConfigurations to,
                             std::span<MotionCertificate> certificates, MotionQuery query,
                             unsigned threads, const std::stop_token& stop) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to, certificates, query, threads] {
      return certifyMotions(from, to, certificates, query, threads, stop);
    });
  }
  requireSizes(from, certificates.size());
  requireSizes(to, certificates.size());
  const auto each = static_cast<std::size_t>(dimension());
  std::atomic<bool> all = true;
  forRanges(*this, certificates.size(), kMotionsPerTask, threads,
            [&](std::size_t begin, std::size_t end, Workspace& workspace) {
              for (std::size_t i = begin; i < end; ++i) {
                if (stop.stop_requested()) {
                  certificates[i] = {};
                  all = false;
                  continue;
                }
                certificates[i] = certifyMotion(from.subspan(i * each, each),
                                                to.subspan(i * each, each), workspace, query);
              }
            });
  return all;
}

}  // namespace swept
