// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/summary_output.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace swept {
namespace {

/// `0.005 rad`, `0.001 to 0.005 rad`, of the joints that have such a tolerance; empty: none has.
std::string rangeText(const verify::Summary& summary,
                      std::optional<double> verify::JointTube::*tolerance, const char* unit) {
  std::optional<double> least, most;
  for (const auto& [joint, tube] : summary.tube) {
    if (!(tube.*tolerance)) continue;
    least = std::min(least.value_or(*(tube.*tolerance)), *(tube.*tolerance));
    most = std::max(most.value_or(*(tube.*tolerance)), *(tube.*tolerance));
  }
  if (!most) return "";
  return (*least == *most ? "" : shortNumber(*least) + " to ") + shortNumber(*most) + " " + unit;
}

}  // namespace

std::string keptText(const verify::Summary& summary) {
  if (std::isinf(summary.clearance)) return "there is no pair to check";
  const auto kept = [](const std::string& pairs, double clearance) {
    return std::isinf(clearance) ? "there is no pair " + pairs
                                 : "pairs " + pairs + " more than " + shortNumber(clearance) + " m";
  };
  return "every pair keeps more than " + shortNumber(summary.clearance) + " m; " +
         kept("with the world", summary.clearanceWorld) + ", " +
         kept("of the robot's bodies", summary.clearanceSelf);
}

std::string tubeText(const verify::Summary& summary) {
  if (summary.tube.empty()) return summary.duration ? "no tube, " : "";
  const std::string turned = rangeText(summary, &verify::JointTube::rotation, "rad");
  const std::string slid = rangeText(summary, &verify::JointTube::translation, "m");
  return "tube " + turned + (turned.empty() || slid.empty() ? "" : " and ") + slid + ", ";
}

Json outcomeJson(const VerifyOutcome& outcome) {
  if (!outcome.holds()) return {{"verified", false}, {"refusal", outcome.refusal}};
  const verify::Summary& summary = outcome.summary;
  Json json = {{"verified", true},
               {"refusal", nullptr},
               {"segments", summary.segments},
               {"pairs", summary.pairs},
               {"intervals", summary.intervals},
               {"planes", summary.planes},
               {"clearance", finiteOrNull(summary.clearance)},
               {"clearance_world", finiteOrNull(summary.clearanceWorld)},
               {"clearance_self", finiteOrNull(summary.clearanceSelf)}};
  if (summary.duration) json["duration"] = *summary.duration;
  if (!summary.moving.empty()) {
    json["moving"] = summary.moving;
    json["clock"] = {summary.clockBegin, summary.clockEnd};
  }
  for (const auto& [joint, tube] : summary.tube) {
    if (tube.rotation) json["tube"][joint]["rotation"] = *tube.rotation;
    if (tube.translation) json["tube"][joint]["translation"] = *tube.translation;
  }
  if (!summary.constraints.empty()) json["constraints"] = summary.constraints;
  json["not_checked"] = Json::object();
  for (const auto& [reason, pairs] : summary.allowed) json["not_checked"][reason] = pairs;
  return json;
}

void repeatWarnings(const Json& path, Warnings& warnings) {
  if (!path.contains("warnings") || !path["warnings"].is_array()) return;
  for (const Json& line : path["warnings"])
    if (line.is_string()) warnings.ofUnchecked(line.get<std::string>());
}

}  // namespace swept
