// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <memory>

#include "swept/robot_model/checker.hpp"

#include "swept/core/floating_point_environment.hpp"
#include "threads/share_ranges.hpp"

namespace swept {

namespace {

/// States are checked eight at a time. Ranges for threads are multiples of eight, so the groups of
/// eight do not depend on the threads.
constexpr std::size_t kTogether = 8;
constexpr std::size_t kBlocksPerTask = 16;
constexpr std::size_t kMotionsPerTask = 8;

/// Calls `work(begin, end, workspace)` for ranges of up to `grain` of [0, count), on threads as
/// shareRanges() does.
template <typename Work>
void forRanges(const Checker& checker, std::size_t count, std::size_t grain, unsigned threads,
               const Work& work) {
  const auto makeWork = [&]() -> detail::RangeWork {
    return
        [&, workspace = std::make_shared<Workspace>(checker)](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i != last; ++i)
            work(i * grain, std::min(count, (i + 1) * grain), *workspace);
        };
  };
  detail::shareRanges((count + grain - 1) / grain, threads, makeWork);
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
