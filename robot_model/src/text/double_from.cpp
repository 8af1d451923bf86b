// SPDX-License-Identifier: BSD-3-Clause
#include "text/double_from.hpp"

#include <version>

#if !defined(__cpp_lib_to_chars)
#include <locale.h>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#endif

namespace swept::detail {

#if defined(__cpp_lib_to_chars)

std::from_chars_result doubleFrom(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}

#else

namespace {

/// What strtod takes and from_chars does not: blanks and a plus sign before a number, and a
/// hexadecimal one, of which from_chars takes the zero.
std::string_view withoutHexadecimal(std::string_view word) {
  const std::size_t digits = word.starts_with('-') ? 1 : 0;
  const std::string_view head = word.substr(digits, 2);
  return head == "0x" || head == "0X" ? word.substr(0, digits + 1) : word;
}

}  // namespace

std::from_chars_result doubleFrom(const char* first, const char* last, double& value) {
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  // No number has other characters, and lines can be long.
  const std::string_view all(first, static_cast<std::size_t>(last - first));
  const std::string_view word =
      all.substr(0, all.find_first_not_of(
                        "+-.()_0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"));
  if (word.empty() || word.front() == '+') return {first, std::errc::invalid_argument};
  const std::string text(withoutHexadecimal(word));
  char* end = nullptr;
  const double read = strtod_l(text.c_str(), &end, classic);
  if (end == text.c_str()) return {first, std::errc::invalid_argument};
  const char* const after = first + (end - text.c_str());
  const std::string_view taken(text.c_str(), static_cast<std::size_t>(end - text.c_str()));
  const bool isDecimal = taken.find_first_of("nN") == std::string_view::npos;
  const std::string_view digits = taken.substr(0, taken.find_first_of("eE"));
  const bool isTooSmall =
      read == 0.0 && digits.find_first_of("123456789") != std::string_view::npos;
  if (isDecimal && (std::isinf(read) || isTooSmall)) return {after, std::errc::result_out_of_range};
  value = read;
  return {after, std::errc{}};
}

#endif

}  // namespace swept::detail
