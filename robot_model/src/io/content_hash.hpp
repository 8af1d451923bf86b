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

/// A hash of 256 bits: BLAKE2b (RFC 7693), without a key. Nobody can find a second content with the
/// same hash.
class ContentHash {
 public:
  using Digest = std::array<std::uint8_t, 32>;

  ContentHash();
  void add(std::string_view bytes);
  /// Adds the items' bytes, in this machine's form. The items must have no padding.
  template <typename Item>
  void addItems(std::span<const Item> items) {
    add({reinterpret_cast<const char*>(items.data()), items.size_bytes()});
  }
  /// The hash of all that was added. Add nothing after it.
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
/// The hash of a file's content; empty: the file cannot be read.
std::optional<ContentHash::Digest> hashOfFile(const std::filesystem::path& file);

/// As text, two digits per byte.
std::string hexadecimal(const ContentHash::Digest& digest);

}  // namespace swept::detail
