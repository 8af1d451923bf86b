// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "world_line.hpp"

namespace soak {

/// Which function was asked.
enum class Way : std::uint8_t {
  One,      ///< checkState, certifyMotion
  Batch,    ///< checkStates with a workspace
  Threads,  ///< checkStates and certifyMotions on two threads of their own
  Bridge,   ///< isValid, checkMotion, compared with One at once
};

constexpr std::string_view toString(Way way) {
  constexpr std::string_view kNames[] = {"one by one", "in a batch", "in a batch on threads",
                                         "through OMPL"};
  return kNames[static_cast<int>(way)];
}

/// An answer to be judged, and the version that gave it.
struct Sample {
  std::shared_ptr<const Version> version;
  Way way = Way::One;
  std::vector<double> from = {};
  std::vector<double> to = {};                                  ///< empty for a state
  swept::MotionQuery query = swept::MotionQuery::FirstContact;  ///< of a motion
  /// Of a state only the verdict.
  swept::MotionCertificate answer = {};
};

/// Samples on their way from those who ask to the one who judges. Bounded, so that memory is.
class SampleQueue {
 public:
  explicit SampleQueue(std::size_t capacity) : capacity_(capacity) {}
  /// Waits while the queue is full.
  void push(Sample sample);
  /// Waits while the queue is empty; nothing once it is closed and empty.
  std::optional<Sample> pop();
  /// There will be no more.
  void close();

 private:
  const std::size_t capacity_;
  std::mutex mutex_;  ///< guards what follows
  std::condition_variable changed_;
  std::deque<Sample> samples_;
  bool closed_ = false;
};

}  // namespace soak
