// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/verdict.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {

/// What the program returns, for every subcommand.
enum class ExitCode : int {
  Free = 0,       ///< free, solved, all cases passed, or nothing to judge
  Collision = 1,  ///< collision, a constraint that does not hold, not solved, or a case failed
  Undecided = 2,
  BadInput = 3,
  Interrupted = 130,  ///< a batch that a signal ended before it was done
};

constexpr ExitCode exitCodeOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::Free:
      return ExitCode::Free;
    case Verdict::Collision:
    case Verdict::Violation:
      return ExitCode::Collision;
    case Verdict::Undecided:
      break;
  }
  return ExitCode::Undecided;
}

/// Several results, one code: a collision outweighs what is undecided, and that outweighs free.
constexpr ExitCode worse(ExitCode a, ExitCode b) {
  const auto rank = [](ExitCode code) {
    switch (code) {
      case ExitCode::Free:
        return 0;
      case ExitCode::Undecided:
        return 1;
      case ExitCode::Collision:
        return 2;
      case ExitCode::BadInput:
      case ExitCode::Interrupted:
        break;
    }
    return 3;
  };
  return rank(a) < rank(b) ? b : a;
}

}  // namespace swept
