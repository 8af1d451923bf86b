// SPDX-License-Identifier: BSD-3-Clause
#include "priority_orders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <vector>

namespace swept {
namespace {

using detail::PriorityOrders;
using Order = PriorityOrders::Order;

/// Robots whose goals are behind each other in an aisle with one end: `places[i]` is 0 for the one
/// that has to go in first. Who comes behind one that stands nearer to the mouth finds no way.
std::optional<std::size_t> failedIn(const std::vector<std::size_t>& places, const Order& order) {
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (places[order[k]] > places[order[i]]) return order[i];
  return std::nullopt;
}

/// How many orders it took in one round; no value: none of them was right.
std::optional<std::size_t> attempts(const std::vector<std::size_t>& places) {
  PriorityOrders orders(places.size());
  std::set<Order> seen;
  while (true) {
    EXPECT_TRUE(seen.insert(orders.current()).second) << "an order twice in a round";
    const std::optional<std::size_t> failed = failedIn(places, orders.current());
    if (!failed) return seen.size();
    if (!orders.next(*failed)) return std::nullopt;
  }
}

TEST(PriorityOrders, TheOnlyOrderThatIsRightIsFoundInOneRound) {
  for (const std::size_t tasks : {1U, 2U, 3U, 4U}) {
    std::vector<std::size_t> places(tasks);
    std::iota(places.begin(), places.end(), std::size_t{0});
    do {
      EXPECT_TRUE(attempts(places)) << ::testing::PrintToString(places);
    } while (std::ranges::next_permutation(places).found);
  }
}

TEST(PriorityOrders, ManyRobotsAreMostlyInOrderInOneRound) {
  std::mt19937 random(3);
  std::vector<std::size_t> places(6);
  std::iota(places.begin(), places.end(), std::size_t{0});
  int found = 0;
  for (int i = 0; i < 100; ++i) {
    for (std::size_t k = places.size() - 1; k > 0; --k)
      std::swap(places[k], places[random() % (k + 1)]);
    if (const auto count = attempts(places)) {
      EXPECT_LE(*count, 2 * places.size());
      ++found;
    }
  }
  EXPECT_GE(found, 50);
}

TEST(PriorityOrders, WhoFailsGoesFirstAndLastWhereItWas) {
  PriorityOrders orders(3);
  EXPECT_EQ(orders.current(), (Order{0, 1, 2}));
  ASSERT_TRUE(orders.next(0));
  EXPECT_EQ(orders.current(), (Order{1, 2, 0}));
  ASSERT_TRUE(orders.next(2));
  EXPECT_EQ(orders.current(), (Order{2, 1, 0}));
  orders.beginRound();
  EXPECT_EQ(orders.current(), (Order{0, 1, 2}));
}

TEST(PriorityOrders, ARoundEndsWhereNothingIsRight) {
  // The last one never finds a way: all that can be tried has it in front, once.
  PriorityOrders orders(2);
  ASSERT_TRUE(orders.next(1));
  EXPECT_EQ(orders.current(), (Order{1, 0}));
  EXPECT_FALSE(orders.next(0));

  PriorityOrders many(5);
  std::size_t count = 1;
  while (many.next(many.current().front())) ++count;
  EXPECT_EQ(count, 10U);
}

}  // namespace
}  // namespace swept
