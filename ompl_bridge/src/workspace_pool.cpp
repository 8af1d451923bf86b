// SPDX-License-Identifier: BSD-3-Clause
#include "workspace_pool.hpp"

#include <utility>

namespace swept {

WorkspacePool::Scratch::Scratch(const Checker& checker)
    : workspace(checker),
      from(checker.dimension()),
      to(checker.dimension()),
      proven(checker.dimension()),
      gradient(checker.dimension()) {}

WorkspacePool::Lease WorkspacePool::lease() {
  if (Scratch* first = first_.exchange(nullptr, std::memory_order_acquire)) {
    return {first, Return{this}};
  }
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      Scratch* scratch = idle_.back();
      idle_.pop_back();
      return {scratch, Return{this}};
    }
  }
  auto fresh = std::make_unique<Scratch>(checker_);  // slow: not under the lock
  const std::lock_guard lock(mutex_);
  idle_.reserve(all_.size() + 1);  // so that giveBack never allocates
  all_.push_back(std::move(fresh));
  return {all_.back().get(), Return{this}};
}

void WorkspacePool::giveBack(Scratch* scratch) noexcept {
  Scratch* before = first_.exchange(scratch, std::memory_order_acq_rel);
  if (before == nullptr) return;
  const std::lock_guard lock(mutex_);
  idle_.push_back(before);
}

}  // namespace swept
