// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace swept::detail {

/// The most bytes that one byte of LZF data expands to: three bytes repeat up to 264.
inline constexpr std::size_t kLzfRatio = 88;

/// What is wrong with LZF data, and at which byte of them.
struct LzfFault {
  std::size_t at;
  std::string what;
};

/// Expands LZF data (M. Lehmann's LibLZF, format of `lzf_d.c`): literal runs of bytes, and
/// repetitions of bytes up to 8192 before. Returns nothing when they fill `output` exactly.
/// Otherwise it returns what is wrong, and `output` is unspecified.
std::optional<LzfFault> expandLzf(std::span<const char> data, std::span<char> output);

}  // namespace swept::detail
