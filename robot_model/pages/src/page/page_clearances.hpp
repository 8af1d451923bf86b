// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "output/text_output.hpp"
#include "page/page_bodies.hpp"
#include "page/page_frames.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// For every `stride`-th frame and each body, the nearest body it is checked against, and a proven
/// lower bound of the distance between the two.
struct PageClearances {
  struct Table {
    std::vector<float> distance;        ///< m; infinity: not checked against anything
    std::vector<std::int32_t> partner;  ///< index of a body; -1: none
  };
  int stride = 1;  ///< larger than 1 where all frames would take too many distances
  std::size_t bodies = 0;
  Table world;  ///< of pairs with the world
  Table self;   ///< of pairs of links or attached bodies

  /// Of either, whichever is nearer.
  Table nearer() const;
  Json json() const;
};

PageClearances clearancesOf(const Checker& checker, const std::vector<PageBody>& bodies,
                            const PageFrames& frames);

}  // namespace swept
