// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "swept/core/arithmetic.hpp"

namespace swept::detail {

/// How often the boxes of a manager have changed. Copying or moving boxes counts for both the
/// target and the source; the number itself stays with its manager.
class ChangeCount {
 public:
  ChangeCount() = default;
  ~ChangeCount() = default;
  ChangeCount(const ChangeCount&) noexcept {}
  ChangeCount(ChangeCount&& other) noexcept { other.add(); }
  ChangeCount& operator=(const ChangeCount&) noexcept {
    add();
    return *this;
  }
  ChangeCount& operator=(ChangeCount&& other) noexcept {
    other.add();
    add();
    return *this;
  }

  void add() { ++count_; }
  std::uint64_t count() const { return count_; }

 private:
  std::uint64_t count_ = 0;
};

/// Checks that visited boxes do not change; call require() after each visitor that does not end the
/// visit.
class Unchanged {
 public:
  explicit Unchanged(const ChangeCount& changes) : changes_(changes), start_(changes.count()) {}

  /// Throws std::logic_error if the boxes have changed: boxes still to be visited may be gone.
  void require() const {
    if (changes_.count() == start_) return;
    throw std::logic_error("broadphase: a visitor has changed the boxes that it visits");
  }

 private:
  const ChangeCount& changes_;
  const std::uint64_t start_;
};

/// Memory of a scratch while a visit reads it: a visitor that queries with the same scratch gets
/// other memory. It is given back when the visit ends, in whatever way.
template <typename Item>
class Lent {
 public:
  explicit Lent(std::vector<Item>& from) : from_(from), items_(std::move(from)) {}
  ~Lent() { from_ = std::move(items_); }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;

  std::vector<Item>& items() { return items_; }

 private:
  std::vector<Item>& from_;
  std::vector<Item> items_;
};

}  // namespace swept::detail
