// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <iostream>
#include <mutex>
#include <string>

namespace soak {

/// What disagrees, printed as it is found, by any thread: after so many only counted.
class Failures {
 public:
  explicit Failures(std::ostream& out) : out_(out) {}
  void add(const std::string& what) {
    const std::lock_guard lock(mutex_);
    if (++count_ <= kPrinted) out_ << "FAILED: " << what << std::endl;
  }
  int count() const {
    const std::lock_guard lock(mutex_);
    return count_;
  }

 private:
  static constexpr int kPrinted = 20;
  std::ostream& out_;
  mutable std::mutex mutex_;  ///< guards the stream and the count
  int count_ = 0;
};

}  // namespace soak
