// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace swept::detail {

/// 256 bits that nobody finds a second content for: BLAKE2b (RFC 7693), without a key.
class ContentHash {
 public:
  using Digest = std::array<std::uint8_t, 32>;

  ContentHash();
  void add(std::string_view bytes);
  /// The items' bytes, as this machine has them; these must have no gaps.
  template <typename Item>
  void addItems(std::span<const Item> items) {
    add({reinterpret_cast<const char*>(items.data()), items.size_bytes()});
  }
  /// Of all that was added; nothing is added after it.
  Digest digest();

 private:
  static constexpr std::size_t kBlock = 128;
  void compress(bool isLast);

  std::array<std::uint64_t, 8> state_;
  std::array<std::uint8_t, kBlock> block_{};
  std::size_t filled_ = 0;    ///< bytes of the block
  std::uint64_t hashed_ = 0;  ///< bytes
};

ContentHash::Digest hashOf(std::string_view bytes);
/// Of what a file holds; empty: it cannot be read.
std::optional<ContentHash::Digest> hashOfFile(const std::filesystem::path& file);

/// Two digits a byte.
std::string hexadecimal(const ContentHash::Digest& digest);

}  // namespace swept::detail
