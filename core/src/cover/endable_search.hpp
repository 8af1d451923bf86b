// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/enclosing_spheres.hpp"

namespace swept::detail {

/// What a search works on. A call that ends by an exception leaves pieces here and there, so no
/// later call may find anything.
template <typename Fit>
struct EndableSearch {
  Fit fit;
  bool isOver = false;

  template <typename Question>
  auto ask(const Question& question) {
    requireWhole();
    isOver = true;
    auto answer = question(fit);
    isOver = false;
    return answer;
  }
  void requireWhole() const {
    if (isOver) throw SearchStopped();
  }
};

}  // namespace swept::detail
