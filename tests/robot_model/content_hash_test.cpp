// SPDX-License-Identifier: BSD-3-Clause
#include "io/content_hash.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "input_files.hpp"

namespace swept::detail {
namespace {

std::string pattern(std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>((7 * i + 3) % 251);
  return bytes;
}

struct Known {
  std::size_t size;
  const char* digest;
};

/// By Python's hashlib.blake2b(digest_size=32), of the pattern; blocks have 128 bytes.
constexpr std::array<Known, 12> kKnown{
    {{0, "0e5751c026e543b2e8ab2eb06099daa1d1e5df47778f7787faab45cdf12fe3a8"},
     {1, "e88bd757ad5b9bedf372d8d3f0cf6c962a469db61a265f6418e1ffed86da29ec"},
     {3, "9facd640130c81e7f318a8d5c660bc1b0f5d03861ffbd4cc1358e0e904593c28"},
     {63, "7d780c3264dedf1cddd683d6fe976ddc273c3caf2c54aeadbaba0d43c3ad287d"},
     {127, "7eb3d4fe699cedc52282a1c091627822fe7790ef178af8269c0261d367931246"},
     {128, "6afdad1409d770bce274b62a69123c97c86ffb40ce9708f3ff9ae4cbba8ba080"},
     {129, "69e98b10112e4b7ae396bfbddaee75cc5fe6a9dc1fffc2b11e7c0fc48de04ae5"},
     {255, "79133c6c55eafb6dd1aa1d75fe1622b86492ce7093b81ba85f29205f6d3a7a78"},
     {256, "fabff1fa6173588d4cecdeade31b3237760d62664249e44f621deba4b94367ad"},
     {257, "c069dcc3628f1598cd4f058da809c5f1c3a4ad536acd12dc514bcc0753f71f8c"},
     {1000, "655483217562ae552fae4c276411ebd441ae1615754212965b82aee8aa76e9d8"},
     {70000, "dd936a57c1f4435127524411aac93695279b661a2b5f9a27c294e3f051cfea45"}}};

TEST(ContentHash, IsBlake2b) {
  EXPECT_EQ(hexadecimal(hashOf("abc")),
            "bddd813c634239723171ef3fee98579b94964e3bb1cb3e427262c8c068d52319");
  for (const Known& known : kKnown)
    EXPECT_EQ(hexadecimal(hashOf(pattern(known.size))), known.digest) << known.size;
}

TEST(ContentHash, DoesNotDependOnHowBytesAreAdded) {
  for (const std::size_t part : {1U, 5U, 127U, 128U, 129U, 300U}) {
    const std::string bytes = pattern(1000);
    ContentHash hash;
    for (std::size_t at = 0; at < bytes.size(); at += part) hash.add(bytes.substr(at, part));
    EXPECT_EQ(hash.digest(), hashOf(bytes)) << part;
  }
}

TEST(ContentHash, OfAFileIsThatOfItsBytes) {
  const test::TemporaryFolder folder;
  for (const std::size_t size : {0U, 1U, 65536U, 65537U, 200000U})
    EXPECT_EQ(hashOfFile(folder.write("f", pattern(size))), hashOf(pattern(size))) << size;
  EXPECT_FALSE(hashOfFile(folder.path() / "none"));
  EXPECT_FALSE(hashOfFile(folder.path()));
}

}  // namespace
}  // namespace swept::detail
