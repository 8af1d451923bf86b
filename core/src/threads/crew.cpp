// SPDX-License-Identifier: BSD-3-Clause
#include "threads/crew.hpp"

#include <algorithm>
#include <exception>
#include <utility>

namespace swept::detail {

unsigned threadsFor(std::size_t count, std::size_t each) {
  const std::size_t useful = std::max<std::size_t>(count / each, 1);
  return static_cast<unsigned>(
      std::min<std::size_t>(std::max(std::thread::hardware_concurrency(), 1U), useful));
}

Crew::Crew(unsigned threads) {
  const unsigned wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
  try {
    for (unsigned i = 1; i < wanted; ++i) others_.emplace_back([this] { serve(); });
  } catch (const std::exception&) {
    // No more threads, or memory for them, are available.
  }
}

Crew::~Crew() {
  {
    const std::lock_guard lock(mutex_);
    isOver_ = true;
  }
  given_.notify_all();
  for (std::thread& other : others_) other.join();
}

void Crew::forPieces(std::size_t count, std::size_t each,
                     const std::function<void(std::size_t, std::size_t)>& work) {
  if (others_.empty() || count <= each) {
    for (std::size_t first = 0; first < count; first += each)
      work(first, std::min(first + each, count));
    return;
  }
  std::unique_lock lock(mutex_);
  work_ = &work;
  next_ = 0;
  count_ = count;
  each_ = each;
  given_.notify_all();
  takePieces(lock);
  done_.wait(lock, [this] { return running_ == 0; });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Crew::takePieces(std::unique_lock<std::mutex>& lock) {
  while (next_ < count_) {
    const std::size_t first = next_;
    const std::size_t last = std::min(first + each_, count_);
    next_ = last;
    ++running_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      (*work_)(first, last);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    --running_;
    if (!failure) continue;
    failure_ = failure;
    next_ = count_;
  }
  if (running_ == 0) done_.notify_one();
}

void Crew::serve() {
  std::unique_lock lock(mutex_);
  for (;;) {
    given_.wait(lock, [this] { return isOver_ || next_ < count_; });
    if (next_ >= count_) return;
    takePieces(lock);
  }
}

}  // namespace swept::detail
