// SPDX-License-Identifier: BSD-3-Clause
#include "text/short_message.hpp"

#include <algorithm>

#include "swept/robot_model/foreign_text.hpp"

namespace swept::detail {

namespace {

bool isInsideCharacter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
}

/// `text` with at most `first` bytes of its beginning and `last` bytes of its end.
std::string withoutMiddle(std::string_view text, std::size_t first, std::size_t last) {
  std::size_t end = first, begin = text.size() - last;
  while (end > 0 && isInsideCharacter(text[end])) --end;
  while (begin < text.size() && isInsideCharacter(text[begin])) ++begin;
  return std::string(text.substr(0, end)) + "... (" + std::to_string(begin - end) + " bytes) ..." +
         std::string(text.substr(begin));
}

}  // namespace

std::string shortMessage(std::string_view message) {
  // Longer than a foreignText(), and than usual paths of files.
  constexpr std::size_t kMostOfWord = 512;
  static_assert(kMostOfWord > kMaxForeignBytes);
  constexpr std::size_t kFirstOfWord = 200, kLastOfWord = 60;
  constexpr std::size_t kMost = 4000, kFirst = 2500, kLast = 1000;
  std::string text;
  while (!message.empty()) {
    const std::size_t blank = std::min(message.find(' '), message.size());
    const std::string_view word = message.substr(0, blank);
    text += word.size() > kMostOfWord ? withoutMiddle(word, kFirstOfWord, kLastOfWord)
                                      : std::string(word);
    const std::size_t next = std::min(message.find_first_not_of(' ', blank), message.size());
    text += message.substr(blank, next - blank);
    message.remove_prefix(next);
  }
  if (text.size() > kMost) text = withoutMiddle(text, kFirst, kLast);
  // Where a message is a C string, what follows a zero would be lost.
  for (std::size_t at = 0; (at = text.find('\0', at)) != std::string::npos;)
    text.replace(at, 1, "\\u0000");
  return text;
}

}  // namespace swept::detail
