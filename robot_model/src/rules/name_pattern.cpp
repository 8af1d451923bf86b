// SPDX-License-Identifier: BSD-3-Clause
#include "rules/name_pattern.hpp"

#include <cstddef>

namespace swept::detail {

/// Backtracking to the last `*` is enough: it can match anything that earlier ones match.
bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t star = std::string_view::npos;
  std::size_t taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  return pattern.substr(p).find_first_not_of('*') == std::string_view::npos;
}

bool isPattern(std::string_view name) {
  return name.find('*') != std::string_view::npos;
}

}  // namespace swept::detail
