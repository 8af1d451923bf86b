// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace swept::detail {

/// A set of numbers that is emptied in constant time.
class Stamps {
 public:
  void resize(std::size_t count) { stamps_.resize(count, 0); }
  void clear() {
    if (++now_ != 0) return;
    std::fill(stamps_.begin(), stamps_.end(), 0);
    now_ = 1;
  }
  void insert(std::uint32_t number) { stamps_[number] = now_; }
  bool contains(std::uint32_t number) const { return stamps_[number] == now_; }
  std::size_t bytes() const { return stamps_.capacity() * sizeof(std::uint32_t); }

 private:
  std::vector<std::uint32_t> stamps_;
  std::uint32_t now_ = 1;
};

}  // namespace swept::detail
