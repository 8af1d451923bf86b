// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// Boxes of a WideBvh that a walk has yet to visit: depth first, and within a node the nearest
/// first. Begins with the root.
class PendingBoxes {
 public:
  struct Box {
    float squared;       ///< m^2, sort key of the walk
    std::int32_t child;  ///< as in WideNode
  };

  PendingBoxes() { stack_[0] = {0.0F, 0}; }

  bool isEmpty() const { return count_ == 0; }
  /// The boxes pushed until the next pop belong to one node.
  Box pop() { return stack_[first_ = --count_]; }
  void push(const Box& box) {
    int at = count_++;  // the nearest on top
    for (; at > first_ && stack_[at - 1].squared < box.squared; --at) stack_[at] = stack_[at - 1];
    stack_[at] = box;
  }

 private:
  // Each level leaves at most seven siblings to visit.
  std::array<Box, (WideNode::kLanes - 1) * WideBvh::kMaxDepth + 1> stack_;
  int count_ = 1;
  int first_ = 0;
};

}  // namespace swept::detail
