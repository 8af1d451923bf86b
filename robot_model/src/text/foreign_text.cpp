// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/foreign_text.hpp"

#include <array>
#include <cstdio>

namespace swept {

namespace {

/// Bytes of the UTF-8 character at the front of `text`; 0 if there is none.
std::size_t sizeOfCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return 1;
  const std::size_t size = byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return size;
}

/// A control character of ASCII, or of Latin-1 in UTF-8.
bool isControl(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7f;
  return character.size() == 2 && first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

std::string numbered(char byte) {
  std::array<char, 8> number{};
  std::snprintf(number.data(), number.size(), "\\u%04x", static_cast<unsigned char>(byte));
  return number.data();
}

}  // namespace

std::string foreignText(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n\f\v";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return "";
  text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t size = sizeOfCharacter(text.substr(at));
    const std::size_t taken = size == 0 ? 1 : size;
    if (at + taken > kMaxForeignBytes) return line + "...";
    const std::string_view character = text.substr(at, taken);
    if (character == "\n") {
      line += "\\n";
    } else if (size == 0 || isControl(character)) {
      line += numbered(character.back());
    } else {
      line += character;
    }
    at += taken;
  }
  return line;
}

}  // namespace swept
