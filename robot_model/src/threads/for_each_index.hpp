// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace swept::detail {

/// Calls `work(i)` once for each i of [0, count), the least first, on at most this many threads,
/// including the caller's (0: as many as processors). If no more threads can be started, the
/// existing ones do all the work. All calls are made even if some throw; then the exception of the
/// least i is thrown.
///
/// For one-time work, when a robot is loaded or a first Checker is made. oneTBB, which Checker's
/// batches use, keeps its threads for the next call, and a process that is forked afterwards lacks
/// them: `swept bench planners` forks its workers once the robot is loaded. The threads of this
/// function end with the call.
void forEachIndex(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& work);

}  // namespace swept::detail
