// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

namespace soak {

/// How far the soak is, for all its threads.
class Progress {
 public:
  Progress(std::int64_t checks, std::int64_t updates) : checks_(checks), updates_(updates) {}

  void checked(std::int64_t count) { checked_ += count; }
  /// Of all checks, in [0, 1].
  double share() const { return static_cast<double>(checked_) / static_cast<double>(checks_); }

  void updated() { ++updated_; }
  /// Updates of the world are spread evenly over the checks.
  bool updateDue() const { return updated_ < due(); }
  /// Checks have to wait, or there would be fewer updates than were asked for.
  bool updatesLate() const { return updated_ + kLate < due(); }

  void stop() { stopped_ = true; }
  bool stopped() const { return stopped_; }

 private:
  static constexpr std::int64_t kLate = 16;
  std::int64_t due() const {
    return static_cast<std::int64_t>(share() * static_cast<double>(updates_));
  }

  const std::int64_t checks_, updates_;
  std::atomic<std::int64_t> checked_{0}, updated_{0};
  std::atomic<bool> stopped_{false};
};

}  // namespace soak
