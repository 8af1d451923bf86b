// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <streambuf>
#include <string>
#include <string_view>

#include "swept/core/verdict.hpp"
#include "text/escaped_text.hpp"

/// Text that is printed to a terminal.
namespace swept {

enum class Hue { Good, Bad, Doubtful };  ///< green, red, yellow

/// The word between marks, which printText() replaces by colours on a terminal that shows them.
std::string painted(Hue hue, std::string_view word);
/// The word of a verdict, painted.
std::string painted(Verdict verdict);

/// Prints one line on stderr, escaped. On a terminal it breaks long lines and colours `error:` or
/// `warning:`.
void printMessage(std::string_view line);

/// Prints lines on stdout, escaped, with the colours of painted() where the terminal shows them.
/// Breaks lines at blanks where they have a greatest length. It is for text that people read; JSON
/// and the like go to std::cout unchanged.
void printText(std::string_view text);

/// While it lives, text printed with std::cout is escaped, except for the ends of lines. Escaped
/// JSON means the same.
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
