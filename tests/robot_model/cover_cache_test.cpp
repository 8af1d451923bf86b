// SPDX-License-Identifier: BSD-3-Clause
// Covers are what proofs rest on. So what a folder of covers says is believed as a whole or not at
// all, and a robot is the same with a folder, with a bad one and without.
#include "io/cover_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "input_files.hpp"
#include "io/cover_bytes.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

std::string bytesOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Of permissions, those of others than the user included.
unsigned modeOf(const fs::path& path) {
  struct stat info {};
  return stat(path.c_str(), &info) == 0 ? info.st_mode & 07777U : 0U;
}

ino_t numberOf(const fs::path& file) {
  struct stat info {};
  return stat(file.c_str(), &info) == 0 ? info.st_ino : 0;
}

/// A robot of two meshes, and a folder that is not there yet.
class CoverCacheTest : public testing::Test {
 protected:
  CoverCacheTest() {
    input_.write("cube.obj", test::kCubeObj);
    input_.write("t.stl", test::kTriangleStl);
    urdf_ = input_.write(
        "r.urdf",
        "<robot name='r'><link name='a'>"
        "<collision><geometry><mesh filename='cube.obj'/></geometry></collision>"
        "<collision><geometry><mesh filename='t.stl'/></geometry></collision></link></robot>");
  }

  std::shared_ptr<const Robot> load(const fs::path& cache) {
    LoadOptions options = warnings_.options();
    warnings_.lines.clear();
    options.cache = cache;
    return Robot::load(urdf_, {}, options);
  }
  /// The covers, each bit.
  std::string coversOf(const fs::path& cache) {
    std::string bytes;
    const auto robot = load(cache);
    for (const CollisionGeometry& geometry : robot->links()[0].collision)
      bytes += detail::toBytes(*geometry.cover);
    // An open mesh is warned of with and without.
    std::erase_if(warnings_.lines, [](const std::string& line) {
      return line.find("is an open surface") != std::string::npos;
    });
    return bytes;
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder_)) found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
  }
  /// That of the mesh whose cover has more balls.
  fs::path largest() const {
    return std::ranges::max(files(), {}, [](const fs::path& file) { return fs::file_size(file); });
  }

  test::TemporaryFolder input_;
  fs::path urdf_;
  const fs::path folder_ = input_.path() / "cache";
  test::Warnings warnings_;
};

TEST_F(CoverCacheTest, KeepsCoversForTheNextTime) {
  const std::string covers = coversOf({});
  EXPECT_FALSE(fs::exists(folder_));
  EXPECT_EQ(coversOf(folder_), covers);
  EXPECT_THAT(warnings_.lines, IsEmpty());
  ASSERT_EQ(files().size(), 2);
  std::vector<ino_t> numbers;
  for (const fs::path& file : files()) numbers.push_back(numberOf(file));
  EXPECT_EQ(coversOf(folder_), covers);
  // Covers that are built are written: these were read.
  for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numberOf(files().at(i)), numbers[i]);
}

TEST_F(CoverCacheTest, IsForThisUserAlone) {
  const mode_t before = umask(0);
  coversOf(folder_);
  umask(before);
  EXPECT_EQ(modeOf(folder_), 0700U);
  for (const fs::path& file : files()) EXPECT_EQ(modeOf(file), 0600U);
}

TEST_F(CoverCacheTest, AnotherMeshIsAnotherFile) {
  coversOf(folder_);
  urdf_ =
      input_.write("mirrored.urdf",
                   "<robot name='r'><link name='a'><collision><geometry><mesh "
                   "filename='cube.obj' scale='1 1 -1'/></geometry></collision></link></robot>");
  coversOf(folder_);
  EXPECT_EQ(files().size(), 3);
}

TEST_F(CoverCacheTest, OtherTrianglesOfTheSameCornersAreAnotherFile) {
  const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}};
  const std::vector<Eigen::Vector3i> first{{0, 1, 2}, {0, 2, 3}}, second{{0, 1, 2}, {1, 2, 3}};
  const auto one = TriangleMesh::build(corners, first, MeshInterior::Solid, 0.0);
  const auto other = TriangleMesh::build(corners, second, MeshInterior::Solid, 0.0);
  ASSERT_EQ(one.vertices().size(), other.vertices().size());
  for (std::size_t i = 0; i < one.vertices().size(); ++i)
    ASSERT_EQ(one.vertices()[i], other.vertices()[i]);
  detail::CoverCache kept(folder_), none({});
  const std::string cover = detail::toBytes(*none.coverOf(other));
  ASSERT_NE(detail::toBytes(*kept.coverOf(one)), cover);
  EXPECT_EQ(detail::toBytes(*kept.coverOf(other)), cover);
  EXPECT_EQ(files().size(), 2);
}

/// Whatever is done to a file, the cover is the same, and the file is whole again.
TEST_F(CoverCacheTest, BelievesNoFileThatWasChanged) {
  const auto robot = load(folder_);
  const fs::path file = largest();
  const std::string whole = bytesOf(file);
  const auto& pieces = robot->links()[0].collision;
  const auto piece = std::ranges::find_if(pieces, [&](const CollisionGeometry& geometry) {
    return whole.find(detail::toBytes(*geometry.cover)) != std::string::npos;
  });
  ASSERT_NE(piece, pieces.end()) << "a file has the cover as it is";
  const auto& mesh = std::get<TriangleMesh>(piece->shape);
  const std::string cover = detail::toBytes(*piece->cover);
  std::vector<std::string> changed{"", whole + '\0', whole + whole, std::string(whole.size(), 'x')};
  for (std::size_t size = 1; size < whole.size(); size += whole.size() / 40)
    changed.push_back(whole.substr(0, size));
  changed.push_back(whole.substr(0, whole.size() - 1));
  for (std::size_t i = 0; i < whole.size(); i += std::max<std::size_t>(1, whole.size() / 150)) {
    changed.push_back(whole);
    changed.back()[i] = static_cast<char>(changed.back()[i] ^ 0x10);
  }
  // A cover of another mesh, by this one's name.
  for (const fs::path& other : files())
    if (other != file) changed.push_back(bytesOf(other));
  for (const std::string& bytes : changed) {
    std::ofstream(file, std::ios::binary) << bytes;
    detail::CoverCache cache(folder_);
    ASSERT_EQ(detail::toBytes(*cache.coverOf(mesh)), cover);
    ASSERT_EQ(cache.problem(), "");
    ASSERT_EQ(bytesOf(file), whole);
  }
}

/// A link may lead anywhere, and others may have written to a file that they may write to.
TEST_F(CoverCacheTest, BelievesNoFileOfOthers) {
  const std::string covers = coversOf(folder_);
  const fs::path file = largest();
  const fs::path elsewhere = input_.path() / "elsewhere";
  fs::rename(file, elsewhere);
  fs::create_symlink(elsewhere, file);
  EXPECT_EQ(coversOf(folder_), covers);
  EXPECT_FALSE(fs::is_symlink(file)) << "built, and put in the link's place";
  ASSERT_EQ(chmod(file.c_str(), 0666), 0);
  const ino_t number = numberOf(file);
  EXPECT_EQ(coversOf(folder_), covers);
  EXPECT_NE(numberOf(file), number);
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_EQ(coversOf(folder_), covers) << "and waits for no writer";
}

TEST_F(CoverCacheTest, OfABadFolderIsOneWarning) {
  const std::string covers = coversOf({});
  const fs::path text = input_.write("text", "x");
  EXPECT_EQ(coversOf(text), covers);
  EXPECT_THAT(warnings_.lines, ElementsAre(text.string() + ": warning: the cache is not used: it "
                                                           "is no folder"));
  const fs::path deep = input_.path() / "not" / "there";
  EXPECT_EQ(coversOf(deep), covers);
  EXPECT_THAT(warnings_.lines,
              ElementsAre(deep.string() + ": warning: the cache is not used: it cannot be made: No "
                                          "such file or directory"));
  coversOf(folder_);
  ASSERT_EQ(chmod(folder_.c_str(), 0770), 0);
  EXPECT_EQ(coversOf(folder_), covers);
  EXPECT_THAT(warnings_.lines,
              ElementsAre(folder_.string() + ": warning: the cache is not used: it must belong to "
                                             "this user, and nobody else may write to it"));
}

TEST_F(CoverCacheTest, ACoverThatCannotBeKeptIsOneWarning) {
  const std::string covers = coversOf(folder_);
  const fs::path file = largest();
  fs::remove(file);
  fs::create_directories(file / "in the way");
  EXPECT_EQ(coversOf(folder_), covers);
  ASSERT_EQ(warnings_.lines.size(), 1);
  EXPECT_THAT(warnings_.lines[0],
              testing::StartsWith(folder_.string() +
                                  ": warning: a cover could not be put into the cache: "));
  EXPECT_EQ(files().size(), 2) << "nothing unfinished stays";
}

TEST_F(CoverCacheTest, IsSharedByManyAtOnce) {
  const std::string covers = coversOf({});
  for (int round = 0; round < 5; ++round) {
    fs::remove_all(folder_);
    std::vector<std::string> found(6);
    {
      std::vector<std::jthread> threads;
      for (std::string& each : found)
        threads.emplace_back([&] {
          LoadOptions options;
          options.cache = folder_;
          const auto robot = Robot::load(urdf_, {}, options);
          for (const CollisionGeometry& geometry : robot->links()[0].collision)
            each += detail::toBytes(*geometry.cover);
        });
    }
    for (const std::string& each : found) EXPECT_EQ(each, covers);
    EXPECT_EQ(files().size(), 2);
  }
}

TEST(CoverBytes, AreTheCoverOrNothing) {
  const SphereCover cover = sphereCover(Box{{0.1, 0.2, 0.3}});
  const std::string bytes = detail::toBytes(cover);
  const auto again = detail::coverFromBytes(bytes);
  ASSERT_TRUE(again);
  EXPECT_EQ(detail::toBytes(*again), bytes);
  EXPECT_EQ(again->nodes.size(), cover.nodes.size());
  EXPECT_EQ(again->levels.back().ballCount, cover.levels.back().ballCount);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(detail::coverFromBytes(std::string_view(bytes).substr(0, size)));
  EXPECT_FALSE(detail::coverFromBytes(bytes + '\0'));
  const auto refused = [&](auto change) {
    SphereCover other = cover;
    change(other);
    return !detail::coverFromBytes(detail::toBytes(other));
  };
  EXPECT_TRUE(refused([](SphereCover& c) { c.nodes.clear(); }));
  EXPECT_TRUE(refused([](SphereCover& c) { c.nodes[0].ball.radius = -1.0F; }));
  EXPECT_TRUE(refused([](SphereCover& c) { c.nodes[0].ball.center.x() = NAN; }));
  EXPECT_TRUE(refused([](SphereCover& c) { c.nodes[0].firstChild = 0; }));
  EXPECT_TRUE(refused([](SphereCover& c) { c.nodes[0].childCount = 1 << 30; }));
  EXPECT_TRUE(refused([](SphereCover& c) { c.nodes.back().level = 99; }));
  EXPECT_TRUE(refused([](SphereCover& c) { c.inner.push_back({{0, 0, 0}, INFINITY}); }));
}

}  // namespace
}  // namespace swept
