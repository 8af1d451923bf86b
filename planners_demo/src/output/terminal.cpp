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
// Of a terminal that does not say how wide it is.
constexpr std::size_t kUsualColumns = 80;

int numberOf(Stream stream) {
  return stream == Stream::Out ? STDOUT_FILENO : STDERR_FILENO;
}

bool isTerminal(Stream stream) {
  return isatty(numberOf(stream)) == 1;
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
  if (!columns) {
    if (!isTerminal(stream)) return {};
    winsize size{};
    const bool known = ioctl(numberOf(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    columns = known ? size.ws_col : kUsualColumns;
  }
  return std::max(*columns, kLeastColumns);
}

bool isColoured(Stream stream) {
  const std::string_view terminal = ofEnvironment("TERM");
  return ofEnvironment("NO_COLOR").empty() && !terminal.empty() && terminal != "dumb" &&
         isTerminal(stream);
}

}  // namespace swept
