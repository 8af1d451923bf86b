// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pthread.h>
#include <sys/resource.h>

#include <atomic>
#include <stdexcept>

namespace swept::test {

/// What children of this process cost while the object lives.
class ForkCounter {
 public:
  ForkCounter() : forks_(total()), faults_(totalFaults()) {}

  int forks() const { return total() - forks_; }
  /// Pages that the system gave to children that have ended: cleared, or copied.
  long pages() const { return totalFaults() - faults_; }

 private:
  static std::atomic<int>& total() {
    static std::atomic<int> count = 0;
    static const int error = pthread_atfork([] { ++count; }, nullptr, nullptr);
    if (error != 0) throw std::runtime_error("forks cannot be counted");
    return count;
  }
  static long totalFaults() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return usage.ru_minflt;
  }

  int forks_;
  long faults_;
};

}  // namespace swept::test
