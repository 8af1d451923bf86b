// SPDX-License-Identifier: BSD-3-Clause
//
// Files of points and maps that are cut short anywhere, or have one byte changed, load or are
// refused with an InputError, and take no more memory than their size allows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <random>

#include "bad_cloud_files.hpp"
#include "cloud_writers.hpp"

namespace {
std::size_t largestRequest = 0;  ///< bytes that were asked for at once
}

// Not inlined: the compiler takes one half of a pair for another function otherwise.
[[gnu::noinline]] void* operator new(std::size_t size) {
  largestRequest = std::max(largestRequest, size);
  void* const memory = std::malloc(size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace swept {
namespace {

using namespace std::string_literals;

struct GoodFile {
  std::string name;
  std::string file;
  std::string text;
  std::size_t count;  ///< of points or cubes
  bool textual;       ///< what is cut from the last number leaves a number
};

void PrintTo(const GoodFile& file, std::ostream* out) {
  *out << file.name;
}

std::vector<GoodFile> goodFiles() {
  const test::Points points{{1.5, 2, 3}, {4, 5, 6}, {-7, 8, 1e-3}, {1, 1, 1}, {1, 1, 1}};
  std::vector<test::CloudField> fields = test::kFloats;
  fields.insert(fields.begin() + 1, {"rgb", 'U', 4});
  std::vector<GoodFile> files;
  for (const std::string form : {"ascii", "binary", "binary_compressed"}) {
    files.push_back({"pcd_" + form, "a.pcd", test::pcd(points, fields, form), 5, form == "ascii"});
  }
  for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const bool big = form == "binary_big_endian";
    const std::string text =
        test::ply({test::plyVertex(points, fields, big), test::plyFaces("face", 2, big)}, form);
    files.push_back({"ply_" + form, "a.ply", text, 5, form == "ascii"});
  }
  files.push_back({"xyz", "a.xyz", "# x y z\n" + test::xyz(points, ", "), 5, true});
  // A root with an occupied child, one that has an occupied child itself, and a free one.
  const std::string header = "id OcTree\nsize 5\nres 0.1\ndata\n";
  files.push_back(
      {"bt", "a.bt", "# Octomap OcTree binary file\n" + header + "\x36\0\2\0"s, 2, false});
  const std::string leaf = "\0\0\x80\x3f\0"s;
  files.push_back({"ot", "a.ot",
                   "# Octomap OcTree file\n" + header + "\0\0\0\0\7"s + leaf + "\0\0\x80\x3f\1"s +
                       leaf + "\0\0\x80\xbf\0"s,
                   2, false});
  return files;
}

std::size_t countOf(const std::filesystem::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".bt" || ending == ".ot") return loadOctomap(file).occupied.size();
  const test::Points points = loadPoints(file);
  for (const Eigen::Vector3d& point : points) EXPECT_TRUE(point.allFinite());
  return points.size();
}

class DamagedCloudFiles : public ::testing::TestWithParam<GoodFile> {
 protected:
  /// How many points or cubes the file has; -1: it is refused. Anything else that is thrown fails
  /// the test.
  long load(const std::string& text) {
    // Some file systems write a file to the disk at once that takes the place of another.
    std::filesystem::remove(folder_.path() / GetParam().file);
    const auto file = folder_.write(GetParam().file, text);
    largestRequest = 0;
    long count = -1;
    try {
      count = static_cast<long>(countOf(file));
    } catch (const InputError& error) {
      EXPECT_EQ(error.file(), file.string());
    }
    // LZF data expand to 88 times their size at most; the rest is streams and messages.
    EXPECT_LE(largestRequest, 88 * text.size() + (1 << 16));
    return count;
  }

 private:
  const test::TemporaryFolder folder_;
};

TEST_P(DamagedCloudFiles, CutShort) {
  const GoodFile& good = GetParam();
  ASSERT_EQ(load(good.text), static_cast<long>(good.count));
  for (std::size_t size = 0; size < good.text.size(); ++size) {
    const long count = load(good.text.substr(0, size));
    if (!good.textual) {
      EXPECT_EQ(count, -1) << size;
    }
    if (good.file != "a.xyz" && count != -1) {
      EXPECT_EQ(count, static_cast<long>(good.count)) << size;
    }
  }
}

/// To anything, or to what ends a word or a number, and digits: these are what headers break at.
TEST_P(DamagedCloudFiles, OneByteChanged) {
  const std::string& text = GetParam().text;
  const std::string likely = "0123456789 \n\r\t-+.,#exyznai\0\xff"s;
  std::mt19937 random(11);
  std::uniform_int_distribution<std::size_t> place(0, text.size() - 1);
  std::uniform_int_distribution<std::size_t> any(0, 255);
  std::uniform_int_distribution<std::size_t> choice(0, likely.size() - 1);
  constexpr int kRounds = 2000;
  int loaded = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::string damaged = text;
    damaged[place(random)] =
        round % 2 == 0 ? static_cast<char>(any(random)) : likely[choice(random)];
    if (load(damaged) >= 0) ++loaded;
  }
  // Both happen often enough to mean something.
  EXPECT_GT(loaded, kRounds / 50);
  EXPECT_LT(loaded, kRounds * 49 / 50);
}

INSTANTIATE_TEST_SUITE_P(Files, DamagedCloudFiles, ::testing::ValuesIn(goodFiles()),
                         [](const auto& test) { return test.param.name; });

/// Headers that claim as much as is allowed, with next to nothing behind them.
TEST(ClaimedCounts, TakeNoMemory) {
  const test::TemporaryFolder folder;
  std::vector<std::pair<std::string, std::string>> files;
  for (const std::string form : {"ascii", "binary", "binary_compressed"}) {
    files.emplace_back("a.pcd", test::pcdHeader(50'000'000, test::kFloats, form) + "1 2 3\n");
  }
  const auto vertex = test::plyVertex({{1, 2, 3}}, test::kFloats, false);
  for (const std::string form : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string text = test::ply({vertex}, form);
    files.emplace_back("a.ply", test::replaced(text, "vertex 1", "vertex 50000000"));
    // A list of as many numbers as there can be.
    const test::PlyPart list{"element list 1\nproperty list uint double a\n", "4294967295 1\n",
                             "\xff\xff\xff\xff"};
    files.emplace_back("a.ply", test::ply({list, vertex}, form));
  }
  files.emplace_back("a.ot",
                     "# Octomap OcTree file\nid OcTree\nsize 9000000000000000\nres 1\ndata\n\0"s);
  for (const auto& [name, text] : files) {
    const auto file = folder.write(name, text);
    largestRequest = 0;
    EXPECT_NE(test::inputError([&] { test::load(file); }), "") << text;
    EXPECT_LE(largestRequest, std::size_t{1} << 16) << text;
  }
}

}  // namespace
}  // namespace swept
