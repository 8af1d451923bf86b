// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sample.hpp"

namespace soak {

/// How many answers of which verdict, and what they took.
struct Tally {
  std::array<std::int64_t, 3> verdicts = {};  ///< by Verdict
  std::array<std::int64_t, 4> ways = {};      ///< by Way
  double oneSeconds = 0.0;                    ///< s of processor, of Way::One, drawing included

  void count(swept::Verdict verdict, Way way) {
    ++verdicts[static_cast<std::size_t>(verdict)];
    ++ways[static_cast<std::size_t>(way)];
  }
  std::int64_t all() const { return verdicts[0] + verdicts[1] + verdicts[2]; }
  double share(swept::Verdict verdict) const;  ///< in [0, 1]
  void add(const Tally& other);
};

struct StageTally {
  Tally states, motions;
  void add(const StageTally& other) {
    states.add(other.states);
    motions.add(other.motions);
  }
};

/// Empty, or what is wrong with the tally: a soak in which hardly anything is free, or in
/// collision, says little.
std::string lopsided(const std::string& what, const Tally& tally);

}  // namespace soak
