// SPDX-License-Identifier: BSD-3-Clause
#include "printed_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>

namespace swept::test {
namespace {

constexpr double kTolerance = 1e-3;
constexpr double kAbsolute = 1e-9;

}  // namespace

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string fileText(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string withoutTimes(const std::string& text) {
  static const std::regex kSeconds("[0-9.]+(e-?[0-9]+)? (s|ms|us|ns)\\b");
  static const std::regex kFields("(\"(seconds|[a-z_]*time)\": )[0-9][-+.0-9e]*");
  return std::regex_replace(std::regex_replace(text, kSeconds, "# s"), kFields, "$1#");
}

Pieces::Pieces(const std::string& text) {
  static const std::regex kNumber("#|-?[0-9]+(\\.[0-9]+)?(e[-+]?[0-9]+)?");
  static const std::regex kBlanks(" +");
  const auto add = [&](const std::string& piece) {
    between.push_back(std::regex_replace(piece, kBlanks, " "));
  };
  std::size_t done = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), kNumber), end; it != end; ++it) {
    const auto at = static_cast<std::size_t>(it->position());
    add(text.substr(done, at - done));
    numbers.push_back(it->str());
    done = at + static_cast<std::size_t>(it->length());
  }
  add(text.substr(done));
}

bool agree(const std::string& wanted, const std::string& found) {
  if (wanted == "#" || wanted == found) return true;
  if (found == "#") return false;
  const double a = std::stod(wanted), b = std::stod(found);
  return std::abs(a - b) <= kAbsolute + kTolerance * std::max(std::abs(a), std::abs(b));
}

void expectPrinted(const std::string& found, const std::string& wanted) {
  const Pieces expected(wanted), now(found);
  EXPECT_EQ(expected.between, now.between) << found;
  ASSERT_EQ(expected.numbers.size(), now.numbers.size());
  std::string differing;
  for (std::size_t i = 0; i < now.numbers.size(); ++i)
    if (!agree(expected.numbers[i], now.numbers[i]))
      differing += expected.numbers[i] + " before, now " + now.numbers[i] + "\n";
  EXPECT_EQ(differing, "") << "in\n" << found;
}

}  // namespace swept::test
