// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <streambuf>
#include <string>
#include <string_view>

#include "swept/core/verdict.hpp"
#include "text/escaped_text.hpp"

/// What is printed to a terminal.
namespace swept {

enum class Hue { Good, Bad, Doubtful };  ///< green, red, yellow

/// The word between marks, which printText() makes colours of where there are any.
std::string painted(Hue hue, std::string_view word);
/// The verdict's own word.
std::string painted(Verdict verdict);

/// One line on stderr, escaped; on a terminal broken where it is longer than that, and with a
/// coloured `error:` or `warning:`.
void printMessage(std::string_view line);

/// Lines on stdout, escaped; where lines have a greatest length, broken at blanks, and with the
/// colours of painted() where there are any. For text that people read: JSON and the like go to
/// std::cout as they are.
void printText(std::string_view text);

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
  friend void printText(std::string_view text);
  std::streambuf* const behind_;
};

}  // namespace swept
