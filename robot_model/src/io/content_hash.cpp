// SPDX-License-Identifier: BSD-3-Clause
#include "io/content_hash.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <vector>

namespace swept::detail {

namespace {

constexpr std::array<std::uint64_t, 8> kStart{
    0x6a09e667f3bcc908, 0xbb67ae8584caa73b, 0x3c6ef372fe94f82b, 0xa54ff53a5f1d36f1,
    0x510e527fade682d1, 0x9b05688c2b3e6c1f, 0x1f83d9abfb41bd6b, 0x5be0cd19137e2179};

constexpr std::array<std::array<std::uint8_t, 16>, 10> kOrder{{
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
    {14, 10, 4, 8, 9, 15, 13, 6, 1, 12, 0, 2, 11, 7, 5, 3},
    {11, 8, 12, 0, 5, 2, 15, 13, 10, 14, 3, 6, 7, 1, 9, 4},
    {7, 9, 3, 1, 13, 12, 11, 14, 2, 6, 5, 10, 4, 0, 15, 8},
    {9, 0, 5, 7, 2, 4, 10, 15, 14, 1, 11, 12, 6, 8, 3, 13},
    {2, 12, 6, 10, 0, 11, 8, 3, 4, 13, 7, 5, 15, 14, 1, 9},
    {12, 5, 1, 15, 14, 13, 4, 10, 0, 7, 6, 3, 9, 2, 8, 11},
    {13, 11, 7, 14, 12, 1, 3, 9, 5, 0, 15, 4, 8, 6, 2, 10},
    {6, 15, 14, 9, 11, 3, 0, 8, 12, 2, 13, 7, 1, 4, 10, 5},
    {10, 2, 8, 4, 7, 6, 1, 5, 15, 11, 9, 14, 3, 12, 13, 0},
}};

/// Writes eight bytes, least significant first, on any machine.
std::uint64_t wordAt(const std::uint8_t* bytes) {
  std::uint64_t word = 0;
  if constexpr (std::endian::native == std::endian::little) {
    std::memcpy(&word, bytes, sizeof word);
  } else {
    for (int i = 8; i-- > 0;) word = word << 8 | bytes[i];
  }
  return word;
}

using Working = std::array<std::uint64_t, 16>;

void mix(Working& v, std::size_t a, std::size_t b, std::size_t c, std::size_t d, std::uint64_t x,
         std::uint64_t y) {
  v[a] += v[b] + x;
  v[d] = std::rotr(v[d] ^ v[a], 32);
  v[c] += v[d];
  v[b] = std::rotr(v[b] ^ v[c], 24);
  v[a] += v[b] + y;
  v[d] = std::rotr(v[d] ^ v[a], 16);
  v[c] += v[d];
  v[b] = std::rotr(v[b] ^ v[c], 63);
}

}  // namespace

ContentHash::ContentHash() : state_(kStart) {
  // No key, one leaf, as many bytes of digest.
  state_[0] ^= 0x01010000u ^ sizeof(Digest);
}

void ContentHash::add(std::string_view bytes) {
  while (!bytes.empty()) {
    // A full block waits, because the last one is compressed in another way.
    if (filled_ == kBlock) compress(false);
    const std::size_t count = std::min(bytes.size(), kBlock - filled_);
    std::memcpy(block_.data() + filled_, bytes.data(), count);
    filled_ += count;
    bytes.remove_prefix(count);
  }
}

ContentHash::Digest ContentHash::digest() {
  std::fill(block_.begin() + static_cast<std::ptrdiff_t>(filled_), block_.end(), std::uint8_t{0});
  compress(true);
  Digest digest;
  for (std::size_t i = 0; i < digest.size(); ++i)
    digest[i] = static_cast<std::uint8_t>(state_[i / 8] >> 8 * (i % 8));
  return digest;
}

void ContentHash::compress(bool isLast) {
  hashed_ += filled_;
  filled_ = 0;
  Working v;
  std::copy(state_.begin(), state_.end(), v.begin());
  std::copy(kStart.begin(), kStart.end(), v.begin() + 8);
  v[12] ^= hashed_;
  if (isLast) v[14] = ~v[14];
  std::array<std::uint64_t, 16> words;
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = wordAt(block_.data() + 8 * i);
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    const auto& order = kOrder[static_cast<std::size_t>(round) % kOrder.size()];
    for (std::size_t i = 0; i < 4; ++i)
      mix(v, i, 4 + i, 8 + i, 12 + i, words[order[2 * i]], words[order[2 * i + 1]]);
    for (std::size_t i = 0; i < 4; ++i)
      mix(v, i, 4 + (i + 1) % 4, 8 + (i + 2) % 4, 12 + (i + 3) % 4, words[order[8 + 2 * i]],
          words[order[9 + 2 * i]]);
  }
  for (std::size_t i = 0; i < state_.size(); ++i) state_[i] ^= v[i] ^ v[i + 8];
}

ContentHash::Digest hashOf(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes);
  return hash.digest();
}

std::optional<ContentHash::Digest> hashOfFile(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  ContentHash hash;
  std::vector<char> part(1 << 16);
  while (stream) {
    stream.read(part.data(), static_cast<std::streamsize>(part.size()));
    hash.add({part.data(), static_cast<std::size_t>(stream.gcount())});
  }
  if (!stream.eof()) return std::nullopt;
  return hash.digest();
}

std::string hexadecimal(const ContentHash::Digest& digest) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

}  // namespace swept::detail
