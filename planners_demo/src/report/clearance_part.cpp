// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "report/course_parts.hpp"

namespace swept {
namespace {

/// m. The least clearance of states in steps of a motion, ends included.
double leastOfStates(AskedMethod& method, const ReportMotion& motion, unsigned steps) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> q(motion.from.size());
  for (unsigned i = 0; i <= steps; ++i) {
    method.checker().interpolate(motion.from, motion.to,
                                 static_cast<double>(i) / static_cast<double>(steps), q);
    least = std::min(least, method.checker().clearance(q, method.workspace()));
  }
  return least;
}

struct ClearanceResult {
  double answer = 0.0;          ///< m
  std::optional<double> bound;  ///< m
  double time = 0.0;            ///< ns
};

void answer(AskedMethod& method, const ReportMotion& motion, unsigned steps,
            ClearanceResult& result) {
  if (method.method().kind != Validator::Kind::Certified) {
    result.answer = leastOfStates(method, motion, steps);
    return;
  }
  const MotionClearance clearance = method.checker().motionClearance(
      motion.from, motion.to, method.method().setting, method.workspace());
  result.answer = clearance.lower;
  result.bound = clearance.upper - clearance.lower;
}

/// Errors are against the least distance that is known to occur, which is not less than the true
/// one: what is certified is not farther off than that, and states are at least as far.
void score(LengthTally& tally, const std::vector<ClearanceResult>& results) {
  double known = std::numeric_limits<double>::infinity();
  for (const ClearanceResult& result : results)
    known = std::min(known, result.answer + result.bound.value_or(0.0));
  if (!std::isfinite(known)) return;  // no pair to check
  for (std::size_t method = 0; method < results.size(); ++method) {
    const ClearanceResult& result = results[method];
    tally.add(method, {.error = std::abs(result.answer - known), .bound = result.bound},
              result.time);
  }
}

}  // namespace

void addClearances(LengthTally& tally, std::vector<AskedMethod>& asked, const Checker& truth,
                   const std::vector<ReportMotion>& motions, const Stopwatch& stopwatch,
                   const ReportTick& tick) {
  const OmplMotions states(truth, motions);
  const std::size_t methods = tally.methods().size();  // FCL's, the last ones, are left out
  std::vector<std::vector<ClearanceResult>> results(methods,
                                                    std::vector<ClearanceResult>(motions.size()));
  const auto ask = [&](std::size_t method, std::size_t i) {
    const unsigned steps =
        asked[method].space().validSegmentCount(states.from[i].get(), states.to[i].get());
    ClearanceResult& result = results[method][i];
    result.time = stopwatch.time([&] { answer(asked[method], motions[i], steps, result); });
  };
  inTurns(methods, motions.size(), 1, ask, tick);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    std::vector<ClearanceResult> ofMotion;
    for (const std::vector<ClearanceResult>& result : results) ofMotion.push_back(result[i]);
    score(tally, ofMotion);
  }
}

}  // namespace swept
