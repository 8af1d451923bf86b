// SPDX-License-Identifier: BSD-3-Clause
#include "threads/share_ranges.hpp"

namespace swept::detail {

void shareRanges(std::size_t count, unsigned /*threads*/,
                 const std::function<RangeWork()>& makeWork) {
  if (count > 0) makeWork()(0, count);
}

}  // namespace swept::detail
