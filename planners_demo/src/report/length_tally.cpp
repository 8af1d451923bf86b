// SPDX-License-Identifier: BSD-3-Clause
#include "report/length_tally.hpp"

#include <algorithm>
#include <utility>

#include "output/quantile.hpp"

namespace swept {

LengthTally::LengthTally(ReportPart part, std::vector<ReportMethod> methods)
    : part_(part), methods_(std::move(methods)), entries_(methods_.size()) {}

void LengthTally::add(std::size_t method, const LengthAnswer& answer, double time) {
  Entry& entry = entries_[method];
  entry.times.push_back(time);
  if (answer.missed) {
    ++entry.missed;
    return;
  }
  entry.errors.push_back(answer.error);
  if (answer.bound) entry.bounds.push_back(*answer.bound);
}

std::vector<ReportRow> LengthTally::rows() const {
  std::vector<ReportRow> rows;
  for (std::size_t i = 0; i < methods_.size(); ++i) {
    const Entry& entry = entries_[i];
    if (entry.times.empty()) continue;
    std::vector<double> times = entry.times;
    std::ranges::sort(times);
    LengthErrors error;
    error.missed = entry.missed;
    if (!entry.errors.empty()) {
      error.mean = mean(entry.errors);
      error.largest = std::ranges::max(entry.errors);
    }
    if (!entry.bounds.empty()) {
      error.meanBound = mean(entry.bounds);
      error.largestBound = std::ranges::max(entry.bounds);
    }
    rows.push_back({.part = part_,
                    .method = methods_[i],
                    .queries = times.size(),
                    .mean = mean(times),
                    .median = quantile(times, 0.5),
                    .rates = {},
                    .error = error});
  }
  return rows;
}

}  // namespace swept
