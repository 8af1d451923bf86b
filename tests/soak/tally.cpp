// SPDX-License-Identifier: BSD-3-Clause
#include "tally.hpp"

namespace soak {

namespace {

constexpr double kLeastShare = 0.1;

}  // namespace

double Tally::share(swept::Verdict verdict) const {
  const auto count = static_cast<double>(verdicts[static_cast<std::size_t>(verdict)]);
  return all() == 0 ? 0.0 : count / static_cast<double>(all());
}

void Tally::add(const Tally& other) {
  for (std::size_t i = 0; i < verdicts.size(); ++i) verdicts[i] += other.verdicts[i];
  for (std::size_t i = 0; i < ways.size(); ++i) ways[i] += other.ways[i];
  oneSeconds += other.oneSeconds;
}

std::string lopsided(const std::string& what, const Tally& tally) {
  for (const swept::Verdict verdict : {swept::Verdict::Free, swept::Verdict::Collision}) {
    if (tally.all() > 0 && tally.share(verdict) < kLeastShare)
      return "of the " + what + " only " + std::to_string(100 * tally.share(verdict)) + " % are " +
             std::string(toString(verdict)) + ", and there should be 10 %";
  }
  return "";
}

}  // namespace soak
