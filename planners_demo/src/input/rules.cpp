// SPDX-License-Identifier: BSD-3-Clause
#include "input/rules.hpp"

#include <cmath>
#include <cstdlib>

#include "command_line/exit_code.hpp"

namespace swept {
namespace {

/// `NAME=NUMBER`; names of bodies may have a `=` in them.
std::pair<std::string, double> numberOf(const std::string& option, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  if (equals == 0 || number.empty() || *end != '\0')
    throw UsageError(option + " '" + text + "': expected NAME=NUMBER");
  return {text.substr(0, equals), value};
}

}  // namespace

std::pair<std::string, std::string> namesOfPair(const std::string& option,
                                                const std::string& text) {
  const std::size_t comma = text.find(',');
  const bool two = comma != std::string::npos && comma > 0 && comma + 1 < text.size() &&
                   text.find(',', comma + 1) == std::string::npos;
  if (!two) throw UsageError(option + " '" + text + "': expected two names, A,B");
  return {text.substr(0, comma), text.substr(comma + 1)};
}

CollisionRules rulesOf(const Arguments& args) {
  CollisionRules rules;
  for (const std::string& text : args.pads) {
    const auto [name, metres] = numberOf("--pad", text);
    if (!(metres >= 0.0) || !std::isfinite(metres))
      throw UsageError("--pad '" + text + "': a padding must be 0 m or more, and finite");
    rules.pad(name, metres);
  }
  for (const std::string& text : args.scales) {
    const auto [name, factor] = numberOf("--scale", text);
    if (!(factor > 0.0) || !std::isfinite(factor))
      throw UsageError("--scale '" + text + "': a factor must be above 0, and finite");
    rules.scale(name, factor);
  }
  for (const std::string& text : args.allowed) {
    const auto [a, b] = namesOfPair("--allow", text);
    rules.allow(a, b, "--allow");
  }
  return rules;
}

}  // namespace swept
