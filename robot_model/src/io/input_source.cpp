// SPDX-License-Identifier: BSD-3-Clause
#include "io/input_source.hpp"

#include <fstream>
#include <iterator>
#include <utility>

namespace swept::detail {

InputSource::InputSource(std::string name, const LoadOptions& options)
    : name_(std::move(name)), options_(options) {}

std::filesystem::path InputSource::folder() const {
  return std::filesystem::absolute(name_).parent_path();
}

void InputSource::fail(int line, const std::string& message) const {
  throw InputError(name_, line, message);
}

void InputSource::warn(int line, const std::string& message) const {
  if (!options_.warn) return;
  const std::string place = line > 0 ? name_ + ":" + std::to_string(line) : name_;
  options_.warn(place + ": warning: " + message);
}

std::string readTextFile(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(file.string(), 0, "file not found");
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(file.string(), 0, "not a regular file");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(file.string(), 0, "file cannot be read");
  return text;
}

}  // namespace swept::detail
