// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "planning/planning.hpp"

namespace swept {

/// What decides during planning which motions are valid.
struct Validator {
  enum class Kind : std::uint8_t {
    Certified,  ///< CertifiedMotionValidator: proven free
    Discrete,   ///< OMPL's DiscreteMotionValidator over this library's check of states
    Fcl,        ///< the same over FCL's
  };
  Kind kind = Kind::Certified;
  /// Longest step between checked states, as a share of the space's maximum extent.
  /// Meaningless for Certified.
  double resolution = 0.0;

  /// `certified`, `discrete:0.01`, `fcl:0.01`: one way to write each.
  std::string name() const;
};

/// Throws UsageError for anything but `certified`, `discrete:R` and `fcl:R`, for `fcl:R` without
/// FCL in this build or with a margin (m) above 0.
Validator readValidator(const std::string& text, double margin);

/// The space information that a planner needs, with the validator. `statesChecked` counts the
/// states that planner and validator check one by one. It must outlive the setup. Any number of
/// threads may use it.
SetupMaker setupMaker(const Validator& validator, std::atomic<std::uint64_t>& statesChecked);

}  // namespace swept
