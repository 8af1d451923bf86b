// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace swept::detail {

/// A `*` in the pattern stands for any characters, or none.
bool matches(std::string_view pattern, std::string_view name);

/// Whether the text contains a `*`. A name without one must exist; a pattern may match nothing.
bool isPattern(std::string_view name);

}  // namespace swept::detail
