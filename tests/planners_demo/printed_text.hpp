// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Compares what the program prints with what it is said to print.
namespace swept::test {

std::string replaced(std::string text, const std::string& from, const std::string& to);

std::string fileText(const std::filesystem::path& file);

/// `# s` for each time, which differs from run to run.
std::string withoutTimes(const std::string& text);

/// Numbers and what is between them; runs of blanks, which align columns, are one.
struct Pieces {
  std::vector<std::string> between, numbers;

  explicit Pieces(const std::string& text);
};

/// Two numbers, to a thousandth: another instruction set may order sums in another way. `#` is
/// wanted of any.
bool agree(const std::string& wanted, const std::string& found);

/// Fails the test where another text or a number that does not agree is found.
void expectPrinted(const std::string& found, const std::string& wanted);

}  // namespace swept::test
