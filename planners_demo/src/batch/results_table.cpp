// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_table.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "output/quantile.hpp"
#include "output/text_table.hpp"

namespace swept {
namespace {

using Place = std::tuple<std::string, std::string, std::string>;

void add(TableRow& row, const RunResult& run) {
  ++row.runs;
  row.stopped += run.status == kStopped ? 1 : 0;
  if (!run.path) return;
  ++row.solved;
  row.certified += run.path->certified ? 1 : 0;
  row.withMissed += run.path->missedCollisions > 0 ? 1 : 0;
  row.missed += run.path->missedCollisions;
  row.undecided += run.path->undecided;
  row.lengths.push_back(run.path->length);
  if (run.times) row.times.push_back(run.times->planning);
}

void addRows(std::vector<TableRow>& rows,
             const std::map<Place, std::vector<const RunResult*>>& by) {
  for (const auto& [place, runs] : by) {
    TableRow row;
    std::tie(row.set, row.planner, row.validator) = place;
    for (const RunResult* run : runs) add(row, *run);
    std::ranges::sort(row.times);
    std::ranges::sort(row.lengths);  // a mean does not depend on the order then
    rows.push_back(std::move(row));
  }
}

std::string share(int part, int whole) {
  return std::to_string(part) + "/" + std::to_string(whole);
}

Json orNull(bool known, double value) {
  return known ? Json(value) : Json(nullptr);
}

}  // namespace

std::vector<TableRow> tableRows(const std::vector<RunResult>& runs) {
  std::map<Place, std::vector<const RunResult*>> bySet, total;
  std::vector<std::string> sets;
  for (const RunResult& run : runs) {
    bySet[{run.key.set, run.key.planner, run.key.validator}].push_back(&run);
    total[{"total", run.key.planner, run.key.validator}].push_back(&run);
    if (std::ranges::find(sets, run.key.set) == sets.end()) sets.push_back(run.key.set);
  }
  std::vector<TableRow> rows;
  addRows(rows, bySet);
  if (sets.size() > 1) addRows(rows, total);
  return rows;
}

std::string tableText(const std::vector<TableRow>& rows) {
  TextTable table({{"set"},
                   {"planner"},
                   {"validator"},
                   {"solved", true},
                   {"certified", true},
                   {"with missed collisions", true},
                   {"stopped", true},
                   {"median", true},
                   {"mean", true},
                   {"p95", true},
                   {"path length", true}});
  for (const TableRow& row : rows) {
    const auto seconds = [&](double time) { return row.times.empty() ? "-" : secondsText(time); };
    table.add({row.set, row.planner, row.validator, share(row.solved, row.runs),
               share(row.certified, row.solved), share(row.withMissed, row.solved),
               std::to_string(row.stopped), seconds(quantile(row.times, 0.5)),
               seconds(mean(row.times)), seconds(quantile(row.times, 0.95)),
               row.lengths.empty() ? "-" : shortNumber(mean(row.lengths))});
  }
  return table.text();
}

Json tableJson(const std::vector<TableRow>& rows) {
  Json json = Json::array();
  for (const TableRow& row : rows)
    json.push_back({{"set", row.set},
                    {"planner", row.planner},
                    {"validator", row.validator},
                    {"runs", row.runs},
                    {"solved", row.solved},
                    {"certified", row.certified},
                    {"with_missed_collisions", row.withMissed},
                    {"missed_collisions", row.missed},
                    {"undecided", row.undecided},
                    {"stopped", row.stopped},
                    {"median", orNull(!row.times.empty(), quantile(row.times, 0.5))},
                    {"mean", orNull(!row.times.empty(), mean(row.times))},
                    {"p95", orNull(!row.times.empty(), quantile(row.times, 0.95))},
                    {"path_length", orNull(!row.lengths.empty(), mean(row.lengths))}});
  return json;
}

}  // namespace swept
