// SPDX-License-Identifier: BSD-3-Clause
#include "io/input_source.hpp"

#include <system_error>
#include <utility>

#include "text/short_message.hpp"

namespace swept::detail {

InputSource::InputSource(std::string name, const LoadOptions& options)
    : name_(std::move(name)), options_(options) {}

std::filesystem::path InputSource::folder() const {
  std::error_code error;  // for a working folder that no longer exists
  const std::filesystem::path whole = std::filesystem::absolute(name_, error);
  return (error ? std::filesystem::path(name_) : whole).parent_path();
}

void InputSource::fail(int line, const std::string& message) const {
  throw InputError(name_, line, message);
}

std::string InputSource::warning(int line, const std::string& message) const {
  const std::string place = line > 0 ? name_ + ":" + std::to_string(line) : name_;
  return place + ": warning: " + shortMessage(message);
}

void InputSource::warn(int line, const std::string& message) const {
  if (options_.warn) options_.warn(warning(line, message));
}

void InputSource::warnOfUnchecked(int line, const std::string& message) const {
  const auto& taker = options_.warnOfUnchecked ? options_.warnOfUnchecked : options_.warn;
  if (taker) taker(warning(line, message));
}

}  // namespace swept::detail
