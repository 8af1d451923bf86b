// SPDX-License-Identifier: BSD-3-Clause
#include "encoding.hpp"

#include <openssl/evp.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "model.hpp"

namespace swept::verify {
namespace {

static_assert(std::endian::native == std::endian::little,
              "numbers in path files are little endian");

std::string encoded(const void* bytes, std::size_t size) {
  std::string text(4 * ((size + 2) / 3) + 1, '\0');  // OpenSSL ends it with a zero
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      static_cast<const unsigned char*>(bytes), static_cast<int>(size));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

template <typename Number>
std::vector<Number> decoded(const std::string& text, const std::string& where) {
  std::vector<unsigned char> bytes(text.size() / 4 * 3);
  const int length =
      text.size() % 4 != 0
          ? -1
          : EVP_DecodeBlock(bytes.data(), reinterpret_cast<const unsigned char*>(text.data()),
                            static_cast<int>(text.size()));
  // Padding in the last four characters counts as zeros.
  std::size_t padding = 0;
  while (padding < 2 && padding < text.size() && text[text.size() - 1 - padding] == '=') ++padding;
  const std::size_t size = length < 0 ? 0 : static_cast<std::size_t>(length) - padding;
  if (length < 0 || size % sizeof(Number) != 0) throw Refusal(where + " is not base64 of numbers");
  std::vector<Number> numbers(size / sizeof(Number));
  // Without numbers the address may be null, which memcpy must not get.
  if (size > 0) std::memcpy(numbers.data(), bytes.data(), size);
  return numbers;
}

}  // namespace

std::string base64Of(std::span<const std::uint8_t> bytes) {
  return encoded(bytes.data(), bytes.size_bytes());
}

std::string base64Of(std::span<const double> numbers) {
  return encoded(numbers.data(), numbers.size_bytes());
}

std::string base64Of(std::span<const std::uint32_t> numbers) {
  return encoded(numbers.data(), numbers.size_bytes());
}

std::vector<double> doublesOf(const std::string& text, const std::string& where) {
  std::vector<double> numbers = decoded<double>(text, where);
  for (const double number : numbers)
    if (!std::isfinite(number)) throw Refusal(where + " has a number that is not finite");
  return numbers;
}

std::vector<std::uint32_t> integersOf(const std::string& text, const std::string& where) {
  return decoded<std::uint32_t>(text, where);
}

std::string numberText(double number, int digits) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), number,
                                 std::chars_format::general, digits);
  return {text.data(), end.ptr};
}

std::string digestOf(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned int size = 0;
  if (EVP_Digest(text.data(), text.size(), bytes.data(), &size, EVP_sha256(), nullptr) != 1)
    throw Refusal("no SHA-256 on this machine");
  std::string digits;
  for (unsigned int i = 0; i < size; ++i) {
    digits += "0123456789abcdef"[bytes[i] >> 4];
    digits += "0123456789abcdef"[bytes[i] & 15];
  }
  return digits;
}

}  // namespace swept::verify
