// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pthread.h>

#include <atomic>
#include <stdexcept>

namespace swept::test {

/// How many children this process has made while the object lives.
class ForkCounter {
 public:
  ForkCounter() : forks_(total()) {}

  int forks() const { return total() - forks_; }

 private:
  static std::atomic<int>& total() {
    static std::atomic<int> count = 0;
    static const int error = pthread_atfork([] { ++count; }, nullptr, nullptr);
    if (error != 0) throw std::runtime_error("forks cannot be counted");
    return count;
  }

  int forks_;
};

}  // namespace swept::test
