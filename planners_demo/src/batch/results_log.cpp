// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_log.hpp"

#include <ompl/base/PlannerStatus.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <span>

// The grammar is in OMPL's documentation of its benchmarks, "The benchmark logfile format".
namespace swept {
namespace {

using ompl::base::PlannerStatus;

std::string statusName(int value) {
  return PlannerStatus(static_cast<PlannerStatus::StatusType>(value)).asString();
}

/// `2`; empty, which is read as unknown, for no status.
std::string statusValue(const std::string& status) {
  for (int value = 0; value < PlannerStatus::TYPE_COUNT; ++value)
    if (status == statusName(value)) return std::to_string(value);
  return "";
}

/// Names have no blanks there, and those of files no slashes: `%20` instead.
std::string encoded(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-') {
      result += c;
      continue;
    }
    std::array<char, 4> code{};
    std::snprintf(code.data(), code.size(), "%%%02X", static_cast<unsigned char>(c));
    result += code.data();
  }
  return result;
}

struct Property {
  std::string name, type, value;
};

std::string logTruth(bool value) {
  return value ? "1" : "0";
}

std::string number(bool known, double value) {
  return known ? exactNumber(value) : "";
}

std::string clearanceOf(const std::optional<NearestPair>& pair) {
  return pair ? exactNumber(pair->clearance) : "";
}

/// In a fixed order; the value is empty where a run has none.
std::vector<Property> propertiesOf(const RunResult& run, bool simplified) {
  const PathFacts path = run.path.value_or(PathFacts{});
  const RunTimes times = run.times.value_or(RunTimes{});
  const bool solved = run.solved(), timed = run.times.has_value();
  const std::string prefix = simplified ? "simplified " : "";
  const auto count = [](bool known, auto value) { return known ? std::to_string(value) : ""; };
  std::vector<Property> all{
      {"approximate solution", "BOOLEAN",
       logTruth(run.status == statusName(PlannerStatus::APPROXIMATE_SOLUTION))},
      {"certification time", "REAL", number(timed && solved, times.certification)},
      {"certified", "BOOLEAN", solved ? logTruth(path.certified) : ""},
      {"certified clearance", "REAL",
       number(path.clearance.has_value(), path.clearance.value_or(0.0))},
      {"certified clearance of itself", "REAL", clearanceOf(path.self)},
      {"certified clearance of the world", "REAL", clearanceOf(path.world)},
      {"missed collisions", "INTEGER", count(solved, path.missedCollisions)},
      {"motions checked", "INTEGER",
       count(run.motionsChecked.has_value(), run.motionsChecked.value_or(0))},
      {"random seed", "INTEGER", std::to_string(run.key.seed)},
      {prefix + "solution length", "REAL", number(solved, path.length)},
      {prefix + "solution segments", "INTEGER", count(solved, path.segments)},
      {"solved", "BOOLEAN", logTruth(solved)},
      {"states checked", "INTEGER",
       count(run.statesChecked.has_value(), run.statesChecked.value_or(0))},
      {"status", "ENUM", statusValue(run.status)},
      {"time", "REAL", number(timed, times.planning)},
      {"undecided segments", "INTEGER", count(solved, path.undecided)}};
  if (simplified)
    all.push_back({"simplification time", "REAL", number(timed, times.simplification)});
  return all;
}

std::string plannerText(std::span<const RunResult> runs, bool simplified) {
  const RunKey& key = runs.front().key;
  std::string text = key.planner + "/" + key.validator +
                     "\n2 common properties\nplanner = " + key.planner +
                     "\nvalidator = " + key.validator + "\n";
  const std::vector<Property> properties = propertiesOf(runs.front(), simplified);
  text += std::to_string(properties.size()) + " properties for each run\n";
  for (const Property& property : properties) text += property.name + " " + property.type + "\n";
  text += std::to_string(runs.size()) + " runs\n";
  for (const RunResult& run : runs) {
    for (const Property& property : propertiesOf(run, simplified)) text += property.value + "; ";
    text += "\n";
  }
  return text + ".\n";
}

/// Neighbours for which `same` holds, together.
template <typename Same>
std::vector<std::span<const RunResult>> chunks(std::span<const RunResult> runs, const Same& same) {
  std::vector<std::span<const RunResult>> found;
  for (std::size_t begin = 0; begin < runs.size();) {
    std::size_t end = begin + 1;
    while (end < runs.size() && same(runs[begin].key, runs[end].key)) ++end;
    found.push_back(runs.subspan(begin, end - begin));
    begin = end;
  }
  return found;
}

std::string noteOf(const Json& header, const char* key) {
  return header.contains("time") ? header["time"].value(key, "unknown") : "unknown";
}

std::string preamble(const Json& header, const std::string& name, std::span<const RunResult> runs) {
  std::string text = "swept version " SWEPT_VERSION "\nExperiment " + name + "\nRunning on " +
                     encoded(noteOf(header, "host")) + "\nStarting at " +
                     noteOf(header, "started") + "\n<<<|\n";
  for (const auto& [field, value] : header.items())
    if (field != "time") text += field + " = " + lineOf(value) + "\n";
  return text + "|>>>\n" + std::to_string(runs.front().key.seed) + " is the random seed\n" +
         exactNumber(header["time_limit"].get<double>()) + " seconds per run\n0 MB per run\n";
}

std::string logText(const Json& header, const std::string& name, std::span<const RunResult> runs) {
  const auto planners = chunks(runs, [](const RunKey& a, const RunKey& b) {
    return a.planner == b.planner && a.validator == b.validator;
  });
  std::size_t most = 0;
  for (const auto& some : planners) most = std::max(most, some.size());
  double seconds = 0.0;
  for (const RunResult& run : runs) seconds += run.times.value_or(RunTimes{}).total();
  std::string text = preamble(header, name, runs) + std::to_string(most) + " runs per planner\n" +
                     exactNumber(seconds) +
                     " seconds spent to collect the data\n1 enum type\nstatus";
  for (int value = 0; value < PlannerStatus::TYPE_COUNT; ++value) text += "|" + statusName(value);
  text += "\n" + std::to_string(planners.size()) + " planners\n";
  const bool simplified = header["simplify"].get<bool>();
  for (const auto& some : planners) text += plannerText(some, simplified);
  return text;
}

}  // namespace

std::vector<ExperimentLog> experimentLogs(const Json& header,
                                          const std::vector<RunResult>& results) {
  std::vector<ExperimentLog> logs;
  for (const auto& runs : chunks(results, [](const RunKey&a, const RunKey&b) {
         return a.set == b.set && a.index == b.index;
       })) {
    const RunKey& key = runs.front().key;
    const std::string name = encoded(key.set) + "_" + std::to_string(key.index);
    logs.push_back({.name = name, .text = logText(header, name, runs)});
  }
  return logs;
}

}  // namespace swept
