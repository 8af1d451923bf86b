// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/shell_word.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace swept {

std::string shellWord(const std::string& word) {
  const auto isPlain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("_-+=.,:/@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, isPlain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace swept
