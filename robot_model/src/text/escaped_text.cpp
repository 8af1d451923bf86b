// SPDX-License-Identifier: BSD-3-Clause
#include "text/escaped_text.hpp"

#include <array>
#include <cstdio>

namespace swept {
namespace {

/// Bytes of the UTF-8 character at the front of `text`; 1 if there is none.
std::size_t sizeOfPrinted(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t size = byte(0) < 0xc2 ? 1 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  if (byte(0) > 0xf4 || size > text.size()) return 1;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 1;
  return size;
}

/// Control characters: those below blank, 0x7f to 0x9f in UTF-8, and the latter as single bytes.
bool isControl(unsigned code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

std::string escaped(std::string_view text, bool oneLine) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t size = sizeOfPrinted(text);
    // The second byte of U+0080 to U+00BF is the character's number.
    const bool latin = size == 2 && text[0] == '\xc2';
    const unsigned code = static_cast<unsigned char>(text[latin ? 1 : 0]);
    if (text[0] == '\n' && oneLine) {
      safe += "\\n";
    } else if (text[0] == '\n' || text[0] == '\t' || (size > 1 && !latin) || !isControl(code)) {
      safe += text.substr(0, size);
    } else {
      std::array<char, 8> number{};
      std::snprintf(number.data(), number.size(), "\\u%04x", code);
      safe += number.data();
    }
    text.remove_prefix(size);
  }
  return safe;
}

}  // namespace

std::string escapedText(std::string_view text) {
  return escaped(text, false);
}

std::string escapedLine(std::string_view text) {
  return escaped(text, true);
}

}  // namespace swept
