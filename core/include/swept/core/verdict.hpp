// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "swept/core/arithmetic.hpp"

namespace swept {

/// What is known about a state or a motion.
///
/// `Undecided` is zero on purpose: a result that nobody filled in is never taken for safe.
enum class Verdict : std::uint8_t {
  Undecided,  ///< closer to the margin than the tolerance; planners treat it as invalid
  Free,       ///< proven: every checked pair keeps more than the margin, rounding included
  Collision,  ///< witnessed: two points of the exact geometry are within the margin
  Violation,  ///< witnessed: a constraint of the task does not hold
};

/// `free`, `collision`, `violation` or `undecided`: as the program prints it.
constexpr std::string_view toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::Free:
      return "free";
    case Verdict::Collision:
      return "collision";
    case Verdict::Violation:
      return "violation";
    case Verdict::Undecided:
      break;
  }
  return "undecided";
}

}  // namespace swept
