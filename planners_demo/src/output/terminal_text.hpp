// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <streambuf>
#include <string_view>

#include "output/escaped_text.hpp"

/// What is printed to a terminal.
namespace swept {

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
