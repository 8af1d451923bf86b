// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

namespace swept::detail {

/// Pairs of pieces put off, the nearest first. Of a fixed size: what finds no room is looked at
/// right away, in an order that is merely less good.
class WaitingPairs {
 public:
  struct Pair {
    float lower;  ///< m, proven distance
    int placeA;
    int placeB;
  };
  bool isFull() const { return count_ == kMost; }
  bool isEmpty() const { return count_ == 0; }
  void push(const Pair& pair) {
    pairs_[count_++] = pair;
    std::push_heap(pairs_.begin(), pairs_.begin() + count_, isFarther);
  }
  Pair pop() {
    std::pop_heap(pairs_.begin(), pairs_.begin() + count_, isFarther);
    return pairs_[--count_];
  }

 private:
  static constexpr int kMost = 1024;
  static bool isFarther(const Pair& a, const Pair& b) { return a.lower > b.lower; }
  std::array<Pair, kMost> pairs_;
  int count_ = 0;
};

}  // namespace swept::detail
