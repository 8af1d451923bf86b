// SPDX-License-Identifier: BSD-3-Clause
#include "input/clock.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "command_line/commands.hpp"
#include "input/states.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "text/numbers.hpp"

namespace swept {
namespace {

/// `object 'crate' of the scene moves`.
std::string movesText(const World& world) {
  return "object '" + world.obstacles().front().name + "' of the scene moves";
}

std::vector<double> timesOf(const Arguments& args, const Task& task) {
  const std::vector<std::string> texts = splitAtCommas(args.clock.times);
  if (texts.size() != task.states.size())
    throw UsageError("--times: " + countedText(texts.size(), "time") + " for " +
                     countedText(task.states.size(), "state") + "; each state has one");
  std::vector<double> times;
  for (const std::string& text : texts) {
    const auto time = detail::parseNumber(text);
    if (!time || !(std::abs(*time) <= kMostTime))
      throw UsageError("--times: '" + text + "' is no number from -1000000 to 1000000 (s)");
    times.push_back(*time);
  }
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double begin = times[task.alternatives ? 0 : i - 1];
    if (!(times[i] > begin))
      throw UsageError("--times: " + task.states[i].label + " is at " + texts[i] +
                       " s; the motion to it begins at " + shortNumber(begin) +
                       " s, and has to end later");
  }
  return times;
}

}  // namespace

void requireClock(const Arguments& args, const World& world) {
  if (world.obstacles().empty()) return;
  if (!args.command->hasClock)
    throw UsageError(movesText(world) + ", and swept " + std::string(args.command->name) +
                     " has no clock; swept check --time, motion --times, trajectory, schedule and "
                     "view --time have one, and swept schedule --plan plans beside what moves");
}

void refuseClock(const Arguments& args, const World& world) {
  if (!world.obstacles().empty()) return;
  const char* option = args.clock.time             ? "--time"
                       : !args.clock.times.empty() ? "--times"
                       : args.clock.begin          ? "--clock"
                                                   : nullptr;
  if (option != nullptr)
    throw UsageError(std::string(option) +
                     ": no object of the scene moves (an object with a 'motion' does)");
}

void addTimes(const Arguments& args, Task& task) {
  const World& world = task.checker->world();
  const bool check = args.command == &kCheckCommand;
  const bool motion = args.command == &kMotionCommand;
  const bool view = args.command->name == "view";  // not a command of every program
  if (world.obstacles().empty() || !(check || motion || view)) return;
  if (!motion && !args.clock.time)
    throw UsageError(movesText(world) + ": --time S says when the states are " +
                     (check ? "checked" : "shown"));
  if (motion && args.clock.times.empty())
    throw UsageError(movesText(world) + ": --times T,T,... says when the robot is at each state");
  const std::vector<double> times =
      motion ? timesOf(args, task) : std::vector<double>(task.states.size(), *args.clock.time);
  for (std::size_t i = 0; i < times.size(); ++i) {
    LabelledState& state = task.states[i];
    state.time = times[i];
    state.q.push_back(times[i]);
    state.label += " at " + shortNumber(times[i]) + " s";
  }
}

}  // namespace swept
