// SPDX-License-Identifier: BSD-3-Clause
#include "acm/acm_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>

#include "command_line/shell_word.hpp"
#include "output/terminal_text.hpp"
#include "output/text_table.hpp"

namespace swept {
namespace {

constexpr std::array kStatuses{PairStatus::Adjacent, PairStatus::Never,      PairStatus::Always,
                               PairStatus::Default,  PairStatus::MayCollide, PairStatus::Unknown};

std::string namesOf(const Robot& robot, const LinkPairReport& pair) {
  return robot.links()[pair.linkA].name + " - " + robot.links()[pair.linkB].name;
}

/// `joint=value, ...` for the variables that matter to the pair.
std::string witnessValues(const Robot& robot, const LinkPairReport& pair) {
  std::vector<std::string> values;
  for (const int v : pair.variables)
    values.push_back(robot.variables()[v].name + "=" + exactNumber((*pair.witness)[v]));
  return joined(values);
}

/// Without an SRDF there is one group of all joints, no pair is disabled, and no virtual joint.
std::string checkCommand(const AcmResult& result, const LinkPairReport& pair) {
  const Robot& robot = *result.model.robot;
  std::string values;
  for (std::size_t v = 0; v < robot.variables().size(); ++v) {
    if (robot.joints()[robot.variables()[v].joint].parentLink < 0) continue;
    if (!values.empty()) values += ",";
    values += exactNumber((*pair.witness)[static_cast<Eigen::Index>(v)]);
  }
  std::string command = "swept check " + shellWord(result.args.robot) + " --srdf none " + values;
  if (result.args.margin > 0.0) command += " --margin " + exactNumber(result.args.margin);
  if (result.args.xacro) command += " --xacro";
  for (const std::string& argument : result.args.xacroArguments)
    command += " --xacro-arg " + shellWord(argument);
  for (const std::string& package : result.args.packages)
    command += " --package " + shellWord(package);
  return command;
}

/// Rounded down, so that 100 % means all.
std::string percent(double share) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f %%", std::floor(1e3 * share) / 10.0);
  return text.data();
}

std::string detailOf(const AcmResult& result, const LinkPairReport& pair) {
  const Robot& robot = *result.model.robot;
  const std::string joints = std::to_string(pair.variables.size()) +
                             (pair.variables.size() == 1 ? " variable" : " variables");
  switch (pair.status) {
    case PairStatus::Adjacent:
      return "joint " + robot.joints()[pair.joint].name;
    case PairStatus::Never:
      return pair.variables.empty() ? "rigidly attached" : "proven for " + joints;
    case PairStatus::Always:
      return pair.variables.empty() ? "rigidly attached" : "in contact in all samples";
    case PairStatus::Default:
      return "in contact in the default state, not in all samples";
    case PairStatus::MayCollide:
      return "at " + witnessValues(robot, pair);
    case PairStatus::Unknown:
      break;
  }
  const std::string near =
      std::isinf(pair.nearest) ? "" : ", nearest seen " + shortNumber(pair.nearest) + " m";
  return percent(pair.proven) + " proven, for " + joints + near +
         (pair.outOfTime ? ", out of time" : "");
}

std::string pairTable(const AcmResult& result) {
  const Robot& robot = *result.model.robot;
  TextTable table({{"link"}, {"link"}, {"collision"}, {"why"}});
  for (const LinkPairReport& pair : result.pairs)
    table.add({robot.links()[pair.linkA].name, robot.links()[pair.linkB].name,
               std::string(toString(pair.status)), detailOf(result, pair)});
  return table.text();
}

std::map<PairStatus, int> countsOf(const AcmResult& result) {
  std::map<PairStatus, int> counts;
  for (const LinkPairReport& pair : result.pairs) ++counts[pair.status];
  return counts;
}

std::string timeText(const AcmResult& result) {
  const auto open = std::ranges::count_if(result.pairs, &LinkPairReport::outOfTime);
  if (open == 0) return {};
  return std::to_string(open) + (open == 1 ? " pair was" : " pairs were") + " open when the " +
         secondsText(result.limit) + " were over and " + (open == 1 ? "stays" : "stay") +
         " checked; --time gives them more\n";
}

std::string countText(const AcmResult& result) {
  std::map<PairStatus, int> counts = countsOf(result);
  std::vector<std::string> parts;
  for (const PairStatus status : kStatuses)
    parts.push_back(std::to_string(counts[status]) + " " + std::string(toString(status)));
  return std::to_string(result.pairs.size()) + (result.pairs.size() == 1 ? " pair: " : " pairs: ") +
         joined(parts) + "; " + secondsText(result.seconds) + "\n" + timeText(result);
}

std::string titleOf(AcmDisagreement::Kind kind) {
  switch (kind) {
    case AcmDisagreement::Kind::Collides:
      return "disabled in the SRDF, but may collide";
    case AcmDisagreement::Kind::Open:
      return "disabled in the SRDF, not known to be apart";
    case AcmDisagreement::Kind::InVain:
      return "checked in vain, never collide";
    case AcmDisagreement::Kind::Touching:
      return "not disabled, but in contact in the default state";
  }
  return {};
}

std::string keyOf(AcmDisagreement::Kind kind) {
  switch (kind) {
    case AcmDisagreement::Kind::Collides:
      return "disabled_but_may_collide";
    case AcmDisagreement::Kind::Open:
      return "disabled_but_unknown";
    case AcmDisagreement::Kind::InVain:
      return "checked_in_vain";
    case AcmDisagreement::Kind::Touching:
      return "not_disabled_but_touching";
  }
  return {};
}

std::string differenceText(const AcmResult& result,
                           const std::vector<AcmDisagreement>& differences) {
  const Robot& robot = *result.model.robot;
  std::string text;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const AcmDisagreement& difference = differences[i];
    if (i == 0 || differences[i - 1].kind != difference.kind)
      text += titleOf(difference.kind) + ":\n";
    std::string line = "  " + namesOf(robot, difference.pair);
    if (!difference.reason.empty()) line += " (" + difference.reason + ")";
    const bool collides = difference.kind == AcmDisagreement::Kind::Collides;
    if (collides) line += ": " + witnessValues(robot, difference.pair);
    text += escapedLine(line) + "\n";
    if (collides) text += "    " + escapedLine(checkCommand(result, difference.pair)) + "\n";
  }
  return text;
}

Json pairJson(const AcmResult& result, const LinkPairReport& pair) {
  const Robot& robot = *result.model.robot;
  Json json = {{"link_a", robot.links()[pair.linkA].name},
               {"link_b", robot.links()[pair.linkB].name},
               {"status", toString(pair.status)},
               {"proven", pair.proven},
               {"effort", pair.effort},
               {"out_of_time", pair.outOfTime},
               {"nearest", finiteOrNull(pair.nearest)}};
  json["joint"] = pair.joint < 0 ? Json(nullptr) : Json(robot.joints()[pair.joint].name);
  Json variables = Json::array();
  for (const int v : pair.variables) variables.push_back(robot.variables()[v].name);
  json["variables"] = std::move(variables);
  json["witness"] = nullptr;
  if (pair.witness) {
    Json values = Json::object();
    for (const int v : pair.variables) values[robot.variables()[v].name] = (*pair.witness)[v];
    json["witness"] = std::move(values);
  }
  return json;
}

}  // namespace

std::vector<AcmDisagreement> compareWithSrdf(const AcmResult& result) {
  std::vector<AcmDisagreement> differences;
  if (result.model.srdf.file.empty()) return differences;
  std::map<std::pair<int, int>, std::string> disabled;
  for (const DisabledPair& pair : result.model.robot->disabledPairs())
    disabled.emplace(std::minmax(pair.linkA, pair.linkB), pair.reason);
  for (const LinkPairReport& pair : result.pairs) {
    const auto off = disabled.find({pair.linkA, pair.linkB});
    const bool touches = pair.status == PairStatus::Default || pair.status == PairStatus::Always;
    using Kind = AcmDisagreement::Kind;
    if (off == disabled.end()) {
      if (pair.status == PairStatus::Never) differences.push_back({Kind::InVain, pair, ""});
      if (touches) differences.push_back({Kind::Touching, pair, ""});
    } else {
      if (pair.status == PairStatus::MayCollide)
        differences.push_back({Kind::Collides, pair, off->second});
      if (pair.status == PairStatus::Unknown)
        differences.push_back({Kind::Open, pair, off->second});
    }
  }
  std::ranges::stable_sort(differences, {}, &AcmDisagreement::kind);
  return differences;
}

std::string acmText(const AcmResult& result, const std::vector<AcmDisagreement>& differences) {
  std::string text = pairTable(result) + countText(result);
  if (!result.model.srdf.file.empty()) {
    text += "SRDF " + escapedLine(result.model.srdf.file) + ": " +
            std::to_string(result.model.robot->disabledPairs().size()) + " disabled, " +
            std::to_string(differences.size()) + " different\n";
    text += differenceText(result, differences);
  }
  if (!result.args.output.empty())
    text += "SRDF written to " + escapedLine(result.args.output) + "\n";
  return text;
}

Json acmJson(const AcmResult& result, const std::vector<AcmDisagreement>& differences) {
  const Robot& robot = *result.model.robot;
  Json json = {{"robot", robot.name()}, {"urdf", result.args.robot}};
  json["srdf"] = result.model.srdf.file.empty() ? Json(nullptr) : Json(result.model.srdf.file);
  json["margin"] = result.args.margin;
  json["seconds"] = result.seconds;
  json["time_limit"] = finiteOrNull(result.limit);
  json["counts"] = Json::object();
  std::map<PairStatus, int> counts = countsOf(result);
  for (const PairStatus status : kStatuses)
    json["counts"][std::string(toString(status))] = counts[status];
  json["pairs"] = Json::array();
  for (const LinkPairReport& pair : result.pairs) json["pairs"].push_back(pairJson(result, pair));
  json["differences"] = Json::array();
  for (const AcmDisagreement& difference : differences) {
    Json entry = {{"kind", keyOf(difference.kind)},
                  {"link_a", robot.links()[difference.pair.linkA].name},
                  {"link_b", robot.links()[difference.pair.linkB].name},
                  {"srdf_reason", difference.reason}};
    if (difference.kind == AcmDisagreement::Kind::Collides)
      entry["command"] = checkCommand(result, difference.pair);
    json["differences"].push_back(std::move(entry));
  }
  json["output"] = result.args.output.empty() ? Json(nullptr) : Json(result.args.output);
  return json;
}

}  // namespace swept
