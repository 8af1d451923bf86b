// SPDX-License-Identifier: BSD-3-Clause
#include "output/line_breaks.hpp"

#include <algorithm>
#include <array>

namespace swept {
namespace {

/// A unit stays with its number.
bool isUnit(std::string_view word) {
  word = word.substr(0, word.find_first_of(" ,;)"));
  constexpr std::array<std::string_view, 8> kUnits{"m", "mm", "rad", "s", "ms", "us", "ns", "%"};
  return std::ranges::find(kUnits, word) != kUnits.end();
}

/// Where the text may be broken: each piece is a word with the blanks behind it.
std::vector<std::string_view> wordsOf(std::string_view text, bool atCommas, bool quotes) {
  std::vector<std::string_view> words;
  std::size_t begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quotes && text[i] == '\'') quoted = !quoted;
    const bool last = i + 1 == text.size();
    const bool blank =
        text[i] == ' ' && !last && text[i + 1] != ' ' && !quoted && !isUnit(text.substr(i + 1));
    const bool comma = atCommas && text[i] == ',' && !last && text[i + 1] != ' ';
    if (!blank && !comma) continue;
    words.push_back(text.substr(begin, i + 1 - begin));
    begin = i + 1;
  }
  words.push_back(text.substr(begin));
  return words;
}

std::string_view withoutBlanksBehind(std::string_view text) {
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

/// `first` and `others`: columns of the first line and of those that follow.
std::vector<std::string> filled(const std::vector<std::string_view>& words, std::size_t first,
                                std::size_t others) {
  std::vector<std::string> lines{""};
  for (const std::string_view word : words) {
    const std::size_t room = lines.size() == 1 ? first : others;
    if (!lines.back().empty() && widthOf(lines.back()) + widthOf(withoutBlanksBehind(word)) > room)
      lines.emplace_back();
    lines.back() += word;
  }
  for (std::string& line : lines) line.resize(withoutBlanksBehind(line).size());
  return lines;
}

/// Columns before what follows a line's first part.
std::size_t indentOf(std::string_view line, std::size_t columns) {
  // An indent so deep is that of a part itself.
  constexpr std::size_t kDeep = 20;
  const std::size_t own = std::min(line.find_first_not_of(' '), line.size());
  std::size_t indent = own < kDeep ? own + 2 : own;
  for (std::size_t i = own; i + 2 < line.size() && i < columns / 2; ++i)
    if (line[i] == ' ' && line[i + 1] == ' ' && line[i + 2] != ' ')
      indent = widthOf(line.substr(0, i + 2));
  return indent < columns / 2 ? indent : own + 2;
}

std::string brokenLine(std::string_view line, std::size_t columns) {
  if (widthOf(line) <= columns) return std::string(line);
  const std::size_t own = std::min(line.find_first_not_of(' '), line.size());
  const bool command = line.substr(own).starts_with("swept ");
  const std::size_t indent = command ? own + 4 : indentOf(line, columns);
  const std::size_t behind = command ? 2 : 0;  // ` \`
  // The blanks in front are no place for a break.
  const std::string_view text = line.substr(own);
  const auto room = [&](std::size_t taken) {
    return columns > taken + behind ? columns - taken - behind : 1;
  };
  const std::vector<std::string> lines =
      filled(wordsOf(text, false, command), room(own), room(indent));
  std::string broken = std::string(own, ' ') + lines.front();
  for (std::size_t i = 1; i < lines.size(); ++i)
    broken += (command ? " \\\n" : "\n") + std::string(indent, ' ') + lines[i];
  return broken;
}

}  // namespace

std::size_t widthOf(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return (byte & 0xc0) != 0x80 && byte > 0x04;
  }));
}

std::vector<std::string> brokenCell(std::string_view text, std::size_t columns, bool atCommas) {
  return filled(wordsOf(text, atCommas, false), columns, columns);
}

std::string brokenLines(std::string_view text, std::size_t columns) {
  std::string broken;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    broken += brokenLine(text.substr(0, end), columns);
    if (end == std::string_view::npos) break;
    broken += '\n';
    text.remove_prefix(end + 1);
  }
  return broken;
}

}  // namespace swept
