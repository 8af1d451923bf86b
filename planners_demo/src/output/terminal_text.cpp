// SPDX-License-Identifier: BSD-3-Clause
#include "output/terminal_text.hpp"

#include <algorithm>
#include <array>
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

/// Escaped but for the marks.
std::string escapedBetweenMarks(std::string_view text) {
  std::string safe;
  while (!text.empty()) {
    const auto mark = std::ranges::find_if(text, isMark);
    const auto size = static_cast<std::size_t>(mark - text.begin());
    safe += escapedText(text.substr(0, size));
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

std::string painted(Hue hue, std::string_view word) {
  return kMarks[static_cast<std::size_t>(hue)].letter + std::string(word) + kEndOfHue;
}

std::string painted(Verdict verdict) {
  const Hue hue = verdict == Verdict::Free        ? Hue::Good
                  : verdict == Verdict::Undecided ? Hue::Doubtful
                                                  : Hue::Bad;
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
  const std::string safe = escapedText({text, static_cast<std::size_t>(count)});
  const auto size = static_cast<std::streamsize>(safe.size());
  return behind_->sputn(safe.data(), size) == size ? count : 0;
}

int EscapedOutput::sync() {
  return behind_->pubsync();
}

}  // namespace swept
