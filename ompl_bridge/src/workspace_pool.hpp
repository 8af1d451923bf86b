// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "swept/robot_model/checker.hpp"

namespace swept {

/// Grows to the largest number of leases held at once and allocates nothing after that.
class WorkspacePool {
 public:
  /// Memory for one call.
  struct Scratch {
    explicit Scratch(const Checker& checker);
    Workspace workspace;
    /// Has the size of a configuration of the group.
    std::vector<double> from, to, proven, gradient;
  };
  struct Return {
    WorkspacePool* pool;
    void operator()(Scratch* scratch) const noexcept { pool->giveBack(scratch); }
  };
  using Lease = std::unique_ptr<Scratch, Return>;

  /// The checker must outlive the pool, and the pool its leases.
  explicit WorkspacePool(const Checker& checker) : checker_(checker) {}
  Lease lease();

 private:
  void giveBack(Scratch* scratch) noexcept;

  const Checker& checker_;
  /// The last workspace returned, whose memory is warm, or null: a single thread takes no lock.
  std::atomic<Scratch*> first_ = nullptr;
  std::mutex mutex_;  ///< guards the following members
  std::vector<std::unique_ptr<Scratch>> all_;
  std::vector<Scratch*> idle_;  ///< the other idle ones; the last one returned is leased first
};

}  // namespace swept
