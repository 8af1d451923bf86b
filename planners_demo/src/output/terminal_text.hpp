// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <streambuf>
#include <string>
#include <string_view>

/// What names and values of files may say to a terminal: nothing. Control characters of theirs
/// would move its cursor, change its title or make up lines.
namespace swept {

/// One line: control characters are `\u001b`, as JSON has them, and ends of lines `\n`. Tabs, and
/// bytes that are not UTF-8 and no control characters of Latin-1 either, stay.
std::string escapedLine(std::string_view text);

/// One line on stderr, escaped.
void printMessage(std::string_view line);

/// While it lives, what is printed with std::cout is escaped, but for the ends of lines. JSON means
/// the same then.
class EscapedOutput : public std::streambuf {
 public:
  EscapedOutput();
  ~EscapedOutput() override;
  EscapedOutput(const EscapedOutput&) = delete;
  EscapedOutput& operator=(const EscapedOutput&) = delete;

 protected:
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int sync() override;

 private:
  std::streambuf* const behind_;
};

}  // namespace swept
