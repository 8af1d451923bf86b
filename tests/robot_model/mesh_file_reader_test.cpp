// SPDX-License-Identifier: BSD-3-Clause
// All meshes of a robot that assimp reads are read in one process, and each as if it were the only
// one. What we read ourselves needs none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "fork_counter.hpp"
#include "gltf_text.hpp"
#include "input_files.hpp"
#include "io/mesh_file.hpp"
#include "io/mesh_import.hpp"
#include "sanitizers.hpp"
#include "swept/robot_model/mesh_file.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/visual_model.hpp"

namespace swept {
namespace {

using detail::MeshFileContent;
using detail::MeshFileError;
using detail::MeshFileReader;
using Bytes = std::span<const std::uint8_t>;

/// A tetrahedron of that size.
std::string tetrahedron(double size) {
  return test::GltfTetrahedron(static_cast<float>(size)).glb();
}

/// A robot of links with a mesh each, in that order.
std::string robotOf(const std::vector<std::string>& files) {
  std::string text = "<robot name='m'><link name='base'/>";
  for (const std::string& file : files) {
    text += "\n<link name='" + file + "'><collision><geometry><mesh filename='" + file +
            "'/></geometry></collision></link><joint name='to " + file +
            "' type='fixed'><parent link='base'/><child link='" + file + "'/></joint>";
  }
  return text + "</robot>";
}

/// Sizes of tetrahedra that an import of a test does something else with.
constexpr double kCrash = 11.0, kHang = 12.0, kEat = 13.0, kBad = 14.0;

bool isOfSize(Bytes bytes, double size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::string corner;
  for (const double value : {size, 0.0, 0.0}) test::appendBytes(corner, static_cast<float>(value));
  return text.find(corner) != std::string_view::npos;
}

/// How many triangles are read, or why none.
std::string said(MeshFileReader& reader, const std::filesystem::path& file) {
  try {
    return std::to_string(reader.read(file).triangles.size());
  } catch (const MeshFileError& error) {
    return error.what();
  }
}

class MeshFileReading : public testing::Test {
 protected:
  /// Files `0.glb` and so on, of tetrahedra of different sizes.
  std::vector<std::string> writeFiles(int count) {
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) {
      names.push_back(std::to_string(i) + ".glb");
      folder_.write(names.back(), tetrahedron(1.0 + 0.1 * i));
    }
    return names;
  }
  /// Of the one link with that mesh.
  static const TriangleMesh& meshOf(const Robot& robot, const std::string& file) {
    const auto link = std::ranges::find(robot.links(), file, &Link::name);
    return std::get<TriangleMesh>(link->collision.at(0).shape);
  }
  static void expectSame(const Robot& a, const Robot& b, const std::vector<std::string>& files) {
    for (const std::string& file : files) {
      const TriangleMesh &one = meshOf(a, file), &other = meshOf(b, file);
      EXPECT_TRUE(std::ranges::equal(one.vertices(), other.vertices())) << file;
      EXPECT_TRUE(std::ranges::equal(one.triangles(), other.triangles())) << file;
    }
  }

  test::TemporaryFolder folder_;
};

TEST_F(MeshFileReading, OneProcessReadsAllMeshesOfARobot) {
  const auto urdf = folder_.write("m.urdf", robotOf(writeFiles(12)));
  const test::ForkCounter counter;
  const auto robot = Robot::load(urdf);
  EXPECT_EQ(robot->links().size(), 13U);
  EXPECT_EQ(counter.forks(), 1);
}

TEST_F(MeshFileReading, OneMeshOfManyLinksIsReadOnce) {
  folder_.write("a.glb", tetrahedron(1.0));
  std::string text = "<robot name='m'><link name='base'>";
  for (int i = 0; i < 12; ++i)
    text += "<collision><geometry><mesh filename='a.glb'/></geometry></collision>";
  const auto urdf = folder_.write("m.urdf", text + "</link></robot>");
  const test::ForkCounter counter;
  const auto robot = Robot::load(urdf);
  EXPECT_EQ(counter.forks(), 1);
  const auto& pieces = robot->links()[0].collision;
  const auto corners = [](const CollisionGeometry& piece) {
    return std::get<TriangleMesh>(piece.shape).vertices().data();
  };
  EXPECT_EQ(pieces.size(), 12U);
  for (const CollisionGeometry& piece : pieces) EXPECT_EQ(corners(piece), corners(pieces[0]));
}

TEST_F(MeshFileReading, OtherFormatsAndRobotsWithoutMeshesNeedNoProcess) {
  folder_.write("cube.obj", test::kCubeObj);
  folder_.write("sheet.stl", test::kTriangleStl);
  folder_.write("sheet.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const test::ForkCounter counter;
  const auto robot =
      Robot::load(folder_.write("o.urdf", robotOf({"cube.obj", "sheet.stl", "sheet.off"})));
  EXPECT_EQ(meshOf(*robot, "cube.obj").triangles().size(), 12U);
  Robot::load(folder_.write("m.urdf",
                            "<robot name='m'><link name='a'><collision><geometry>"
                            "<sphere radius='1'/></geometry></collision></link></robot>"));
  EXPECT_EQ(counter.forks(), 0);
}

TEST_F(MeshFileReading, TheRobotIsTheSameInAnyOrderAndFromManyThreads) {
  std::vector<std::string> files = writeFiles(12);
  const auto robot = Robot::load(folder_.write("m.urdf", robotOf(files)));
  EXPECT_EQ(meshOf(*robot, "3.glb").vertices().size(), 4U);
  EXPECT_FALSE(
      std::ranges::equal(meshOf(*robot, "3.glb").vertices(), meshOf(*robot, "4.glb").vertices()));
  std::mt19937 random(7);
  std::vector<std::string> orders;
  for (int i = 0; i < 4; ++i) {
    std::ranges::shuffle(files, random);
    orders.push_back(robotOf(files));
  }
  std::vector<std::shared_ptr<const Robot>> others(orders.size());
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < orders.size(); ++i)
      threads.emplace_back([&, i] {
        LoadOptions options;
        others[i] = Robot::parse(orders[i], (folder_.path() / "m.urdf").string(), {}, {}, options);
      });
  }
  for (const auto& other : others) expectSame(*robot, *other, files);
}

/// In this process, as a host with threads may want it.
TEST_F(MeshFileReading, NoProcessIsMadeWhereNoneIsWanted) {
  const std::vector<std::string> files = writeFiles(3);
  const auto urdf = folder_.write("m.urdf", robotOf(files));
  const auto usual = Robot::load(urdf);
  LoadOptions options;
  options.childProcess = false;
  const test::ForkCounter counter;
  expectSame(*usual, *Robot::load(urdf, {}, options), files);
  EXPECT_EQ(loadMesh(folder_.path() / files[1], 1.0, options).triangles().size(), 4U);
  EXPECT_EQ(VisualModel::parse("<robot name='m'><link name='a'><visual><geometry><mesh filename='" +
                                   files[2] + "'/></geometry></visual></link></robot>",
                               (folder_.path() / "m.urdf").string(), options)
                .triangles,
            4U);
  EXPECT_EQ(counter.forks(), 0);
  folder_.write("0.glb", "glTF");
  EXPECT_NE(test::inputError([&] { (void)loadMesh(folder_.path() / "0.glb", 1.0, options); }), "");
}

/// Crashes, hangs and takes memory for files of those sizes.
MeshFileContent importOrFail(const std::string& name, Bytes bytes) {
  if (isOfSize(bytes, kCrash)) std::abort();
  if (isOfSize(bytes, kHang))
    for (std::atomic<int> i = 0;; ++i) continue;
  if (isOfSize(bytes, kEat)) std::vector<char>().reserve(std::size_t{3} << 30);
  return detail::importMesh(name, bytes);
}

TEST_F(MeshFileReading, WhatFailsIsRefusedAndTheOthersAreRead) {
  MeshFileReader reader(importOrFail);
  const auto write = [&](double size) {
    return folder_.write(std::to_string(size) + ".glb", tetrahedron(size));
  };
  const auto good = write(1.0);
  EXPECT_EQ(said(reader, good), "4");
  EXPECT_EQ(said(reader, write(kCrash)), "cannot be read: assimp crashed (signal 6)");
  EXPECT_EQ(said(reader, good), "4");
  EXPECT_EQ(said(reader, folder_.write("cut.glb", "glTF")),
            "cannot be read: it does not start as binary glTF of version 2 does");
  EXPECT_EQ(said(reader, good), "4");
#if !defined(SWEPT_TEST_ADDRESS_SANITIZER) && !defined(SWEPT_TEST_THREAD_SANITIZER)
  EXPECT_EQ(said(reader, write(kEat)), "cannot be read: out of memory");
#endif
  EXPECT_THAT(said(reader, write(kHang)),
              testing::AnyOf("cannot be read: assimp took too much time or memory",
                             "cannot be read: assimp took more than 30 s"));
  EXPECT_EQ(said(reader, good), "4");
}

/// Each in the second process that reads: what ended the first may be what was left in it.
TEST_F(MeshFileReading, AFileIsRefusedOnlyByAProcessThatHasReadNoOther) {
  enum class Fault { Crash, Error, Corners, Triangles };
  for (const Fault fault : {Fault::Crash, Fault::Error, Fault::Corners, Fault::Triangles}) {
    SCOPED_TRACE(static_cast<int>(fault));
    MeshFileReader reader([fault, read = 0](const std::string& name, Bytes bytes) mutable {
      MeshFileContent content = detail::importMesh(name, bytes);
      if (++read < 3) return content;
      if (fault == Fault::Crash) std::abort();
      if (fault == Fault::Error) throw MeshFileError("cannot be read: no more");
      if (fault == Fault::Corners) content.vertices[1] *= 2.0;
      if (fault == Fault::Triangles) content.triangles.pop_back();
      return content;
    });
    const test::ForkCounter counter;
    for (int i = 0; i < 6; ++i) {
      const auto file = folder_.write(std::to_string(i) + ".glb", tetrahedron(1.0 + i));
      const MeshFileContent content = reader.read(file);
      EXPECT_EQ(content.triangles.size(), 4U);
      EXPECT_EQ(std::ranges::max(content.vertices, {}, [](const auto& v) { return v.sum(); }).sum(),
                1.0 + i);
    }
    EXPECT_EQ(counter.forks(), 3);
  }
}

/// Where a file that was refused could have left anything.
TEST_F(MeshFileReading, AProcessThatRefusedAFileReadsNoOther) {
  MeshFileReader reader([refused = false](const std::string& name, Bytes bytes) mutable {
    if (isOfSize(bytes, kBad)) refused = true;
    if (isOfSize(bytes, kBad)) throw MeshFileError("is bad");
    MeshFileContent content = detail::importMesh(name, bytes);
    // Within the box of the whole, so that nobody sees it.
    if (refused) content.vertices.at(0) = Eigen::Vector3d(0.25, 0.25, 0.25);
    return content;
  });
  const auto good = folder_.write("good.glb", tetrahedron(1.0));
  const auto bad = folder_.write("bad.glb", tetrahedron(kBad));
  const MeshFileContent before = reader.read(good);
  EXPECT_EQ(said(reader, bad), "is bad");
  EXPECT_EQ(said(reader, bad), "is bad");
  const MeshFileContent after = reader.read(good);
  EXPECT_EQ(before.vertices, after.vertices);
}

/// 20 files that take 0.9 GiB each, of 1 GiB; what the first ones do not give back counts only
/// until there is a new process.
TEST_F(MeshFileReading, MemoryIsBoundedForEachFile) {
  for (const bool givenBack : {true, false}) {
    MeshFileReader reader([givenBack, kept = std::vector<std::vector<char>>()](
                              const std::string& name, Bytes bytes) mutable {
      std::vector<char> taken;
      taken.reserve(std::size_t{900} << 20);
      if (!givenBack) kept.push_back(std::move(taken));
      return detail::importMesh(name, bytes);
    });
    const test::ForkCounter counter;
    for (const std::string& file : writeFiles(20))
      EXPECT_EQ(said(reader, folder_.path() / file), "4") << file;
#if !defined(SWEPT_TEST_ADDRESS_SANITIZER) && !defined(SWEPT_TEST_THREAD_SANITIZER)
    EXPECT_EQ(counter.forks(), givenBack ? 1 : 20);
#endif
  }
}

}  // namespace
}  // namespace swept
