// SPDX-License-Identifier: BSD-3-Clause
#include "watch.hpp"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "errors.hpp"

namespace py = pybind11;

namespace swept::python {

Watch::Watch(std::optional<double> seconds, std::shared_ptr<const CancellationToken> token)
    : token_(std::move(token)) {
  if (!seconds) return;
  if (!(*seconds >= 0.0)) throw std::invalid_argument("seconds: expected a number of at least 0");
  constexpr double kForever = 1e9;
  if (*seconds < kForever)
    end_ = Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*seconds));
}

void Watch::check() const {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (token_ && token_->cancelled()) throw Cancelled("cancelled by its token");
  if (end_ && Clock::now() >= *end_) throw Cancelled("the time was up before the work was done");
}

void runWatched(const Watch& watch, const std::function<void(const std::stop_token&)>& work) {
  constexpr std::chrono::milliseconds kBetween(20);
  std::stop_source stop;
  std::mutex mutex;
  std::condition_variable ended;
  bool done = false;
  std::exception_ptr failure, interruption;
  watch.check();
  {
    const py::gil_scoped_release others;
    std::thread worker([&] {
      try {
        work(stop.get_token());
      } catch (...) {
        failure = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      done = true;
      ended.notify_one();
    });
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, kBetween, [&] { return done; })) {
      if (interruption) continue;
      lock.unlock();
      {
        const py::gil_scoped_acquire own;
        try {
          watch.check();
        } catch (...) {
          interruption = std::current_exception();
          stop.request_stop();
        }
      }
      lock.lock();
    }
    lock.unlock();
    worker.join();
  }
  if (interruption) std::rethrow_exception(interruption);
  if (failure) std::rethrow_exception(failure);
}

void bindWatch(py::module_& module) {
  py::class_<CancellationToken, std::shared_ptr<CancellationToken>>(
      module, "CancellationToken",
      "Ends the work that was started with it, from any thread: the call raises swept.Cancelled.")
      .def(py::init<>(), "A token that is not cancelled.")
      .def("cancel", &CancellationToken::cancel, "Ends all work with this token, now and later.")
      .def_property_readonly("cancelled", &CancellationToken::cancelled,
                             "Whether cancel() was called.")
      .def("__repr__", [](const CancellationToken& token) {
        return std::string("CancellationToken(cancelled=") +
               (token.cancelled() ? "True)" : "False)");
      });
}

}  // namespace swept::python
