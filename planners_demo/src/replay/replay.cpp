// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <iostream>
#include <limits>

#include "command_line/commands.hpp"
#include "output/text_output.hpp"
#include "replay/replay_cases.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {
namespace {

/// s. A pair that takes longer stops a planner, however right the answer.
constexpr double kTimeLimit = 1.0;
/// Relative to a case's scale. What rounding of the case's own poses and sizes can do.
constexpr double kPoseRounding = 1e-12;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

enum class Result { Passed, Failed, Skipped };

struct Answer {
  double lower = kNone;  ///< m, or t; none for PairQuery::Collide
  double upper = kNone;  ///< m, or t
  double value = kNone;  ///< m, or t; without meaning for PairQuery::Collide
  std::string text = "-";
  double error = kNone;  ///< m, or t; none for PairQuery::Collide
  double seconds = 0.0;
  Result result = Result::Failed;
  std::string reason;
};

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
  return std::isfinite(found.upper) ? found.upper : kNone;
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
    answer.result = Result::Passed;
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
    answer.result = Result::Passed;
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
  answer.result = Result::Passed;
  if (!hit) return;
  answer.lower = found.freeUntil;
  answer.upper = found.contactBy;
  answer.value = 0.5 * (found.freeUntil + found.contactBy);
  answer.text = shortNumber(answer.value);
  answer.error = std::abs(answer.value - question.expected);
  if (answer.error <= question.tolerance) return;
  answer.result = Result::Failed;
  answer.reason = "off by more than " + shortNumber(question.tolerance);
}

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
    answer.result = Result::Failed;
    answer.reason = "took " + secondsText(answer.seconds);
  }
  return answer;
}

Answer answerTo(const ReplayCase& item) {
  if (item.question) return answerTo(*item.question);
  Answer answer;
  answer.result = Result::Skipped;
  answer.reason = item.skipReason;
  return answer;
}

std::string expectedText(const ReplayCase& item) {
  if (!item.question) return "-";
  if (item.question->isNumber()) return shortNumber(item.question->expected);
  if (item.question->query == PairQuery::FirstContact) return std::string(toString(Verdict::Free));
  if (!item.question->hits) return "either";
  return *item.question->hits ? "yes" : "no";
}

std::string resultText(const Answer& answer) {
  const std::string name = answer.result == Result::Passed   ? "ok"
                           : answer.result == Result::Failed ? "FAILED"
                                                             : "skipped";
  return answer.reason.empty() ? name : name + " (" + answer.reason + ")";
}

std::vector<std::string> rowOf(const ReplayCase& item, const Answer& answer) {
  const std::string error = std::isnan(answer.error) ? "-" : shortNumber(answer.error);
  return {item.id, item.query, answer.text, expectedText(item), error, resultText(answer)};
}

Json jsonOf(const ReplayCase& item, const Answer& answer) {
  const bool number = item.question && item.question->isNumber();
  Json json = {{"id", item.id}, {"query", item.query}};
  json["answer"] = number ? finiteOrNull(answer.value) : Json(answer.text);
  json["expected"] = number ? Json(item.question->expected) : Json(expectedText(item));
  json["error"] = finiteOrNull(answer.error);
  json["lower"] = finiteOrNull(answer.lower);
  json["upper"] = finiteOrNull(answer.upper);
  json["seconds"] = answer.seconds;
  json["result"] = answer.result == Result::Passed   ? "ok"
                   : answer.result == Result::Failed ? "failed"
                                                     : "skipped";
  json["reason"] = answer.reason;
  return json;
}

}  // namespace

ExitCode runReplay(const Arguments& args) {
  TextTable table(
      {{"id"}, {"query"}, {"answer", true}, {"expected", true}, {"error", true}, {"result"}});
  Json json = {{"cases", Json::array()}};
  int passed = 0, failed = 0, skipped = 0;
  for (const ReplayCase& item : readReplayCases(args.cases)) {
    const Answer answer = answerTo(item);
    ++(answer.result == Result::Passed   ? passed
       : answer.result == Result::Failed ? failed
                                         : skipped);
    if (args.json)
      json["cases"].push_back(jsonOf(item, answer));
    else
      table.add(rowOf(item, answer));
  }
  if (args.json) {
    json["passed"] = passed;
    json["failed"] = failed;
    json["skipped"] = skipped;
    std::cout << json.dump(2) << '\n';
  } else {
    std::cout << table.text() << passed << " passed, " << failed << " failed, " << skipped
              << " skipped\n";
  }
  return failed == 0 ? ExitCode::Free : ExitCode::Collision;
}

}  // namespace swept
