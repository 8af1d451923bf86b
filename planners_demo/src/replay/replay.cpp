// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <functional>
#include <iostream>

#include "command_line/commands.hpp"
#include "input/task.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/text_table.hpp"
#include "replay/answer.hpp"
#include "replay/replay_cases.hpp"

namespace swept {
namespace {

Answer answerTo(const ReplayCase& item, const Warn& warn) {
  if (item.pair) return answerTo(*item.pair);
  if (item.robot) return answerTo(*item.robot, warn);
  Answer answer;
  answer.result = Answer::Result::Skipped;
  answer.reason = item.skipReason;
  return answer;
}

std::string expectedText(const PairQuestion& question) {
  if (question.isNumber()) return shortNumber(question.expected);
  if (question.query == PairQuery::FirstContact) return std::string(toString(Verdict::Free));
  if (!question.hits) return "either";
  return *question.hits ? "yes" : "no";
}

std::string expectedText(const ReplayCase& item) {
  if (item.pair) return expectedText(*item.pair);
  if (!item.robot) return "-";
  const Verdict expected = item.robot->expected;
  return expected == Verdict::Undecided ? "either" : std::string(toString(expected));
}

std::string resultText(const Answer& answer) {
  const std::string name = answer.result == Answer::Result::Passed   ? "ok"
                           : answer.result == Answer::Result::Failed ? "FAILED"
                                                                     : "skipped";
  return answer.reason.empty() ? name : name + " (" + answer.reason + ")";
}

std::vector<std::string> rowOf(const ReplayCase& item, const Answer& answer) {
  const std::string error = std::isnan(answer.error) ? "-" : shortNumber(answer.error);
  return {item.id, item.query, answer.text, expectedText(item), error, resultText(answer)};
}

Json jsonOf(const ReplayCase& item, const Answer& answer) {
  const bool number = item.pair && item.pair->isNumber();
  Json json = {{"id", item.id}, {"query", item.query}};
  json["answer"] = number ? finiteOrNull(answer.value) : Json(answer.text);
  json["expected"] = number ? Json(item.pair->expected) : Json(expectedText(item));
  json["error"] = finiteOrNull(answer.error);
  json["lower"] = finiteOrNull(answer.lower);
  json["upper"] = finiteOrNull(answer.upper);
  json["seconds"] = answer.seconds;
  json["result"] = answer.result == Answer::Result::Passed   ? "ok"
                   : answer.result == Answer::Result::Failed ? "failed"
                                                             : "skipped";
  json["reason"] = answer.reason;
  return json;
}

}  // namespace

ExitCode runReplay(const Arguments& args) {
  TextTable table(
      {{"id"}, {"query"}, {"answer", true}, {"expected", true}, {"error", true}, {"result"}});
  Json json = {{"cases", Json::array()}};
  Warnings warnings(args.quiet);
  int passed = 0, failed = 0, skipped = 0;
  const auto ask = [&](const ReplayCase& item) {
    const Answer answer = answerTo(item, std::ref(warnings));
    ++(answer.result == Answer::Result::Passed   ? passed
       : answer.result == Answer::Result::Failed ? failed
                                                 : skipped);
    if (args.json)
      json["cases"].push_back(jsonOf(item, answer));
    else
      table.add(rowOf(item, answer));
  };
  // All of them before the first is asked: a bad one costs no time.
  for (const std::string& file : args.cases) forEachReplayCase(file, [](const ReplayCase&) {});
  for (const std::string& file : args.cases) forEachReplayCase(file, ask);
  if (args.json) {
    json["passed"] = passed;
    json["failed"] = failed;
    json["skipped"] = skipped;
    std::cout << dumped(json) << '\n';
  } else {
    const std::string fails = std::to_string(failed) + " failed";
    printText(table.text() + std::to_string(passed) + " passed, " +
              (failed == 0 ? fails : painted(Hue::Bad, fails)) + ", " + std::to_string(skipped) +
              " skipped\n");
  }
  return failed == 0 ? ExitCode::Free : ExitCode::Collision;
}

}  // namespace swept
