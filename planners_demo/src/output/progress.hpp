// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace swept {

/// One line on stderr that shows the present work and its duration. It is redrawn while this object
/// lives and wiped at its end. Shows nothing unless stderr is a terminal.
class Progress {
 public:
  Progress(std::string label, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Any thread.
  void setLabel(std::string label);

 private:
  void redrawUntilStopped();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::string label_;
  bool stop_ = false;
  std::thread thread_;
};

/// A bar on stderr for counted work. It shows how much is done and how long the rest will take. It
/// has no thread: it is drawn on request, at most a few times a second, and wiped at its end. Shows
/// nothing unless stderr is a terminal.
class ProgressBar {
 public:
  /// `what` is counted, for example `runs`. `before` of `total` were done already, at no cost.
  ProgressBar(std::string what, std::size_t before, std::size_t total, bool quiet);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void draw(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  std::size_t before_, total_;
  bool shown_;
  Clock::time_point begin_ = Clock::now();
  std::optional<Clock::time_point> drawn_;
};

/// For example `[#####.....] 50 of 100 runs, 50 %, 1 min 20 s left`. It leaves out the time left if
/// none were done in `elapsed` s. `done` is at most `total`.
std::string progressText(const std::string& what, std::size_t before, std::size_t done,
                         std::size_t total, double elapsed);

}  // namespace swept
