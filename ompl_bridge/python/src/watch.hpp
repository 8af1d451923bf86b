// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <type_traits>
#include <utility>

/// How work ends before it is done: by Ctrl-C, by a token, or by a deadline.
namespace swept::python {

/// swept.CancellationToken: any thread may cancel it, once for all.
class CancellationToken {
 public:
  void cancel() { cancelled_ = true; }
  bool cancelled() const { return cancelled_; }

 private:
  std::atomic<bool> cancelled_ = false;
};

/// As arguments of Python: null for None.
using Token = std::shared_ptr<CancellationToken>;

/// What may end a piece of work.
class Watch {
 public:
  using Clock = std::chrono::steady_clock;

  /// `seconds`: from now on; without a value there is no deadline. `token` may be null. Throws
  /// std::invalid_argument for seconds that are negative or not a number.
  Watch(std::optional<double> seconds, std::shared_ptr<const CancellationToken> token);

  /// Throws Cancelled for a token or deadline, and the exception of a signal's handler:
  /// KeyboardInterrupt. Needs the GIL.
  void check() const;

 private:
  std::optional<Clock::time_point> end_;
  std::shared_ptr<const CancellationToken> token_;
};

/// How long one of many pieces of work took, the last time; before that, too long a time.
struct Pace {
  double seconds = 1e-3;  ///< s each
};

/// Calls work(begin, end) for consecutive ranges of 0 ... count, without the GIL, and asks `watch`
/// between them, about every 20 ms. Ranges grow at most fourfold, as some pieces take longer.
template <typename Work>
void runInRanges(std::size_t count, const Watch& watch, Pace& pace, Work&& work) {
  constexpr double kSeconds = 0.02, kGrowth = 4.0;
  for (std::size_t begin = 0; begin < count;) {
    watch.check();
    const double most = std::max(1.0, kSeconds / pace.seconds);
    const std::size_t left = count - begin;
    const std::size_t size =
        most >= static_cast<double>(left) ? left : static_cast<std::size_t>(most);
    const auto start = Watch::Clock::now();
    {
      const pybind11::gil_scoped_release others;
      work(begin, begin + size);
    }
    const std::chrono::duration<double> spent = Watch::Clock::now() - start;
    pace.seconds = std::max(spent.count() / static_cast<double>(size), pace.seconds / kGrowth);
    begin += size;
  }
}

/// Calls work(stop) on another thread, without the GIL, and returns when it has ended. Meanwhile
/// asks `watch`, every 20 ms; when that throws, `stop` is requested, work ends, and the exception
/// is thrown again. Exceptions of work are thrown, too.
void runWatched(const Watch& watch, const std::function<void(const std::stop_token&)>& work);

/// What work(stop) returns, by runWatched() without a deadline. `token` may be null.
template <typename Work>
auto watched(std::shared_ptr<const CancellationToken> token, Work&& work) {
  std::optional<std::invoke_result_t<Work, const std::stop_token&>> result;
  runWatched(Watch(std::nullopt, std::move(token)),
             [&](const std::stop_token& stop) { result.emplace(work(stop)); });
  return std::move(*result);
}

/// Calls work(stop) for all of `count` pieces at once, without the GIL: as runWatched(), but on
/// this thread where `pace` says that they take less than 2 ms, of which a thread would be 2 %.
template <typename Work>
void runBatch(std::size_t count, const Watch& watch, Pace& pace, Work&& work) {
  constexpr double kShort = 2e-3;
  watch.check();
  if (count == 0) return;
  const auto start = Watch::Clock::now();
  if (static_cast<double>(count) * pace.seconds < kShort) {
    const pybind11::gil_scoped_release others;
    work(std::stop_token());
  } else {
    runWatched(watch, work);
  }
  const std::chrono::duration<double> spent = Watch::Clock::now() - start;
  pace.seconds = spent.count() / static_cast<double>(count);
}

/// Adds swept.CancellationToken.
void bindWatch(pybind11::module_& module);

}  // namespace swept::python
