// SPDX-License-Identifier: BSD-3-Clause
#include "output/progress.hpp"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

namespace swept {
namespace {

using Clock = std::chrono::steady_clock;

// Shorter waits are not worth a line that flickers.
constexpr auto kInterval = std::chrono::milliseconds(200);
// Back to the first column, then erase to the end of the line.
constexpr const char* kWipe = "\r\033[K";

/// `45 s`, `3 min 20 s`, `2 h 5 min`.
std::string durationText(double seconds) {
  const auto whole = std::llround(seconds);
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

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

ProgressBar::ProgressBar(std::string what, std::size_t before, std::size_t total, bool quiet)
    : what_(std::move(what)),
      before_(before),
      total_(total),
      shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (!drawn_) return;
  std::fputs(kWipe, stderr);
  std::fflush(stderr);
}

void ProgressBar::draw(std::size_t done) {
  const Clock::time_point now = Clock::now();
  if (!shown_ || now - drawn_.value_or(begin_) < kInterval) return;
  drawn_ = now;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  std::fprintf(stderr, "%s%s", kWipe, progressText(what_, before_, done, total_, elapsed).c_str());
  std::fflush(stderr);
}

std::string progressText(const std::string& what, std::size_t before, std::size_t done,
                         std::size_t total, double elapsed) {
  constexpr std::size_t kWidth = 30;
  const std::size_t filled = total == 0 ? 0 : kWidth * done / total;
  std::string text = "[" + std::string(filled, '#') + std::string(kWidth - filled, '.') + "] ";
  text.append(std::to_string(done)).append(" of ").append(std::to_string(total)).append(" ");
  text.append(what).append(", ").append(std::to_string(total == 0 ? 0 : 100 * done / total));
  text.append(" %");
  if (done <= before) return text;
  const double perOne = elapsed / static_cast<double>(done - before);
  return text + ", " + durationText(perOne * static_cast<double>(total - done)) + " left";
}

}  // namespace swept
