// SPDX-License-Identifier: BSD-3-Clause
//
// Files that OctoMap writes, and what OctoMap itself reads from them.
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <map>
#include <memory>
#include <random>

#include "input_files.hpp"
#include "swept/robot_model/cloud_file.hpp"

namespace swept {
namespace {

using Cube = OccupancyMap::Cube;

/// As OctoMap has them, in its order.
template <typename Tree>
std::vector<Cube> occupiedOf(const Tree& tree) {
  std::vector<Cube> cubes;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    if (!tree.isNodeOccupied(*leaf)) continue;
    cubes.push_back({{leaf.getX(), leaf.getY(), leaf.getZ()}, leaf.getSize()});
  }
  return cubes;
}

/// What OctoMap reads from a file.
template <typename Tree>
std::vector<Cube> readByOctomap(const std::filesystem::path& file) {
  if (file.extension() == ".bt") {
    Tree tree(1.0);
    EXPECT_TRUE(tree.readBinary(file.string()));
    return occupiedOf(tree);
  }
  const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(file.string()));
  const auto* tree = dynamic_cast<Tree*>(read.get());
  EXPECT_NE(tree, nullptr);
  return tree == nullptr ? std::vector<Cube>{} : occupiedOf(*tree);
}

void expectSame(const std::vector<Cube>& ours, const std::vector<Cube>& theirs) {
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    ASSERT_LE((ours[i].center - theirs[i].center).lpNorm<Eigen::Infinity>(), 1e-12) << i;
    ASSERT_NEAR(ours[i].side, theirs[i].side, 1e-12) << i;
  }
}

/// Points seen and points missed around some places, near and far, and blocks that are pruned.
template <typename Tree>
void fill(Tree& tree, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> around(0.0, 12.0 * tree.getResolution());
  std::uniform_real_distribution<double> wide(-3e4 * tree.getResolution(),
                                              3e4 * tree.getResolution());
  std::bernoulli_distribution seen(0.5);
  for (int place = 0; place < 8; ++place) {
    const octomap::point3d middle(static_cast<float>(wide(random)),
                                  static_cast<float>(wide(random)),
                                  static_cast<float>(wide(random)));
    for (int i = 0; i < 400; ++i) {
      const octomap::point3d off(static_cast<float>(around(random)),
                                 static_cast<float>(around(random)),
                                 static_cast<float>(around(random)));
      tree.updateNode(middle + off, seen(random));
    }
  }
  for (const int level : {1, 2, 3, 4}) {
    const int side = 1 << level;
    const auto first = static_cast<octomap::key_type>(32768 + (level - 3) * 64);
    for (int i = 0; i < side * side * side; ++i) {
      const octomap::OcTreeKey key(static_cast<octomap::key_type>(first + i % side),
                                   static_cast<octomap::key_type>(first + i / side % side),
                                   static_cast<octomap::key_type>(first + i / side / side));
      tree.updateNode(key, level % 2 == 0);
    }
  }
}

class Octomaps : public ::testing::TestWithParam<double> {
 protected:
  const test::TemporaryFolder folder_;
};

TEST_P(Octomaps, OccupiedCubesAreThoseOfOctomap) {
  octomap::OcTree tree(GetParam());
  fill(tree, 3);
  const auto full = folder_.path() / "a.ot";
  const auto binary = folder_.path() / "a.bt";
  ASSERT_TRUE(tree.write(full.string()));
  ASSERT_TRUE(tree.writeBinaryConst(binary.string()));

  const std::vector<Cube> theirs = occupiedOf(tree);
  for (const auto& file : {full, binary}) {
    const OccupancyMap map = loadOctomap(file);
    EXPECT_NEAR(map.resolution, tree.getResolution(), 1e-6 * tree.getResolution());
    expectSame(map.occupied, readByOctomap<octomap::OcTree>(file));
    ASSERT_EQ(map.occupied.size(), theirs.size());
  }
  // Large cubes and small ones, and about as much free as occupied.
  std::map<double, int> sizes;
  for (const Cube& cube : theirs) ++sizes[cube.side];
  EXPECT_GE(sizes.size(), 3u);
  EXPECT_GT(theirs.size(), 3 * tree.getNumLeafNodes() / 10);
  EXPECT_LT(theirs.size(), 7 * tree.getNumLeafNodes() / 10);
}

TEST_P(Octomaps, ColoursAreSkipped) {
  octomap::ColorOcTree tree(GetParam());
  fill(tree, 4);
  std::mt19937 random(5);
  std::uniform_int_distribution<int> colour(0, 255);
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const auto shade = [&] { return static_cast<std::uint8_t>(colour(random)); };
    leaf->setColor(shade(), shade(), shade());
  }
  tree.updateInnerOccupancy();
  const auto full = folder_.path() / "a.OT";
  const auto binary = folder_.path() / "a.bt";
  ASSERT_TRUE(tree.write(full.string()));
  ASSERT_TRUE(tree.writeBinaryConst(binary.string()));
  expectSame(loadOctomap(binary).occupied, readByOctomap<octomap::ColorOcTree>(binary));
  const std::vector<Cube> theirs = readByOctomap<octomap::ColorOcTree>(full);
  EXPECT_GT(theirs.size(), 1000u);
  expectSame(loadOctomap(full).occupied, theirs);
}

INSTANTIATE_TEST_SUITE_P(Resolutions, Octomaps,
                         ::testing::Values(0.05, 0.1, 1.0 / 3.0, 0.001, 25.0));

class OctomapFiles : public ::testing::Test {
 protected:
  const test::TemporaryFolder folder_;
};

TEST_F(OctomapFiles, EvenOddsAreOccupied) {
  octomap::OcTree tree(0.1);
  tree.setNodeValue(octomap::point3d(0.05f, 0.05f, 0.05f), 0.0f);
  tree.setNodeValue(octomap::point3d(0.25f, 0.05f, 0.05f), -1e-6f);
  const auto file = folder_.path() / "a.ot";
  ASSERT_TRUE(tree.write(file.string()));
  const std::vector<Cube> ours = loadOctomap(file).occupied;
  ASSERT_EQ(ours.size(), 1u);
  expectSame(ours, readByOctomap<octomap::OcTree>(file));
}

TEST_F(OctomapFiles, CornersOfTheSpaceAreWhereOctomapHasThem) {
  octomap::OcTree tree(0.5);
  for (const int x : {0, 32767, 32768, 65535}) {
    for (const int y : {0, 65535}) {
      tree.updateNode(
          octomap::OcTreeKey(static_cast<octomap::key_type>(x), static_cast<octomap::key_type>(y),
                             static_cast<octomap::key_type>(65535 - x)),
          true);
    }
  }
  for (const std::string name : {"a.ot", "a.bt"}) {
    const auto file = folder_.path() / name;
    ASSERT_TRUE(name == "a.ot" ? tree.write(file.string()) : tree.writeBinary(file.string()));
    const std::vector<Cube> ours = loadOctomap(file).occupied;
    ASSERT_EQ(ours.size(), 8u);
    expectSame(ours, occupiedOf(tree));
  }
}

TEST_F(OctomapFiles, EmptyMapsHaveNoCubes) {
  octomap::OcTree tree(0.1);
  for (const std::string name : {"a.ot", "a.bt"}) {
    const auto file = folder_.path() / name;
    ASSERT_TRUE(name == "a.ot" ? tree.write(file.string()) : tree.writeBinary(file.string()));
    const OccupancyMap map = loadOctomap(file);
    EXPECT_EQ(map.resolution, 0.1);
    EXPECT_TRUE(map.occupied.empty());
  }
}

TEST_F(OctomapFiles, ARootAloneIsAllOfSpace) {
  using namespace std::string_literals;
  const std::string header = "id OcTree\nsize 1\nres 0.25\ndata\n";
  const std::vector<std::filesystem::path> files{
      folder_.write("a.bt", "# Octomap OcTree binary file\n" + header + "\0\0"s),
      folder_.write("a.ot", "# Octomap OcTree file\n" + header + "\0\0\x80\x3f\0"s)};
  for (const auto& file : files) {
    const std::vector<Cube> ours = loadOctomap(file).occupied;
    ASSERT_EQ(ours.size(), 1u);
    EXPECT_EQ(ours[0].side, 16384.0);
    expectSame(ours, readByOctomap<octomap::OcTree>(file));
  }
}

/// Whatever of a damaged file is accepted is what OctoMap reads.
TEST_F(OctomapFiles, DamagedNodesThatLoadAreAsOctomapReadsThem) {
  octomap::OcTree tree(0.1);
  fill(tree, 6);
  constexpr std::size_t kHeader = 160;
  std::mt19937 random(8);
  constexpr int kRounds = 60;
  for (const std::string name : {"a.ot", "a.bt"}) {
    const auto file = folder_.path() / name;
    ASSERT_TRUE(name == "a.ot" ? tree.write(file.string()) : tree.writeBinary(file.string()));
    const std::string text = [&] {
      std::ifstream stream(file, std::ios::binary);
      return std::string{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    }();
    ASSERT_LT(text.find("\ndata\n"), kHeader);
    std::uniform_int_distribution<std::size_t> place(kHeader, text.size() - 1);
    std::uniform_int_distribution<int> bit(0, 3);
    int loaded = 0;
    for (int round = 0; round < kRounds; ++round) {
      std::string damaged = text;
      std::size_t at = 0;
      int change = 0;
      // Two bits say what a child is in a `.bt`, where most children are absent. With one bit
      // changed, the number of nodes is another.
      do {
        at = place(random);
        change = (name == "a.bt" ? 3 : 1) << 2 * bit(random);
      } while (name == "a.bt" && (text[at] & change) == 0);
      damaged[at] = static_cast<char>(damaged[at] ^ change);
      std::filesystem::remove(file);
      folder_.write(name, damaged);
      std::vector<Cube> ours;
      if (!test::inputError([&] { ours = loadOctomap(file).occupied; }).empty()) continue;
      ++loaded;
      expectSame(ours, readByOctomap<octomap::OcTree>(file));
    }
    EXPECT_GT(loaded, kRounds / 5) << name;
    EXPECT_LT(loaded, kRounds) << name;
  }
}

}  // namespace
}  // namespace swept
