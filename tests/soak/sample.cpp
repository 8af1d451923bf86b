// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

#include <utility>

namespace soak {

void SampleQueue::push(Sample sample) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return samples_.size() < capacity_; });
  samples_.push_back(std::move(sample));
  changed_.notify_all();
}

std::optional<Sample> SampleQueue::pop() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !samples_.empty() || closed_; });
  if (samples_.empty()) return std::nullopt;
  Sample sample = std::move(samples_.front());
  samples_.pop_front();
  changed_.notify_all();
  return sample;
}

void SampleQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

}  // namespace soak
