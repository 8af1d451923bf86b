// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <set>
#include <vector>

namespace swept::detail {

/// Orders in which robots are planned, each beside those before it, in rounds. Who found no way
/// behind some others is not planned behind all of these again.
class PriorityOrders {
 public:
  /// Of tasks, by their indices.
  using Order = std::vector<std::size_t>;

  /// `tasks`: how many there are, 1 or more. A round begins, with the tasks as they are counted.
  explicit PriorityOrders(std::size_t tasks) : tasks_(tasks) { beginRound(); }

  const Order& current() const { return order_; }
  /// Forgets what failed: with more time, or when another one waits, it may not.
  void beginRound();
  /// Another order, now that one task found no way in the current one. False: none is left in this
  /// round that promises more, or twice as many as tasks have failed.
  bool next(std::size_t failed);

 private:
  /// A task that found no way behind these.
  struct Failure {
    std::size_t task = 0;
    std::set<std::size_t> behind;
  };

  bool mayFail(std::size_t task, const std::set<std::size_t>& behind) const;
  bool mayFail(const Order& order) const;
  /// Extends the begin of an order to the first one that was not tried and may not fail.
  bool extend(Order& order, std::set<std::size_t>& taken, std::size_t& steps) const;

  std::size_t tasks_;
  Order order_;
  std::set<Order> tried_;          ///< in this round
  std::vector<Failure> failures_;  ///< likewise
};

}  // namespace swept::detail
