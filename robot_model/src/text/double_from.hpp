// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>

namespace swept::detail {

/// std::from_chars for a double, also where the standard library has none (libc++ before 20). There
/// the result is that of strtod in the locale "C", which rounds to nearest, too.
std::from_chars_result doubleFrom(const char* first, const char* last, double& value);

}  // namespace swept::detail
