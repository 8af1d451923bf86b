// SPDX-License-Identifier: BSD-3-Clause
#include "bench/edges_summary.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "output/quantile.hpp"

namespace swept {
namespace {

double roundedLength(double length) {
  return std::round(10.0 * length) / 10.0;
}

EdgeSummary summaryOf(const std::vector<EdgeResult>& results, std::optional<double> length,
                      std::optional<Verdict> verdict) {
  EdgeSummary summary;
  summary.length = length;
  summary.verdict = verdict;
  std::vector<double> times, lanes, fcl;
  for (const EdgeResult& result : results) {
    if (length && roundedLength(result.length) != *length) continue;
    if (verdict && result.verdict != *verdict) continue;
    ++summary.edges;
    times.push_back(result.nanoseconds);
    lanes.push_back(static_cast<double>(result.effort.lanes));
    if (result.verdict == Verdict::Undecided)
      ++summary.undecided;
    else
      ++(result.effort.intervals == 0 ? summary.singlePrecision : summary.exact);
    if (result.fcl) fcl.push_back(result.fcl->nanoseconds);
    summary.fclMissed += result.missedByFcl() ? 1 : 0;
    summary.fclOnly += result.onlyByFcl() ? 1 : 0;
  }
  std::ranges::sort(times);
  summary.median = quantile(times, 0.5);
  summary.mean = mean(times);
  summary.p95 = quantile(times, 0.95);
  summary.lanes = mean(lanes);
  if (!fcl.empty()) summary.fclMean = mean(fcl);
  return summary;
}

}  // namespace

std::vector<EdgeSummary> summarise(const std::vector<EdgeResult>& results) {
  std::set<double> lengths;
  for (const EdgeResult& result : results) lengths.insert(roundedLength(result.length));
  std::vector<std::optional<double>> groups(lengths.begin(), lengths.end());
  groups.emplace_back();
  std::vector<EdgeSummary> summaries;
  for (const std::optional<double>& length : groups) {
    for (const Verdict verdict : {Verdict::Free, Verdict::Collision, Verdict::Undecided}) {
      EdgeSummary summary = summaryOf(results, length, verdict);
      if (summary.edges > 0) summaries.push_back(summary);
    }
    summaries.push_back(summaryOf(results, length, {}));
  }
  return summaries;
}

EdgeSummary summariseVerdict(const std::vector<EdgeResult>& results,
                             std::optional<Verdict> verdict) {
  return summaryOf(results, {}, verdict);
}

}  // namespace swept
