// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace soak {

/// MiB of memory that the process has in RAM (Linux: /proc/self/statm). Throws std::runtime_error
/// where it cannot be read.
double residentMebibytes();
/// MiB that the program has asked for and not given back (glibc's count; 0 under sanitizers, which
/// bring a heap of their own). What is resident beyond it is the heap's own, free or in pieces.
double heapMebibytes();

/// Readings at evenly spaced moments of a soak, after a tenth of it in which memory may grow:
/// pools, arenas and threads' stacks become as large as they need to be.
class MemoryReadings {
 public:
  static constexpr std::size_t kReadings = 20;

  /// Whether the next reading is due when so much of the soak, in [0, 1], is done.
  bool due(double share) const;
  void add(double mebibytes) { readings_.push_back(mebibytes); }
  const std::vector<double>& readings() const { return readings_; }
  double largest() const;  ///< MiB; 0 without readings
  /// MiB that the median of the last quarter of the readings is above that of the second quarter;
  /// nothing unless all are there. A median, as versions of a world that happen to be alive at one
  /// moment are no growth.
  std::optional<double> growth() const;

 private:
  std::vector<double> readings_;
};

/// Empty, or a complaint: it grows by more MiB than are allowed.
std::string grown(const std::string& what, const MemoryReadings& memory, double allowed);

}  // namespace soak
