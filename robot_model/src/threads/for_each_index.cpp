// SPDX-License-Identifier: BSD-3-Clause
#include "threads/for_each_index.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace swept::detail {

void forEachIndex(std::size_t count, unsigned threads,
                  const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> failures(count);
  const auto some = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    }
  };
  const unsigned wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
  {
    std::vector<std::jthread> others;
    others.reserve(std::min<std::size_t>(wanted, count));
    try {
      for (std::size_t i = 1; i < std::min<std::size_t>(wanted, count); ++i)
        others.emplace_back(some);
    } catch (const std::system_error&) {
      // No more threads are available.
    }
    some();
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace swept::detail
