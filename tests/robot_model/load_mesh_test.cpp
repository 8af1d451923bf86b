// SPDX-License-Identifier: BSD-3-Clause
// A mesh that a program loads is the one that a robot has of the same file, and so are errors and
// warnings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "input_files.hpp"
#include "message_of.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/mesh_file.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;

/// What a robot has of `<mesh ATTRIBUTES/>`.
TriangleMesh ofRobot(const test::TemporaryFolder& folder, const std::string& attributes,
                     const LoadOptions& options = {}) {
  const auto robot = Robot::load(
      folder.write("m.urdf", "<robot name='m'><link name='a'><collision><geometry><mesh " +
                                 attributes + "/></geometry></collision></link></robot>"),
      {}, options);
  return std::get<TriangleMesh>(robot->links()[0].collision[0].shape);
}

void expectSame(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.vertices(), b.vertices());
  EXPECT_EQ(a.triangles(), b.triangles());
  EXPECT_EQ(a.isClosed(), b.isClosed());
}

/// A box as .ply, in text.
std::string plyBox() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
      "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n";
  for (int corner = 0; corner < 8; ++corner)
    text += std::to_string(corner & 1) + " " + std::to_string(corner >> 1 & 1) + " " +
            std::to_string(corner >> 2) + "\n";
  return text + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
}

TEST(LoadMesh, IsTheRobotsMeshOfTheFile) {
  const test::TemporaryFolder folder;
  test::Warnings warnings;
  const auto cube = folder.write("cube.obj", test::kCubeObj);
  const auto box = folder.write("deeper/Box.PLY", plyBox());
  expectSame(loadMesh(cube, 1.0, warnings.options()), ofRobot(folder, "filename='cube.obj'"));
  expectSame(loadMesh(box), ofRobot(folder, "filename='deeper/Box.PLY'"));
  expectSame(loadMesh(cube, 0.001), ofRobot(folder, "filename='cube.obj' scale='.001 .001 .001'"));
  expectSame(loadMesh(cube, Vector3d(-2, 1, 0.5)),
             ofRobot(folder, "filename='cube.obj' scale='-2 1 0.5'"));
  EXPECT_TRUE(loadMesh(cube, Vector3d(-2, 1, 0.5)).isClosed());
  EXPECT_EQ(loadMesh(cube).triangles().size(), 12u);
  EXPECT_THAT(warnings.lines, IsEmpty());
}

TEST(LoadMesh, IsAShapeToPutIntoAWorld) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("cube.obj", test::kCubeObj);
  const auto robot = Robot::parse(
      "<robot name='r'><link name='a'/><link name='b'><collision><geometry><sphere radius='0.1'/>"
      "</geometry></collision></link><joint name='x' type='prismatic'><parent link='a'/>"
      "<child link='b'/><axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='1' velocity='1'/>"
      "</joint></robot>",
      "r.urdf");
  const Checker checker =
      Checker(robot, "all", std::make_shared<const World>())
          .withBody("cube", loadMesh(file, 0.5), Isometry3d(Translation3d(1, -0.25, -0.25)));
  Workspace workspace(checker);
  EXPECT_NEAR(checker.clearance({0.0}, workspace), 0.9, 1e-6);
  EXPECT_EQ(checker.checkState({1.25}, workspace), Verdict::Collision);  // inside: it is solid
  EXPECT_NEAR(checker.clearance({2.0}, workspace), 0.4, 1e-6);
}

TEST(LoadMesh, WarnsAsForARobot) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("sheet.stl", test::kTriangleStl);
  test::Warnings warnings, ofUrdf;
  EXPECT_FALSE(loadMesh(file, 1.0, warnings.options()).isClosed());
  (void)ofRobot(folder, "filename='sheet.stl'", ofUrdf.options());
  ASSERT_EQ(warnings.lines.size(), 1u);
  ASSERT_EQ(ofUrdf.lines.size(), 1u);
  const std::string said = "warning: mesh 'sheet.stl' is an open surface";
  EXPECT_EQ(warnings.lines[0].find(file.string() + ": " + said), 0u) << warnings.lines[0];
  EXPECT_NE(ofUrdf.lines[0].find(said), std::string::npos) << ofUrdf.lines[0];
  // Without anybody who takes remarks nothing is said.
  EXPECT_FALSE(loadMesh(file).isClosed());
}

TEST(LoadMesh, FilesThatCannotBeUsedAreNamed) {
  const test::TemporaryFolder folder;
  const auto message = [&](const std::string& name, const std::string& text) {
    const auto file = folder.write(name, text);
    const std::string said = test::inputError([&] { (void)loadMesh(file); });
    EXPECT_EQ(said.find(file.string() + ": error: mesh "), 0u) << said;
    return said.substr(said.find("mesh "));
  };
  EXPECT_EQ(message("mesh.step", "x"),
            "mesh has the ending '.step'; allowed are .stl, .obj, .dae, .ply, .off, .gltf "
            "and .glb");
  EXPECT_EQ(message("empty.stl", ""), "mesh is empty");
  EXPECT_EQ(message("points.obj", "v 0 0 0\n"), "mesh has no triangles");
  const std::string line = message("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  EXPECT_EQ(line.find("mesh cannot be read: its line 4: "), 0u) << line;

  const auto missing = folder.path() / "missing.stl";
  EXPECT_EQ(test::inputError([&] { (void)loadMesh(missing); }),
            missing.string() + ": error: mesh not found; looked for " + missing.string());
  EXPECT_EQ(test::inputError([&] {
              (void)loadMesh(folder.path() / ".");
            }).find(folder.path().string() + "/.: error: "),
            0u);
}

TEST(LoadMesh, FactorsAreJudged) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("cube.obj", test::kCubeObj);
  EXPECT_EQ(test::messageOf([&] { (void)loadMesh(file, 0.0); }),
            "loadMesh: scale 0, 0, 0 must be finite factors other than 0");
  EXPECT_EQ(test::messageOf([&] { (void)loadMesh(file, Vector3d(1, 0.5, NAN)); }),
            "loadMesh: scale 1, 0.5, nan must be finite factors other than 0");
  EXPECT_NE(test::messageOf([&] { (void)loadMesh(file, std::numeric_limits<double>::infinity()); }),
            "");
}

}  // namespace
}  // namespace swept
