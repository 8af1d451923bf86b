// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace swept::detail {

/// Calls `work(i)` once for each i of [0, count), the least first, on at most so many threads, this
/// one included (0: as many as there are processors). Where no more can be started, those that
/// there are do it all. All are called even where some throw; then the exception of the least i is
/// thrown.
///
/// For what is done once, as a robot is loaded or a first Checker is made. oneTBB, which Checker's
/// batches use, keeps its threads for the next call, and a process that is forked then goes without
/// them: `swept bench planners` forks its workers once the robot is loaded. These end with the
/// call.
void forEachIndex(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& work);

}  // namespace swept::detail
