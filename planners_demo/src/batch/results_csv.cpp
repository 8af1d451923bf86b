// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_csv.hpp"

namespace swept {
namespace {

constexpr std::string_view kHeader =
    "set,index,planner,validator,run,seed,solved,status,failure,states_checked,motions_checked,"
    "path_length [rad or m],segments,certified,certified_clearance [m],"
    "certified_clearance_world [m],certified_clearance_self [m],missed_collisions,undecided,path,"
    "planning [s],simplification [s],certification [s]\n";

std::string truth(bool value) {
  return value ? "true" : "false";
}

std::string count(const std::optional<std::uint64_t>& value) {
  return value ? std::to_string(*value) : "";
}

std::vector<std::string> pathCells(const std::optional<PathFacts>& path) {
  if (!path) return std::vector<std::string>(9);
  return {exactNumber(path->length),
          std::to_string(path->segments),
          truth(path->certified),
          path->clearance ? exactNumber(*path->clearance) : "",
          path->world ? exactNumber(path->world->clearance) : "",
          path->self ? exactNumber(path->self->clearance) : "",
          std::to_string(path->missedCollisions),
          std::to_string(path->undecided),
          path->digest};
}

std::vector<std::string> timeCells(const std::optional<RunTimes>& times) {
  if (!times) return std::vector<std::string>(3);
  return {exactNumber(times->planning), exactNumber(times->simplification),
          exactNumber(times->certification)};
}

std::string rowOf(const RunResult& result) {
  const RunKey& key = result.key;
  std::vector<std::string> cells{csvCell(key.set),
                                 std::to_string(key.index),
                                 key.planner,
                                 key.validator,
                                 std::to_string(key.run),
                                 std::to_string(key.seed),
                                 truth(result.solved()),
                                 result.status,
                                 csvCell(result.failure),
                                 count(result.statesChecked),
                                 count(result.motionsChecked)};
  for (std::string& cell : pathCells(result.path)) cells.push_back(std::move(cell));
  for (std::string& cell : timeCells(result.times)) cells.push_back(std::move(cell));
  std::string row;
  for (std::size_t i = 0; i < cells.size(); ++i) row.append(i == 0 ? "" : ",").append(cells[i]);
  return row + "\n";
}

}  // namespace

std::string csvText(const std::vector<RunResult>& results) {
  std::string text(kHeader);
  for (const RunResult& result : results) text += rowOf(result);
  return text;
}

}  // namespace swept
