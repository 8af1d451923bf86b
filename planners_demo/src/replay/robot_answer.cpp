// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <exception>

#include "command_line/commands.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "output/text_output.hpp"
#include "replay/answer.hpp"

namespace swept {
namespace {

std::string valuesText(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : ",").append(exactNumber(value));
  return text;
}

/// Of the files that the case names. A case that names no states has its own where a task needs
/// some: the points that are the robot itself are those near its first state.
std::shared_ptr<const Checker> checkerOf(const RobotQuestion& question) {
  Arguments inputs = question.inputs;
  inputs.command = &kReplayCommand;
  inputs.quiet = true;  // many cases have one line of progress
  if (inputs.states.empty() && inputs.problems.empty() && inputs.request.empty())
    inputs.states = {valuesText(question.states.front())};
  Warnings warnings = Warnings::none();
  const Model model = loadModel(inputs, warnings);
  return loadTask(inputs, model, warnings).checker;
}

void requireJoints(const RobotQuestion& question, const Checker& checker) {
  if (question.jointNames.empty()) return;
  const std::vector<std::string> names = variableNames(checker.robot(), checker.group());
  if (names != question.jointNames)
    throw UsageError("the values are of joints " + joined(question.jointNames) + "; group '" +
                     checker.group().name + "' has " + joined(names));
}

/// A case has times exactly where an object of its scene moves.
void requireTimes(const RobotQuestion& question, const World& world) {
  if (world.obstacles().empty() == question.times.empty()) return;
  const std::string key = question.states.size() == 1 ? "'time'" : "'times'";
  throw UsageError(question.times.empty() ? "object '" + world.obstacles().front().name +
                                                "' of the scene moves, and the case has no " + key
                                          : key + ": no object of the scene moves");
}

void judge(Verdict found, const RobotQuestion& question, Answer& answer) {
  answer.text = std::string(toString(found));
  if (question.expected == Verdict::Undecided || found == question.expected)
    answer.result = Answer::Result::Passed;
  else
    answer.reason = found == Verdict::Undecided ? "not decided" : "wrong";
}

void answerMotion(const RobotQuestion& question, const MotionCertificate& found, Answer& answer) {
  judge(found.verdict, question, answer);
  if (!found.witness) return;
  answer.lower = found.freeUntil;
  answer.upper = found.witness->t;
  if (question.expected != Verdict::Collision || answer.result == Answer::Result::Failed) return;
  if (answer.lower <= question.contactBy && question.contactAfter <= answer.upper) return;
  answer.result = Answer::Result::Failed;
  answer.reason = "first contact between t = " + shortNumber(answer.lower) + " and " +
                  shortNumber(answer.upper);
}

void ask(const RobotQuestion& question, const Warn& warn, Answer& answer) {
  using Clock = std::chrono::steady_clock;
  const std::shared_ptr<const Checker> checker = checkerOf(question);
  requireJoints(question, *checker);
  requireTimes(question, checker->world());
  std::vector<std::vector<double>> states;
  for (const std::vector<double>& values : question.states)
    states.push_back(
        readState(checker->robot(), checker->group(), valuesText(values), "its values", warn));
  for (std::size_t i = 0; i < question.times.size(); ++i) states[i].push_back(question.times[i]);
  Workspace workspace(*checker);
  const Clock::time_point start = Clock::now();
  if (states.size() == 1)
    judge(checker->checkState(states.front(), workspace), question, answer);
  else
    answerMotion(question, checker->certifyMotion(states.front(), states.back(), workspace),
                 answer);
  answer.seconds = std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Answer answerTo(const RobotQuestion& question, const Warn& warn) {
  Answer answer;
  try {
    ask(question, warn, answer);
  } catch (const std::exception& error) {
    answer.result = Answer::Result::Failed;
    answer.reason = std::string("threw: ") + error.what();
  }
  return answer;
}

}  // namespace swept
