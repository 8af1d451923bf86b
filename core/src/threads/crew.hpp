// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace swept::detail {

/// As many threads as processors, but no more than there are times `each` in `count`: to start one
/// and to wait for it takes up to 0.1 ms.
unsigned threadsFor(std::size_t count, std::size_t each);

/// Threads for several stages of work, one after the other. They end with this object, so that a
/// process that is forked afterwards lacks none.
class Crew {
 public:
  /// At most this many threads, the caller's included (0: as many as processors). If no more can be
  /// started, the existing ones do all the work.
  explicit Crew(unsigned threads);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Calls `work(first, last)` for pieces of [0, count), each of at most `each`, in any order and
  /// on any thread; if one is enough, the caller does it. Returns when all are done. If calls
  /// throw, others are left out, and one of the exceptions is thrown.
  void forPieces(std::size_t count, std::size_t each,
                 const std::function<void(std::size_t, std::size_t)>& work);

 private:
  /// Takes pieces until none is left. `lock` is held before and after.
  void takePieces(std::unique_lock<std::mutex>& lock);
  void serve();

  std::mutex mutex_;
  std::condition_variable given_, done_;
  const std::function<void(std::size_t, std::size_t)>* work_ = nullptr;
  std::size_t next_ = 0, count_ = 0, each_ = 1;
  std::size_t running_ = 0;  ///< pieces
  std::exception_ptr failure_;
  bool isOver_ = false;
  std::vector<std::thread> others_;
};

}  // namespace swept::detail
