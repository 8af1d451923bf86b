// SPDX-License-Identifier: BSD-3-Clause
#include "output/terminal_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <utility>

#include "output/line_breaks.hpp"
#include "output/terminal.hpp"

namespace swept {
namespace {

// Around words of painted(); widthOf() knows them. Of a file's own such characters nothing is left.
constexpr char kEndOfHue = '\x04';

struct Mark {
  char letter;
  const char* sequence;  ///< what a terminal takes for it
};
constexpr std::array kMarks{Mark{'\x01', "\033[32m"}, Mark{'\x02', "\033[31m"},
                            Mark{'\x03', "\033[33m"}, Mark{kEndOfHue, "\033[0m"}};

bool isMark(char letter) {
  return std::ranges::find(kMarks, letter, &Mark::letter) != kMarks.end();
}

/// Bytes of the UTF-8 character at the front of `text`; 1 for what is none.
std::size_t sizeOfCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t size = byte(0) < 0xc2 ? 1 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
  if (byte(0) > 0xf4 || size > text.size()) return 1;
  for (std::size_t i = 1; i < size; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 1;
  return size;
}

/// Those below blank, 0x7f to 0x9f in UTF-8, and the latter as single bytes.
bool isControl(unsigned code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

std::string escaped(std::string_view text, bool oneLine) {
  std::string safe;
  while (!text.empty()) {
    const std::size_t size = sizeOfCharacter(text);
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

/// Escaped but for the marks.
std::string escapedBetweenMarks(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const auto mark = std::ranges::find_if(text, isMark);
    const auto size = static_cast<std::size_t>(mark - text.begin());
    safe += escaped(text.substr(0, size), false);
    if (mark != text.end()) safe += *mark;
    text.remove_prefix(std::min(size + 1, text.size()));
  }
  return safe;
}

/// The marks as a terminal takes them, or gone.
std::string shown(std::string_view text, bool coloured) {
  std::string result;
  for (const char letter : text) {
    const auto mark = std::ranges::find(kMarks, letter, &Mark::letter);
    if (mark == kMarks.end())
      result += letter;
    else if (coloured)
      result += mark->sequence;
  }
  return result;
}

/// `swept: error: ...` with `error:` in its colour.
std::string withPaintedKind(std::string_view line) {
  for (const auto& [kind, hue] : {std::pair{"error:", Hue::Bad}, {"warning:", Hue::Doubtful}}) {
    const std::size_t at = line.find(": " + std::string(kind) + " ");
    if (at == std::string_view::npos) continue;
    const std::size_t end = at + 2 + std::string_view(kind).size();
    return std::string(line.substr(0, at + 2)) + painted(hue, kind) + std::string(line.substr(end));
  }
  return std::string(line);
}

}  // namespace

std::string escapedLine(std::string_view text) {
  return escaped(text, true);
}

std::string painted(Hue hue, std::string_view word) {
  return kMarks[static_cast<std::size_t>(hue)].letter + std::string(word) + kEndOfHue;
}

std::string painted(Verdict verdict) {
  const Hue hue = verdict == Verdict::Free        ? Hue::Good
                  : verdict == Verdict::Collision ? Hue::Bad
                                                  : Hue::Doubtful;
  return painted(hue, toString(verdict));
}

void printMessage(std::string_view line) {
  std::string text = withPaintedKind(escapedLine(line));
  if (const auto columns = columnsOf(Stream::Err)) text = brokenLines(text, *columns);
  std::cerr << shown(text, isColoured(Stream::Err)) + "\n";
}

void printText(std::string_view text) {
  std::string lines = escapedBetweenMarks(text);
  if (const auto columns = columnsOf(Stream::Out)) lines = brokenLines(lines, *columns);
  lines = shown(lines, isColoured(Stream::Out));
  auto* escaping = dynamic_cast<EscapedOutput*>(std::cout.rdbuf());
  std::streambuf* to = escaping == nullptr ? std::cout.rdbuf() : escaping->behind_;
  const auto size = static_cast<std::streamsize>(lines.size());
  if (to->sputn(lines.data(), size) != size) std::cout.setstate(std::ios::badbit);
}

EscapedOutput::EscapedOutput() : behind_(std::cout.rdbuf(this)) {}

EscapedOutput::~EscapedOutput() {
  std::cout.rdbuf(behind_);
}

EscapedOutput::int_type EscapedOutput::overflow(int_type letter) {
  const char text = traits_type::to_char_type(letter);
  return xsputn(&text, 1) == 1 ? letter : traits_type::eof();
}

std::streamsize EscapedOutput::xsputn(const char* text, std::streamsize count) {
  const std::string safe = escaped({text, static_cast<std::size_t>(count)}, false);
  const auto size = static_cast<std::streamsize>(safe.size());
  return behind_->sputn(safe.data(), size) == size ? count : 0;
}

int EscapedOutput::sync() {
  return behind_->pubsync();
}

}  // namespace swept
