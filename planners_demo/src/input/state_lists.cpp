// SPDX-License-Identifier: BSD-3-Clause
#include "input/state_lists.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string_view>
#include <utility>

#include "command_line/command.hpp"
#include "command_line/exit_code.hpp"
#include "input/read_again.hpp"
#include "input/states.hpp"
#include "io/regular_file.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/path_file.hpp"

namespace swept {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
/// Warnings of values that were taken to a limit; more are counted.
constexpr std::size_t kMostRemarks = 10;
/// Bytes of a line: far more than any robot's values. Larger: files that are no text.
constexpr std::size_t kMostLine = std::size_t{1} << 20;

/// Without the `@`.
std::string fileOf(const std::string& text) {
  return text.starts_with('@') ? text.substr(1) : text;
}

/// Values between blanks get commas.
std::string withCommas(std::string line) {
  if (line.find(',') != std::string::npos) return line;
  std::string text;
  for (std::size_t at = 0; (at = line.find_first_not_of(kBlanks, at)) != std::string::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    text.append(text.empty() ? "" : ",").append(line, at, end - at);
    at = end;
  }
  return text;
}

class LineStates {
 public:
  LineStates(const Robot& robot, const Group& group, AngleUnit unit, const Warn& warn)
      : robot_(robot), group_(group), unit_(unit), warn_(warn) {}

  /// `name`: of the stream.
  void read(std::istream& stream, const std::string& name, std::vector<LabelledState>& states) {
    const std::size_t before = states.size();
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
      if (line.size() > kMostLine)
        throw InputError(name, number, "the line is too long for a state");
      if (number == 1 && line.starts_with(kUtf8Mark)) line.erase(0, kUtf8Mark.size());
      // Else a remark would hide the states behind it.
      if (line.find('\r') < line.size() - 1)
        throw InputError(name, number,
                         "a carriage return is within the line; a line ends with a line feed");
      line.erase(std::min(line.find('#'), line.size()));
      if (line.find_last_not_of(kBlanks) == std::string::npos) continue;
      line.erase(line.find_last_not_of(kBlanks) + 1);
      const std::string label = name + ":" + std::to_string(number);
      states.push_back({.label = label, .q = stateOf(line, name, number)});
    }
    if (stream.bad()) throw InputError(name, 0, "file cannot be read");
    if (states.size() == before) throw InputError(name, 0, "there is no state in it");
    if (remarks_ > kMostRemarks)
      warn_("swept: warning: " + name + ": " + std::to_string(remarks_ - kMostRemarks) +
            " further values were taken to limits");
  }

 private:
  std::vector<double> stateOf(const std::string& line, const std::string& name, int number) {
    try {
      return readState(
          robot_, group_, withCommas(line), "state",
          [&](const std::string& remark) {
            if (remarks_++ < kMostRemarks) warn_(remark);
          },
          unit_);
    } catch (const UsageError& error) {
      throw InputError(name, number, error.what());
    }
  }

  const Robot& robot_;
  const Group& group_;
  AngleUnit unit_;
  const Warn& warn_;
  std::size_t remarks_ = 0;
};

AngleUnit unitOf(const Arguments& args) {
  return args.degrees ? AngleUnit::Degree : AngleUnit::Radian;
}

}  // namespace

bool isStateList(const std::string& text) {
  return text.starts_with('@') || text == "-" ||
         (text.find(',') == std::string::npos && isPathFile(text));
}

void requireDegreesForValues(const Arguments& args) {
  if (!args.degrees) return;
  if (args.states.empty()) throw UsageError("--degrees is for the values of states that are given");
  for (const std::string& text : args.states)
    if (isStateList(text) && isPathFile(fileOf(text)))
      throw UsageError("--degrees and '" + text +
                       "' cannot be combined: the angles of a path file are in rad");
}

void addStateList(const Arguments& args, const Robot& robot, const Group& group,
                  const std::optional<Eigen::VectorXd>& reference, const LoadOptions& options,
                  const std::string& text, std::vector<LabelledState>& states) {
  if (text == "-" && std::ranges::count(args.states, text) > 1)
    throw UsageError("-: standard input is read once");
  LineStates lines(robot, group, unitOf(args), options.warn);
  const std::string file = fileOf(text);
  if (file.empty()) throw UsageError("@: expected @FILE");
  if (text == "-") {
    lines.read(std::cin, "-", states);
  } else if (isPathFile(file)) {
    std::size_t number = 0;
    for (std::vector<double>& q : readPath(file, robot, group, reference, options))
      states.push_back({.label = file + " state " + std::to_string(++number), .q = std::move(q)});
  } else {
    const std::string reason = detail::whyNoBytes(file);
    if (!reason.empty()) throw InputError(file, 0, reason);
    std::ifstream stream(file);
    lines.read(stream, file, states);
  }
}

std::vector<double> firstState(const Arguments& args, const Robot& robot, const Group& group,
                               const std::optional<Eigen::VectorXd>& reference,
                               const LoadOptions& options) {
  const std::string text = args.path.empty() ? args.states.front() : args.path;
  if (args.path.empty() && !(args.command->takesLists && isStateList(text)))
    return readState(robot, group, text, "--self-filter", options.warn, unitOf(args));
  if (text == "-")
    throw UsageError(
        "--self-filter: the first state is read before the others, which - does not allow");
  requireReadAgain(fileOf(text));
  std::vector<LabelledState> states;
  addStateList(args, robot, group, reference, options, text, states);
  return states.front().q;
}

std::string stateText(std::span<const double> q) {
  std::string text;
  for (const double value : q) text.append(text.empty() ? "" : ",").append(exactNumber(value));
  return text;
}

}  // namespace swept
