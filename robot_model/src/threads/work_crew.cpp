// SPDX-License-Identifier: BSD-3-Clause
#include "threads/work_crew.hpp"

#include <system_error>
#include <utility>

namespace swept::detail {

WorkCrew::WorkCrew(unsigned threads) {
  constexpr std::size_t kMostPerThread = 4;
  const unsigned wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
  try {
    for (unsigned i = 1; i < wanted; ++i) others_.emplace_back([this] { workUntilNoneIsLeft(); });
  } catch (const std::system_error&) {
    // No more threads are available.
  }
  most_ = kMostPerThread * others_.size();
}

WorkCrew::~WorkCrew() {
  {
    const std::lock_guard lock(mutex_);
    isAll_ = true;
  }
  given_.notify_all();
  workUntilNoneIsLeft();
  for (std::thread& other : others_) other.join();
}

void WorkCrew::give(std::function<void()> work) {
  bool tooMany = false;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(work));
    tooMany = waiting_.size() > most_;
  }
  given_.notify_one();
  if (!tooMany) return;
  if (const std::function<void()> first = nextAtOnce()) first();
}

void WorkCrew::workUntilNoneIsLeft() {
  while (const std::function<void()> work = next()) work();
}

std::function<void()> WorkCrew::next() {
  std::unique_lock lock(mutex_);
  given_.wait(lock, [this] { return isAll_ || !waiting_.empty(); });
  if (waiting_.empty()) return {};
  std::function<void()> work = std::move(waiting_.front());
  waiting_.pop_front();
  return work;
}

std::function<void()> WorkCrew::nextAtOnce() {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return {};
  std::function<void()> work = std::move(waiting_.front());
  waiting_.pop_front();
  return work;
}

}  // namespace swept::detail
