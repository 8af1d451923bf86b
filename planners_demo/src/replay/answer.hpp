// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>

#include "input/states.hpp"
#include "replay/replay_cases.hpp"

namespace swept {

/// What the library says to a case, and whether that is right.
struct Answer {
  enum class Result { Passed, Failed, Skipped };
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double lower = kNone;    ///< m, or t; none where the answer is a word
  double upper = kNone;    ///< m, or t
  double value = kNone;    ///< m, or t; without meaning where the answer is a word
  std::string text = "-";  ///< the answer
  double error = kNone;    ///< m, or t; none where the answer is a word
  double seconds = 0.0;    ///< that the question took, without loading
  Result result = Result::Failed;
  std::string reason;  ///< empty where it passed
};

Answer answerTo(const PairQuestion& question);
/// `warn`: of values taken to a limit (readState()).
Answer answerTo(const RobotQuestion& question, const Warn& warn);

}  // namespace swept
