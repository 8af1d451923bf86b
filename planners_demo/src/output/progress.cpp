// SPDX-License-Identifier: BSD-3-Clause
#include "output/progress.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <utility>

namespace swept {
namespace {

using Clock = std::chrono::steady_clock;

// Shorter waits are not worth a line that flickers.
constexpr auto kInterval = std::chrono::milliseconds(200);
// Back to the first column, then erase to the end of the line.
constexpr const char* kWipe = "\r\033[K";

}  // namespace

Progress::Progress(std::string label, bool quiet) : label_(std::move(label)) {
  if (!quiet && isatty(STDERR_FILENO) == 1) thread_ = std::thread([this] { redrawUntilStopped(); });
}

Progress::~Progress() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Progress::setLabel(std::string label) {
  const std::lock_guard lock(mutex_);
  label_ = std::move(label);
}

void Progress::redrawUntilStopped() {
  const auto begin = Clock::now();
  std::unique_lock lock(mutex_);
  bool drawn = false;
  while (!wake_.wait_for(lock, kInterval, [this] { return stop_; })) {
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    std::fprintf(stderr, "%s%s (%.1f s)", kWipe, label_.c_str(), seconds);
    std::fflush(stderr);
    drawn = true;
  }
  if (drawn) std::fputs(kWipe, stderr);
  std::fflush(stderr);
}

}  // namespace swept
