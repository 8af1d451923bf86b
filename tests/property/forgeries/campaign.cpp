// SPDX-License-Identifier: BSD-3-Clause
#include "campaign.hpp"

#include <algorithm>
#include <sstream>

#include "claim.hpp"
#include "judge.hpp"
#include "scene.hpp"
#include "verify/check.hpp"

namespace forgeries {
namespace {

/// Of files in which something is changed after their proof was made.
constexpr double kLate = 0.1;
/// Of files made of originals, if there are some.
constexpr double kOriginal = 0.5;

/// Two states of an original, without what came with them.
Json partOf(const Json& original, Random& random) {
  const Json& states = original["states"];
  const std::size_t i = random.below(states.size() - 1);
  Json part = {{"joint_names", original["joint_names"]},
               {"margin", original["margin"]},
               {"states", {states[i], states[i + 1]}},
               {"model", original["model"]},
               {"original", true}};
  if (!original.contains("trajectory")) return part;
  const Json& trajectory = original["trajectory"];
  part["trajectory"] = {{"variables", trajectory["variables"]},
                        {"points", {trajectory["points"][i], trajectory["points"][i + 1]}}};
  return part;
}

bool mutateOften(Json& path, Field field, Random& random) {
  for (int i = 0; i < 8; ++i)
    if (mutate(path, field, random)) return true;
  return false;
}

/// Without a pair of bodies nothing is claimed.
bool isAccepted(const Json& path) {
  try {
    return swept::verify::checkProof(path, path["model"]).pairs > 0;
  } catch (const swept::verify::Refusal&) {
    return false;
  }
}

void judgeOne(const CampaignOptions& options, std::uint64_t index, CampaignReport& report) {
  std::vector<Field> fields;
  const Json path = forge(options, index, fields);
  const bool accepted = !path.is_null() && isAccepted(path);
  ++report.files;
  report.accepted += accepted ? 1 : 0;
  for (const Field field : fields) {
    ++report.made[static_cast<std::size_t>(field)];
    report.believed[static_cast<std::size_t>(field)] += accepted ? 1 : 0;
  }
  if (!accepted) return;
  report.originals += path.contains("original") ? 1 : 0;
  for (const Json& segment : path["proof"]["segments"]) report.pairs += segment["pairs"].size();
  Random random(~options.seed, index);
  const std::string found = refutation(path, random);
  if (found.empty()) return;
  std::string text = found + "; changed:";
  for (const Field field : fields)
    text += " " + std::string(kFieldNames[static_cast<std::size_t>(field)]);
  report.failures.push_back(text + "\n    forge --seed " + std::to_string(options.seed) +
                            " --first " + std::to_string(index) + " --print");
}

}  // namespace

Json forge(const CampaignOptions& options, std::uint64_t index, std::vector<Field>& fields) {
  Random random(options.seed, index);
  const bool own = options.originals.empty() || !random.chance(kOriginal);
  Json path = own ? makeScene(random)
                  : partOf(options.originals[random.below(options.originals.size())], random);
  const bool late = random.chance(kLate);
  const std::size_t count = 1 + random.below(3);
  const auto change = [&] {
    for (std::size_t i = 0; i < count; ++i) {
      const auto field = static_cast<Field>(random.below(kFields));
      if (mutateOften(path, field, random) && std::ranges::find(fields, field) == fields.end())
        fields.push_back(field);
    }
  };
  try {
    if (!late) change();
    claimMost(path, random);
    if (late) change();
    sign(path);
  } catch (const swept::verify::Refusal&) {
    return nullptr;
  }
  return path;
}

void CampaignReport::add(const CampaignReport& other) {
  files += other.files;
  accepted += other.accepted;
  originals += other.originals;
  pairs += other.pairs;
  for (std::size_t i = 0; i < kFields; ++i) {
    made[i] += other.made[i];
    believed[i] += other.believed[i];
  }
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
}

CampaignReport runCampaign(const CampaignOptions& options) {
  CampaignReport report;
  for (std::uint64_t i = 0; i < options.count; ++i) judgeOne(options, options.first + i, report);
  return report;
}

std::string summary(const CampaignReport& report) {
  std::ostringstream out;
  out << report.files << " forged files: " << report.accepted << " accepted (" << report.pairs
      << " pairs of bodies), of which " << report.failures.size() << " are refuted";
  for (std::size_t i = 0; i < kFields; ++i)
    out << (i == 0 ? "\n  " : ", ") << kFieldNames[i] << ' ' << report.believed[i] << '/'
        << report.made[i];
  return out.str();
}

}  // namespace forgeries
