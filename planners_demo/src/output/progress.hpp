// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace swept {

/// One line on stderr that says what is going on and for how long, redrawn while it lives and wiped
/// at its end. Shows nothing unless stderr is a terminal.
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

}  // namespace swept
