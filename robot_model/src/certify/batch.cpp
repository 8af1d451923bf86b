// SPDX-License-Identifier: BSD-3-Clause
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"

#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

/// States are looked at eight at a time; so the ranges that threads get are multiples of eight, and
/// which states are looked at together does not depend on the threads.
constexpr std::size_t kTogether = 8;
constexpr std::size_t kBlocksPerTask = 16;
constexpr std::size_t kMotionsPerTask = 8;

/// Arenas by their number of threads, kept from call to call: of one that is destroyed after two or
/// more threads worked in it, oneTBB 2021.8 does not give 7 KB back. There are as many as were ever
/// used at once.
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

/// Never destroyed: at the end of the program oneTBB may be gone before.
Arenas& arenas() {
  static Arenas& all = *new Arenas;
  return all;
}

/// Calls `work(begin, end, workspace)` for ranges of up to `grain` of [0, count).
template <typename Work>
void forRanges(const Checker& checker, std::size_t count, std::size_t grain, unsigned threads,
               const Work& work) {
  using oneapi::tbb::global_control;
  // More than there are processors, if somebody asks for it.
  std::optional<global_control> more;
  if (threads > 0) more.emplace(global_control::max_allowed_parallelism, threads);
  const std::size_t ranges = (count + grain - 1) / grain;
  oneapi::tbb::enumerable_thread_specific<Workspace> workspaces(
      [&checker] { return Workspace(checker); });
  Arenas::Arena arena = arenas().take(threads);
  arena->execute([&] {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, ranges),
                              [&](const oneapi::tbb::blocked_range<std::size_t>& some) {
                                Workspace& workspace = workspaces.local();
                                for (std::size_t i = some.begin(); i != some.end(); ++i)
                                  work(i * grain, std::min(count, (i + 1) * grain), workspace);
                              });
  });
  arenas().giveBack(threads, std::move(arena));
}

}  // namespace

void Checker::checkStates(PackedConfigurations states, std::span<Verdict> verdicts,
                          unsigned threads) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, states, verdicts, threads] { return checkStates(states, verdicts, threads); });
  }
  requireSizes(states, verdicts.size());
  const auto each = static_cast<std::size_t>(dimension());
  forRanges(*this, verdicts.size(), kTogether * kBlocksPerTask, threads,
            [&](std::size_t begin, std::size_t end, Workspace& workspace) {
              checkStates(states.subspan(begin * each, (end - begin) * each),
                          verdicts.subspan(begin, end - begin), workspace);
            });
}

void Checker::certifyMotions(PackedConfigurations from, PackedConfigurations to,
                             std::span<MotionCertificate> certificates, MotionQuery query,
                             unsigned threads) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to, certificates, query, threads] {
      return certifyMotions(from, to, certificates, query, threads);
    });
  }
  requireSizes(from, certificates.size());
  requireSizes(to, certificates.size());
  const auto each = static_cast<std::size_t>(dimension());
  forRanges(*this, certificates.size(), kMotionsPerTask, threads,
            [&](std::size_t begin, std::size_t end, Workspace& workspace) {
              for (std::size_t i = begin; i < end; ++i)
                certificates[i] = certifyMotion(from.subspan(i * each, each),
                                                to.subspan(i * each, each), workspace, query);
            });
}

}  // namespace swept
