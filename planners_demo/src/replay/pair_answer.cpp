// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>

#include "output/text_output.hpp"
#include "replay/answer.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {
namespace {

/// s. A pair that takes longer stops a planner, however right the answer.
constexpr double kTimeLimit = 1.0;
/// Relative to a case's scale. What rounding of the case's own poses and sizes can do.
constexpr double kPoseRounding = 1e-12;

/// What is asked for, as the library proves it. m.
struct Interval {
  double lower;
  double upper;
};

Interval measure(const PairQuestion& question) {
  const double tolerance = std::min(tolerance::kDistance, question.tolerance);
  if (question.query == PairQuery::Distance) {
    DistanceOptions options;
    options.tolerance = tolerance;
    const DistanceResult found = distance(question.a, question.b, question.a_from_b, options);
    return {found.lower, found.upper};
  }
  const SignedDistanceResult found =
      signedDistance(question.a, question.b, question.a_from_b, tolerance);
  return {found.lower, found.upper};
}

/// The middle of the interval, or its only finite end.
double middle(const Interval& found) {
  if (std::isfinite(found.lower) && std::isfinite(found.upper))
    return found.lower + 0.5 * (found.upper - found.lower);
  if (std::isfinite(found.lower)) return found.lower;
  return std::isfinite(found.upper) ? found.upper : Answer::kNone;
}

/// Fails a NaN: it compares as false.
void answerNumber(const PairQuestion& question, Answer& answer) {
  const Interval found = measure(question);
  answer.lower = found.lower;
  answer.upper = found.upper;
  answer.value = middle(found);
  answer.text = std::isnan(answer.value) ? "none" : shortNumber(answer.value);
  answer.error = std::abs(answer.value - question.expected);
  const double slack = question.tolerance + kPoseRounding * question.scale;
  if (answer.error <= slack && std::isfinite(slack))
    answer.result = Answer::Result::Passed;
  else
    answer.reason = std::isnan(answer.value)
                        ? "no finite answer"
                        : "off by more than " + shortNumber(question.tolerance);
}

/// Where the shapes touch every answer is right, but for an exception.
void answerYesOrNo(const PairQuestion& question, Answer& answer) {
  const Contact found = collide(question.a, question.b, question.a_from_b);
  answer.text = found == Contact::Touching   ? "yes"
                : found == Contact::Separate ? "no"
                                             : "undecided";
  const Contact right = question.hits.value_or(false) ? Contact::Touching : Contact::Separate;
  if (!question.hits || found == right)
    answer.result = Answer::Result::Passed;
  else
    answer.reason = "wrong";
}

/// The middle of the times between which the first contact is proven to be.
void answerFirstContact(const PairQuestion& question, Answer& answer) {
  ContinuousOptions options;
  options.timeTolerance = question.tolerance;
  options.tolerance = kPoseRounding * question.scale;
  const ContinuousResult found =
      continuousCollide(question.a, question.motions[0], question.b, question.motions[1], options);
  const bool hit = found.verdict == Verdict::Collision;
  answer.text = std::string(toString(found.verdict));
  if (found.verdict == Verdict::Undecided || hit != question.hits) {
    answer.reason = "wrong";
    return;
  }
  answer.result = Answer::Result::Passed;
  if (!hit) return;
  answer.lower = found.freeUntil;
  answer.upper = found.contactBy;
  answer.value = 0.5 * (found.freeUntil + found.contactBy);
  answer.text = shortNumber(answer.value);
  answer.error = std::abs(answer.value - question.expected);
  if (answer.error <= question.tolerance) return;
  answer.result = Answer::Result::Failed;
  answer.reason = "off by more than " + shortNumber(question.tolerance);
}

}  // namespace

Answer answerTo(const PairQuestion& question) {
  using Clock = std::chrono::steady_clock;
  Answer answer;
  const Clock::time_point start = Clock::now();
  try {
    if (question.query == PairQuery::Collide)
      answerYesOrNo(question, answer);
    else if (question.query == PairQuery::FirstContact)
      answerFirstContact(question, answer);
    else
      answerNumber(question, answer);
  } catch (const std::exception& error) {
    answer.reason = std::string("threw: ") + error.what();
  }
  answer.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  if (answer.seconds > kTimeLimit) {
    answer.result = Answer::Result::Failed;
    answer.reason = "took " + secondsText(answer.seconds);
  }
  return answer;
}

}  // namespace swept
