// SPDX-License-Identifier: BSD-3-Clause
// A robot's meshes are made on all processors while the next file is read. What comes of it, and
// what is said of it, does not depend on that.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "input_files.hpp"
#include "io/cover_bytes.hpp"
#include "io/mesh_file.hpp"
#include "robot/shape_cover.hpp"
#include "swept/core/triangle_mesh.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string robotOf(const std::vector<std::string>& meshes) {
  std::string text = "<robot name='r'>\n<link name='a'>\n";
  for (const std::string& mesh : meshes)
    text += "<collision><geometry><mesh filename='" + mesh + "'/></geometry></collision>\n";
  return text + "</link></robot>";
}

/// A prism over a regular polygon, as OBJ.
std::string prism(int sides, double height) {
  std::string text;
  for (const double z : {0.0, height})
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * 3.14159265358979 * i / sides;
      text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " " +
              std::to_string(z) + "\n";
    }
  std::string bottom = "f", top = "f";
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    bottom += " " + std::to_string(sides - i);
    top += " " + std::to_string(sides + i + 1);
    text += "f " + std::to_string(i + 1) + " " + std::to_string(next + 1) + " " +
            std::to_string(sides + next + 1) + " " + std::to_string(sides + i + 1) + "\n";
  }
  return text + bottom + "\n" + top + "\n";
}

const TriangleMesh& meshOf(const Robot& robot, std::size_t piece) {
  return std::get<TriangleMesh>(robot.links()[0].collision.at(piece).shape);
}

TEST(RobotMeshes, AreWhatEachIsByItself) {
  const test::TemporaryFolder folder;
  std::vector<std::string> names;
  for (int i = 0; i < 12; ++i) {
    names.push_back("m" + std::to_string(i) + ".obj");
    folder.write(names.back(), prism(3 + 7 * i, 0.1 + 0.1 * i));
  }
  const auto robot = Robot::load(folder.write("r.urdf", robotOf(names)));
  detail::MeshFileReader reader;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const detail::MeshFileContent content = reader.read(folder.path() / names[i]);
    const TriangleMesh alone = TriangleMesh::build(content.vertices, content.triangles);
    const TriangleMesh& mesh = meshOf(*robot, i);
    EXPECT_EQ(mesh.vertices(), alone.vertices());
    EXPECT_EQ(mesh.triangles(), alone.triangles());
    EXPECT_TRUE(mesh.isClosed());
    EXPECT_EQ(detail::toBytes(*robot->links()[0].collision[i].cover),
              detail::toBytes(*detail::coverOf(alone)));
    EXPECT_GT(robot->links()[0].collision[i].coverSeconds, 0.0);
  }
}

TEST(RobotMeshes, OfTheSameContentAreOneAndEachIsWarnedOf) {
  const test::TemporaryFolder folder;
  folder.write("left.stl", test::kTriangleStl);
  folder.write("right.stl", test::kTriangleStl);
  folder.write("cube.obj", test::kCubeObj);
  std::string other = test::kTriangleStl;  // as long
  other.replace(other.find("vertex 1"), 8, "vertex 2");
  folder.write("other.stl", other);
  test::Warnings warnings;
  const auto robot = Robot::load(
      folder.write("r.urdf",
                   robotOf({"left.stl", "other.stl", "cube.obj", "right.stl", "left.stl"})),
      {}, warnings.options());
  EXPECT_EQ(&meshOf(*robot, 0).vertices(), &meshOf(*robot, 3).vertices());
  EXPECT_EQ(&meshOf(*robot, 0).vertices(), &meshOf(*robot, 4).vertices());
  EXPECT_NE(&meshOf(*robot, 0).vertices(), &meshOf(*robot, 1).vertices());
  EXPECT_EQ(robot->links()[0].collision[0].cover, robot->links()[0].collision[3].cover);
  EXPECT_EQ(robot->links()[0].collision[3].coverSeconds, 0.0);
  EXPECT_NEAR(meshOf(*robot, 1).hull().extent(), 2.0, 1e-9);
  EXPECT_THAT(warnings.lines,
              ElementsAre(HasSubstr("r.urdf:3: warning: mesh 'left.stl' is an open surface"),
                          HasSubstr("r.urdf:4: warning: mesh 'other.stl' is an open surface"),
                          HasSubstr("r.urdf:6: warning: mesh 'right.stl' is an open surface")));
}

/// The first in the robot is named, though later ones may be read, or refused, before it is done.
TEST(RobotMeshes, SayWhatIsWrongInTheirOrder) {
  const test::TemporaryFolder folder;
  folder.write("t.stl", test::kTriangleStl);
  folder.write("u.stl", std::string(test::kTriangleStl) + "\n");
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 2\n");
  folder.write("cut.obj", "v 0 0 0\nv 1 0");
  folder.write("big.obj", prism(2000, 1.0));
  const auto said = [&](const std::vector<std::string>& meshes, test::Warnings& warnings) {
    const auto urdf = folder.write("r.urdf", robotOf(meshes));
    return test::inputError([&] { Robot::load(urdf, {}, warnings.options()); });
  };
  test::Warnings warnings;
  EXPECT_THAT(said({"t.stl", "flat.obj", "big.obj", "cut.obj", "u.stl"}, warnings),
              HasSubstr("r.urdf:4: error: mesh 'flat.obj' of link 'a'"));
  EXPECT_THAT(warnings.lines, ElementsAre(HasSubstr("mesh 't.stl' is an open surface")));
  warnings.lines.clear();
  EXPECT_THAT(said({"cut.obj", "t.stl", "flat.obj"}, warnings),
              HasSubstr("r.urdf:3: error: mesh 'cut.obj' of link 'a' cannot be read"));
  EXPECT_THAT(warnings.lines, IsEmpty());
}

TEST(RobotMeshes, AreCountedAsTheyGetReady) {
  const test::TemporaryFolder folder;
  folder.write("a.obj", prism(5, 1.0));
  folder.write("b.obj", prism(6, 1.0));
  folder.write("c.obj", prism(7, 1.0));
  LoadOptions options;
  std::vector<std::pair<std::size_t, std::size_t>> told;
  options.progress = [&](std::size_t done, std::size_t total) { told.emplace_back(done, total); };
  Robot::load(folder.write("r.urdf", robotOf({"a.obj", "b.obj", "a.obj", "c.obj"})), {}, options);
  EXPECT_THAT(told, ElementsAre(std::pair(1, 3), std::pair(2, 3), std::pair(3, 3)));
  told.clear();
  Robot::parse("<robot name='r'><link name='a'/></robot>", "r.urdf", {}, {}, options);
  EXPECT_THAT(told, IsEmpty());
}

}  // namespace
}  // namespace swept
