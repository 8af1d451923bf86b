// SPDX-License-Identifier: BSD-3-Clause
#include "memory.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace soak {

namespace {

constexpr double kMebibyte = 1024.0 * 1024.0;  // bytes
constexpr double kWarmUp = 0.1;                // of the soak
constexpr std::size_t kQuarter = MemoryReadings::kReadings / 4;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

double residentMebibytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0, resident = 0;  // pages
  if (!(in >> total >> resident)) throw std::runtime_error("/proc/self/statm cannot be read");
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / kMebibyte;
}

double heapMebibytes() {
  const auto counts = mallinfo2();
  return static_cast<double>(counts.uordblks + counts.hblkhd) / kMebibyte;
}

bool MemoryReadings::due(double share) const {
  if (readings_.size() == kReadings) return false;
  const double next = static_cast<double>(readings_.size() + 1) / kReadings;
  return share >= kWarmUp + (1 - kWarmUp) * next;
}

double MemoryReadings::largest() const {
  return readings_.empty() ? 0.0 : *std::ranges::max_element(readings_);
}

std::optional<double> MemoryReadings::growth() const {
  if (readings_.size() < kReadings) return std::nullopt;
  const auto quarter = [&](std::size_t i) {
    const auto begin = readings_.begin() + static_cast<std::ptrdiff_t>(i * kQuarter);
    return median({begin, begin + kQuarter});
  };
  return quarter(3) - quarter(1);
}

std::string grown(const std::string& what, const MemoryReadings& memory, double allowed) {
  const std::optional<double> growth = memory.growth();
  if (!growth || *growth <= allowed) return "";
  return what + " grows by " + std::to_string(*growth) + " MiB, and " + std::to_string(allowed) +
         " are allowed";
}

}  // namespace soak
