// SPDX-License-Identifier: BSD-3-Clause
#include "batch/worker_pool.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "command_line/exit_code.hpp"
#include "output/text_output.hpp"

namespace swept {
namespace {

// The longest delay until a late run is noticed or the progress line is updated.
constexpr int kTick = 100;  // ms

}  // namespace

bool WorkerPool::run(const std::vector<std::size_t>& places, int jobs, const Listener& listener) {
  waiting_.assign(places.rbegin(), places.rend());
  done_ = 0;
  while (done_ < places.size()) {
    if (Interrupt::requested()) {
      workers_.clear();
      return false;
    }
    employ(static_cast<std::size_t>(jobs));
    await(listener);
    listener.tick();
  }
  workers_.clear();
  return true;
}

/// As many workers as there is work for.
void WorkerPool::employ(std::size_t jobs) {
  const auto idle = std::ranges::count_if(
      workers_, [](const WorkerProcess& worker) { return !worker.run().has_value(); });
  auto wanted = waiting_.size() - std::min(waiting_.size(), static_cast<std::size_t>(idle));
  for (; wanted > 0 && workers_.size() < jobs; --wanted) {
    std::vector<int> others;
    for (const WorkerProcess& worker : workers_) others.push_back(worker.descriptor());
    workers_.emplace_back(
        interrupt_, [this](const WorkerLink& link) { serve(link); }, others);
  }
}

/// What a worker does, in its own process.
void WorkerPool::serve(const WorkerLink& link) const {
  Worker worker(batch_,
                [&](const std::string& line) { link.say(WorkerMessage::Kind::Warning, line); });
  link.say(WorkerMessage::Kind::Ready, "");
  while (const auto run = link.nextRun())
    link.say(WorkerMessage::Kind::Result, lineOf(resultJson(worker.run(keys_.at(*run)))));
}

void WorkerPool::await(const Listener& listener) {
  std::vector<pollfd> descriptors{{.fd = interrupt_.descriptor(), .events = POLLIN, .revents = 0}};
  for (WorkerProcess& worker : workers_) {
    if (worker.ready() && !worker.run() && !waiting_.empty()) {
      worker.give(waiting_.back());
      waiting_.pop_back();
    }
    descriptors.push_back({.fd = worker.descriptor(), .events = POLLIN, .revents = 0});
  }
  if (poll(descriptors.data(), descriptors.size(), kTick) < 0) return;  // interrupted by a signal
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    if (descriptors[i + 1].revents != 0)
      take(workers_[i], listener);
    else if (isLate(workers_[i]))
      lose(workers_[i], "stopped after " + shortNumber(hardLimit_) + " s", listener);
  }
  std::erase_if(workers_, [](const WorkerProcess& worker) { return worker.descriptor() < 0; });
}

void WorkerPool::take(WorkerProcess& worker, const Listener& listener) {
  std::vector<WorkerMessage> messages;
  const bool alive = worker.receive(messages);
  for (const WorkerMessage& message : messages) {
    switch (message.kind) {
      case WorkerMessage::Kind::Ready:
        break;
      case WorkerMessage::Kind::Warning:
        listener.warning(message.text);
        break;
      case WorkerMessage::Kind::Error:
        throw UsageError(message.text);
      case WorkerMessage::Kind::Result:
        ++done_;
        listener.done(resultOfLine(message.text));
        break;
    }
  }
  if (!alive) lose(worker, "", listener);
}

/// The worker has ended, or is killed now; then `how` is known.
void WorkerPool::lose(WorkerProcess& worker, const std::string& how, const Listener& listener) {
  const std::optional<std::size_t> run = worker.run();
  const bool wasReady = worker.ready();
  std::string ending = worker.reap(!how.empty());
  if (ending.empty()) ending = "ended with exit code 0";
  if (!wasReady) throw UsageError("a worker did not get ready, and " + ending);
  if (!run) return;
  ++done_;
  listener.done(stoppedRun(keys_.at(*run), how.empty() ? ending : how));
}

bool WorkerPool::isLate(const WorkerProcess& worker) const {
  const std::chrono::duration<double> taken = WorkerProcess::Clock::now() - worker.since();
  return worker.run().has_value() && taken.count() > hardLimit_;
}

}  // namespace swept
