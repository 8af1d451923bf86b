// SPDX-License-Identifier: BSD-3-Clause
#include "io/collada_convex.hpp"

namespace swept::detail {

namespace {

constexpr std::string_view kOpening = "<convex_mesh";
constexpr std::string_view kClosing = "</convex_mesh";
constexpr std::string_view kBlanks = " \t\r\n";

bool endsName(char c) {
  return c == '>' || kBlanks.find(c) != std::string_view::npos;
}

/// Whether a tag that opens a `<geometry>` is all that stands before, but for blanks.
bool followsGeometry(std::string_view before) {
  constexpr std::string_view kGeometry = "<geometry";
  const std::size_t last = before.find_last_not_of(kBlanks);
  if (last == std::string_view::npos || last == 0 || before[last] != '>') return false;
  const std::size_t begin = before.rfind('<', last);
  if (begin == std::string_view::npos || before[last - 1] == '/') return false;
  const std::string_view tag = before.substr(begin);
  return tag.starts_with(kGeometry) && endsName(tag[kGeometry.size()]);
}

}  // namespace

std::string withConvexMeshes(std::string_view text) {
  std::string result;
  std::size_t done = 0;  // of the text
  const auto replace = [&](std::size_t at, std::string_view name, std::string_view now) {
    result.append(text.substr(done, at - done)).append(now);
    done = at + name.size();
  };
  for (std::size_t at = text.find(kOpening); at != std::string_view::npos;
       at = text.find(kOpening, at + 1)) {
    const std::size_t close = text.find(kClosing, at);
    const std::size_t end = text.find('>', at);
    if (close == std::string_view::npos || close < end) break;
    const std::string_view attributes = text.substr(at + kOpening.size(), end - at);
    const bool hasFaces = attributes.find("convex_hull_of") == std::string_view::npos;
    if (!endsName(attributes.front()) || text[end - 1] == '/' || !hasFaces ||
        !followsGeometry(text.substr(0, at)))
      continue;
    replace(at, kOpening, "<mesh");
    replace(close, kClosing, "</mesh");
    at = close;
  }
  return result.append(text.substr(done));
}

}  // namespace swept::detail
