// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace swept::detail {

/// The most bytes that one byte of LZF data stands for: three of them repeat up to 264.
inline constexpr std::size_t kLzfRatio = 88;

/// What is wrong with LZF data, and at which byte of them.
struct LzfFault {
  std::size_t at;
  std::string what;
};

/// Expands LZF data (M. Lehmann's LibLZF, format of `lzf_d.c`): runs of bytes as they are, and
/// repetitions of what came up to 8192 bytes before. Nothing, when they fill `output` exactly; else
/// what is wrong, and `output` holds anything.
std::optional<LzfFault> expandLzf(std::span<const char> data, std::span<char> output);

}  // namespace swept::detail
