// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace swept::detail {

/// Works on the indices from `first` up to `last`, without it.
using RangeWork = std::function<void(std::size_t first, std::size_t last)>;

/// Calls what `makeWork()` returns for ranges that together are [0, count), on up to `threads`
/// threads of oneTBB (0: as many as processors), but no more than the program allows oneTBB.
/// `makeWork` is called once for each thread that takes part, on that thread, and not at all if
/// `count` is 0. Leaves the program's other limits on oneTBB as they are.
///
/// Where there is no oneTBB, in WebAssembly, the caller's thread does all the work.
void shareRanges(std::size_t count, unsigned threads, const std::function<RangeWork()>& makeWork);

}  // namespace swept::detail
