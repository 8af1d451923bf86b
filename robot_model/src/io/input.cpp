// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/input.hpp"

namespace swept {

namespace {

/// Names and values of a file may be as long as the file. What is at fault comes first, what is
/// allowed last.
std::string shortened(const std::string& message) {
  constexpr std::size_t kMost = 4000, kFirst = 2500, kLast = 1000;
  if (message.size() <= kMost) return message;
  return message.substr(0, kFirst) + " ... (" + std::to_string(message.size() - kFirst - kLast) +
         " bytes) ... " + message.substr(message.size() - kLast);
}

std::string located(const std::string& file, int line, const std::string& message) {
  const std::string place = line > 0 ? file + ":" + std::to_string(line) : file;
  return place + ": error: " + message;
}

}  // namespace

InputError::InputError(const std::string& file, int line, const std::string& message)
    : std::runtime_error(located(file, line, shortened(message))),
      file_(file),
      line_(line),
      message_(shortened(message)) {}

}  // namespace swept
