// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "swept/core/broadphase/broadphase.hpp"

namespace swept::detail {

/// Which handles are in use.
class Handles {
 public:
  /// The least that is free.
  BoxHandle take() {
    if (free_.empty()) {
      if (used_.size() >= kMost) throw std::length_error("broadphase: more than 2^30 boxes");
      used_.push_back(1);
      ++live_;
      return static_cast<BoxHandle>(used_.size() - 1);
    }
    std::pop_heap(free_.begin(), free_.end(), std::greater<>());
    const BoxHandle handle = free_.back();
    free_.pop_back();
    used_[handle] = 1;
    ++live_;
    return handle;
  }
  void giveBack(BoxHandle handle) {
    --live_;
    used_[handle] = 0;
    free_.push_back(handle);
    std::push_heap(free_.begin(), free_.end(), std::greater<>());
  }

  bool contains(BoxHandle handle) const { return handle < used_.size() && used_[handle] != 0; }
  std::size_t live() const { return live_; }
  BoxHandle end() const { return static_cast<BoxHandle>(used_.size()); }

  void require(BoxHandle handle) const {
    if (!contains(handle)) refuse(handle);
  }
  [[noreturn]] static void refuse(BoxHandle handle) {
    throw std::invalid_argument("broadphase: no box has the handle " + std::to_string(handle));
  }
  void require(std::span<const BoxHandle> handles, std::span<const Aabb> boxes) const {
    requireAsMany(handles.size(), boxes.size());
    for (const BoxHandle handle : handles) require(handle);
  }
  static void requireAsMany(std::size_t handles, std::size_t boxes) {
    if (handles == boxes) return;
    throw std::invalid_argument("broadphase: " + std::to_string(boxes) + " boxes for " +
                                std::to_string(handles) + " handles");
  }
  std::size_t bytes() const {
    return used_.capacity() * sizeof(char) + free_.capacity() * sizeof(BoxHandle);
  }

 private:
  static constexpr std::size_t kMost = std::size_t{1} << 30;
  std::vector<char> used_;
  std::vector<BoxHandle> free_;  // a heap
  std::size_t live_ = 0;
};

}  // namespace swept::detail
