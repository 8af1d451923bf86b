// SPDX-License-Identifier: BSD-3-Clause
// The meshes of all cases of all files were kept until the last was asked: 10 MB for each file of
// this test.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "program.hpp"
#include "sanitizers.hpp"

namespace swept::test {
namespace {

using nlohmann::json;

/// MB, the most that any child so far had at once.
double mostOfChildren() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return 1e-3 * static_cast<double>(usage.ru_maxrss);
}

/// Of a ball above a terrain of 10,000 samples.
json terrainCase(const std::string& id) {
  constexpr int kSide = 100;
  json heights = json::array();
  for (int row = 0; row < kSide; ++row) {
    heights.push_back(json::array());
    for (int column = 0; column < kSide; ++column)
      heights.back().push_back(0.1 * (row * column % 7));
  }
  const json at = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  const json above = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 5}, {0, 0, 0, 1}};
  const json terrain = {
      {"type", "heightfield"}, {"x_dim", 1}, {"y_dim", 1}, {"heights", heights}, {"base", -1}};
  return {{"id", id},
          {"query", "collide"},
          {"shapes", {terrain, {{"type", "sphere"}, {"radius", 0.1}}}},
          {"transforms", {at, above}},
          {"expected", {{"collides", false}}}};
}

TEST(ReplayMemory, IsThatOfTheLargestFile) {
#if defined(SWEPT_TEST_ADDRESS_SANITIZER) || defined(SWEPT_TEST_THREAD_SANITIZER)
  GTEST_SKIP() << "a sanitizer keeps what was freed";
#endif
  const TemporaryFolder folder;
  json file = {{"version", 1}, {"cases", json::array()}};
  for (const char* id : {"a", "b", "c", "d"}) file["cases"].push_back(terrainCase(id));
  const std::string path = folder.write("terrains.json", file.dump());
  ASSERT_EQ(runSwept({"replay", path}).exitCode, 0);
  const double ofOne = mostOfChildren();
  std::vector<std::string> words{"replay"};
  words.resize(1 + 20, path);
  ASSERT_EQ(runSwept(words).exitCode, 0);
  EXPECT_LT(mostOfChildren() - ofOne, 60.0);
}

}  // namespace
}  // namespace swept::test
