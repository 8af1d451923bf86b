// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/input.hpp"

#include "text/short_message.hpp"

namespace swept {

namespace {

std::string located(const std::string& file, int line, const std::string& message) {
  const std::string place = line > 0 ? file + ":" + std::to_string(line) : file;
  return place + ": error: " + message;
}

}  // namespace

InputError::InputError(const std::string& file, int line, const std::string& message)
    : std::runtime_error(located(file, line, detail::shortMessage(message))),
      file_(file),
      line_(line),
      message_(detail::shortMessage(message)) {}

}  // namespace swept
