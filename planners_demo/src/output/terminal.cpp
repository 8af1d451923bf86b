// SPDX-License-Identifier: BSD-3-Clause
#include "output/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace swept {
namespace {

constexpr std::size_t kLeastColumns = 20;

int numberOf(Stream stream) {
  return stream == Stream::Out ? STDOUT_FILENO : STDERR_FILENO;
}

/// Columns of the terminal that it is. None where it is no terminal, or one that has no width:
/// nobody looks at those, which mpirun gives to the processes of a job.
std::optional<std::size_t> ownColumns(Stream stream) {
  winsize size{};
  if (isatty(numberOf(stream)) != 1 || ioctl(numberOf(stream), TIOCGWINSZ, &size) != 0) return {};
  return size.ws_col > 0 ? std::optional<std::size_t>(size.ws_col) : std::nullopt;
}

/// Empty: it is not set.
std::string_view ofEnvironment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// None unless it is a number above zero.
std::optional<std::size_t> askedColumns() {
  const std::string_view text = ofEnvironment("COLUMNS");
  std::size_t columns = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), columns);
  if (error != std::errc() || stop != text.data() + text.size() || columns == 0) return {};
  return columns;
}

}  // namespace

std::optional<std::size_t> columnsOf(Stream stream) {
  std::optional<std::size_t> columns;
  if (stream == Stream::Out) columns = askedColumns();
  if (!columns) columns = ownColumns(stream);
  return columns ? std::optional(std::max(*columns, kLeastColumns)) : std::nullopt;
}

bool isColoured(Stream stream) {
  const std::string_view terminal = ofEnvironment("TERM");
  return ofEnvironment("NO_COLOR").empty() && !terminal.empty() && terminal != "dumb" &&
         ownColumns(stream).has_value();
}

}  // namespace swept
