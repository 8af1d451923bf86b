// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Numbers of a path file, bit for bit: base64 of IEEE doubles and 32-bit integers, little endian.
/// And digests, and numbers in words.
namespace swept::verify {

std::string base64Of(std::span<const std::uint8_t> bytes);
std::string base64Of(std::span<const double> numbers);
std::string base64Of(std::span<const std::uint32_t> numbers);

/// Throw Refusal, which starts with `where`.
std::vector<double> doublesOf(const std::string& text, const std::string& where);
std::vector<std::uint32_t> integersOf(const std::string& text, const std::string& where);

/// With so many digits at most, for texts.
std::string numberText(double number, int digits);

/// SHA-256 of a text, as 64 hexadecimal digits.
std::string digestOf(const std::string& text);

}  // namespace swept::verify
