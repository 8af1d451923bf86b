// SPDX-License-Identifier: BSD-3-Clause
#include "bench/edges_output.hpp"

#include <array>
#include <cstdio>
#include <numeric>

#include "output/quantile.hpp"
#include "output/terminal_text.hpp"
#include "output/text_table.hpp"

namespace swept {
namespace {

std::string fixed(double value, int digits) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value);
  return buffer.data();
}

std::string percent(std::size_t part, std::size_t whole) {
  if (whole == 0) return "-";
  return fixed(100.0 * static_cast<double>(part) / static_cast<double>(whole), 1) + " %";
}

std::string lengthCell(const EdgeSummary& summary) {
  return summary.length ? fixed(*summary.length, 1) : "all";
}

std::string verdictName(const EdgeSummary& summary) {
  return summary.verdict ? std::string(toString(*summary.verdict)) : "all";
}

std::string header(const EdgeBench& bench) {
  const double total = std::accumulate(bench.checkerTimes.begin(), bench.checkerTimes.end(), 0.0);
  return escapedLine(bench.robot + ", group " + bench.group) + ": " +
         countedText(bench.results.size(), "motion") + " in the worlds of " +
         countedText(bench.checkerTimes.size(), "problem") + "\nrobot loaded in " +
         secondsText(bench.loadTime) + ", " + countedText(bench.checkerTimes.size(), "checker") +
         " built in " + secondsText(total) + " (mean " + secondsText(mean(bench.checkerTimes)) +
         ")\ntimes: ns per motion, the least of " +
         countedText(static_cast<std::size_t>(bench.passes), "pass", "passes") +
         ", less the clock's own " + fixed(bench.clockOverhead, 1) + " ns\n";
}

std::string tiersText(const std::vector<EdgeSummary>& summaries) {
  TextTable table({{"length", true},
                   {"verdict"},
                   {"motions", true},
                   {"median", true},
                   {"mean", true},
                   {"p95", true},
                   {"lanes", true},
                   {"tier 1", true},
                   {"tier 2", true},
                   {"undecided", true}});
  for (const EdgeSummary& s : summaries)
    table.add({lengthCell(s), verdictName(s), std::to_string(s.edges), fixed(s.median, 0),
               fixed(s.mean, 0), fixed(s.p95, 0), fixed(s.lanes, 1),
               percent(s.singlePrecision, s.edges), percent(s.exact, s.edges),
               percent(s.undecided, s.edges)});
  return table.text();
}

std::string fclText(const std::vector<EdgeSummary>& summaries) {
  TextTable table({{"length", true},
                   {"verdict"},
                   {"motions", true},
                   {"mean", true},
                   {"FCL + OMPL mean", true},
                   {"ratio", true},
                   {"collisions missed", true},
                   {"false collisions", true}});
  for (const EdgeSummary& s : summaries) {
    const double fclMean = s.fclMean.value_or(0.0);
    table.add({lengthCell(s), verdictName(s), std::to_string(s.edges), fixed(s.mean, 0),
               fixed(fclMean, 0), s.mean > 0.0 ? fixed(fclMean / s.mean, 1) : "-",
               std::to_string(s.fclMissed), std::to_string(s.fclOnly)});
  }
  return "\nFCL (BVHModel<OBBRSS>) under OMPL's DiscreteMotionValidator at 1 % of the space's "
         "extent:\n" +
         table.text();
}

bool withFcl(const EdgeBench& bench) {
  return !bench.results.empty() && bench.results.front().fcl.has_value();
}

Json timeOrNull(const EdgeSummary& summary, double time) {
  return summary.edges > 0 ? Json(time) : Json(nullptr);
}

Json summaryJson(const EdgeSummary& s, bool fcl) {
  Json json;
  json["length"] = s.length ? Json(*s.length) : Json("all");
  json["verdict"] = verdictName(s);
  json["edges"] = s.edges;
  json["median_ns"] = s.median;
  json["mean_ns"] = s.mean;
  json["p95_ns"] = s.p95;
  json["lanes"] = s.lanes;
  json["tiers"] = {{"tier_1", s.singlePrecision}, {"tier_2", s.exact}, {"undecided", s.undecided}};
  json["fcl_mean_ns"] = s.fclMean ? Json(*s.fclMean) : Json(nullptr);
  json["fcl_missed"] = fcl ? Json(s.fclMissed) : Json(nullptr);
  json["fcl_only"] = fcl ? Json(s.fclOnly) : Json(nullptr);
  return json;
}

}  // namespace

std::string benchText(const EdgeBench& bench) {
  const std::vector<EdgeSummary> summaries = summarise(bench.results);
  return header(bench) + tiersText(summaries) + (withFcl(bench) ? fclText(summaries) : "");
}

Json benchJson(const EdgeBench& bench) {
  const bool fcl = withFcl(bench);
  const EdgeSummary all = summariseVerdict(bench.results, {});
  Json json = {
      {"robot", bench.robot},
      {"group", bench.group},
      {"margin", bench.margin},
      {"margin_self", bench.selfMargin},
      {"margin_world", bench.worldMargin},
      {"tolerance", bench.tolerance},
      {"passes", bench.passes},
      {"clock_overhead_ns", bench.clockOverhead},
      {"load_s", bench.loadTime},
      {"checkers", bench.checkerTimes.size()},
      {"build_s", std::accumulate(bench.checkerTimes.begin(), bench.checkerTimes.end(), 0.0)},
      {"build_mean_s", mean(bench.checkerTimes)},
      {"edges", all.edges}};
  for (const Verdict verdict : {Verdict::Free, Verdict::Collision, Verdict::Undecided}) {
    const EdgeSummary summary = summariseVerdict(bench.results, verdict);
    const std::string name(toString(verdict));
    json[name] = summary.edges;
    json[name + "_mean_ns"] = timeOrNull(summary, summary.mean);
  }
  Json total = summaryJson(all, fcl);
  for (const char* key : {"length", "verdict", "edges"}) total.erase(key);
  json.update(total);
  json["by_length"] = Json::array();
  for (const EdgeSummary& summary : summarise(bench.results))
    json["by_length"].push_back(summaryJson(summary, fcl));
  return json;
}

}  // namespace swept
