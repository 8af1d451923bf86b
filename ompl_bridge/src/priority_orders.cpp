// SPDX-License-Identifier: BSD-3-Clause
#include "priority_orders.hpp"

#include <algorithm>
#include <numeric>

namespace swept::detail {

namespace {

/// Begins of orders that are looked at for the next one.
constexpr std::size_t kMostBegins = 10'000;

}  // namespace

void PriorityOrders::beginRound() {
  order_.resize(tasks_);
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  tried_.clear();
  failures_.clear();
}

bool PriorityOrders::mayFail(std::size_t task, const std::set<std::size_t>& behind) const {
  return std::ranges::any_of(failures_, [&](const Failure& failure) {
    return failure.task == task && std::ranges::includes(behind, failure.behind);
  });
}

bool PriorityOrders::mayFail(const Order& order) const {
  std::set<std::size_t> behind;
  for (const std::size_t task : order) {
    if (mayFail(task, behind)) return true;
    behind.insert(task);
  }
  return false;
}

bool PriorityOrders::extend(Order& order, std::set<std::size_t>& taken, std::size_t& steps) const {
  if (order.size() == tasks_) return !tried_.contains(order);
  for (std::size_t task = 0; task < tasks_; ++task) {
    if (taken.contains(task) || mayFail(task, taken)) continue;
    if (++steps > kMostBegins) return false;
    order.push_back(task);
    taken.insert(task);
    if (extend(order, taken, steps)) return true;
    order.pop_back();
    taken.erase(task);
  }
  return false;
}

bool PriorityOrders::next(std::size_t failed) {
  tried_.insert(order_);
  if (tried_.size() >= 2 * tasks_) return false;
  const auto at = std::ranges::find(order_, failed);
  const bool wasFirst = at == order_.begin();
  // One that fails alone may have had too little time: that says nothing of others.
  if (!wasFirst) failures_.push_back({failed, {order_.begin(), at}});
  Order other = order_;
  std::erase(other, failed);
  other.insert(wasFirst ? other.end() : other.begin(), failed);
  if (tried_.contains(other) || mayFail(other)) {
    other.clear();
    std::set<std::size_t> taken;
    std::size_t steps = 0;
    if (!extend(other, taken, steps)) return false;
  }
  order_ = std::move(other);
  return true;
}

}  // namespace swept::detail
