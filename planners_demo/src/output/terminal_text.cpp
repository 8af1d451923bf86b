// SPDX-License-Identifier: BSD-3-Clause
#include "output/terminal_text.hpp"

#include <iostream>

namespace swept {

void printMessage(std::string_view line) {
  std::cerr << escapedLine(line) + "\n";
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
