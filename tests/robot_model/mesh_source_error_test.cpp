// SPDX-License-Identifier: BSD-3-Clause
// A mesh that was read in single precision is not where its file has it. What passes nearer than
// that is not proven free, whichever way it is looked at.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>

#include "gltf_text.hpp"
#include "input_files.hpp"
#include "message_of.hpp"
#include "sliding_cube.hpp"
#include "swept/core/shapes.hpp"
#include "swept/robot_model/allowed_collision_matrix.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/mesh_file.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;

constexpr double kFar = 1000.1;  // m, no number of single precision
/// Of the bound on the error: more than what reading moves the mesh by, so that it touches nothing.
constexpr double kLeastShare = 0.15;

/// A tetrahedron with a side of 2 m at x = kFar.
std::string farTetrahedron() {
  return test::GltfTetrahedron(2.0F).glb("\"translation\":[1000.1,0,0]");
}

class MeshSourceError : public testing::Test {
 protected:
  MeshSourceError() : mesh_(loadMesh(folder_.write("far.glb", farTetrahedron()))) {}
  double error() const { return mesh_.sourceError(); }

  /// Slides from z = 0 to 0.3, the other joint at 0.
  static Verdict slide(const Checker& checker) {
    Workspace workspace(checker);
    const Eigen::Vector2d from(0.0, 0.0), to(0.0, 0.3);
    return checker.certifyMotion(from, to, workspace).verdict;
  }
  static Verdict stay(const Checker& checker) {
    Workspace workspace(checker);
    return checker.checkState(Eigen::Vector2d(0.0, 0.1), workspace);
  }
  /// The side of the mesh `gap` from the cube that slides along it.
  static Checker besideCube(const TriangleMesh& mesh, double gap) {
    return Checker(test::slidingCube(), "all", std::make_shared<const World>())
        .withBody("far", mesh, Isometry3d(Translation3d(0.1 + gap - kFar, -0.5, -0.5)));
  }
  /// A robot whose base has a box, `gap` from the side of a link's mesh that slides along it.
  std::shared_ptr<const Robot> robotWithMesh(double gap, double least, double most) const {
    const auto joint = [&](const std::string& name, const std::string& parent,
                           const std::string& child, const std::string& axis, double lower,
                           double upper) {
      return "<joint name='" + name + "' type='prismatic'><parent link='" + parent +
             "'/><child link='" + child + "'/><axis xyz='" + axis + "'/><limit lower='" +
             std::to_string(lower) + "' upper='" + std::to_string(upper) +
             "' effort='1' velocity='1'/></joint>";
    };
    std::ostringstream origin;
    origin.precision(17);
    origin << 0.1 + gap - kFar << " -0.5 -0.5";
    return Robot::parse(
        "<robot name='r'><link name='base'><collision><geometry><box size='0.2 0.2 0.2'/>"
        "</geometry></collision></link><link name='carriage'/><link name='mesh'><collision>"
        "<origin xyz='" +
            origin.str() + "'/><geometry><mesh filename='far.glb'/></geometry></collision></link>" +
            joint("x", "base", "carriage", "1 0 0", least, most) +
            joint("z", "carriage", "mesh", "0 0 1", least, most) + "</robot>",
        (folder_.path() / "r.urdf").string());
  }

  test::TemporaryFolder folder_;
  TriangleMesh mesh_;
};

TEST_F(MeshSourceError, IsWhatSinglePrecisionMovesCoordinatesBy) {
  double off = 0.0;
  for (const Eigen::Vector3d& vertex : mesh_.vertices())
    off = std::max(off, std::min(std::abs(vertex.x() - kFar), std::abs(vertex.x() - kFar - 2.0)));
  EXPECT_GT(off, 1e-6);
  EXPECT_GT(error() * kLeastShare, off);
  EXPECT_LT(error(), 5e-3);
  // What no node moves is as exact as the numbers of the file.
  const TriangleMesh plain = loadMesh(folder_.write("a.glb", test::GltfTetrahedron(2.0F).glb()));
  EXPECT_GT(plain.sourceError(), 0.0);
  EXPECT_LT(plain.sourceError(), 2e-7);
  EXPECT_EQ(loadMesh(folder_.path() / "a.glb", -3.0).sourceError(), 3.0 * plain.sourceError());
}

TEST_F(MeshSourceError, FollowsTheMesh) {
  EXPECT_EQ(std::get<TriangleMesh>(scaled(mesh_, 2.0)).sourceError(), 2.0 * error());
  const TriangleMesh plain = TriangleMesh::build(mesh_.vertices(), mesh_.triangles());
  EXPECT_EQ(plain.sourceError(), 0.0);
  const TriangleMesh given = plain.withSourceError(0.5);
  EXPECT_EQ(given.moved(plain.vertices()).sourceError(), 0.5);
  EXPECT_EQ(&given.vertices(), &plain.vertices());
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
    EXPECT_NE(test::messageOf([&] { (void)plain.withSourceError(bad); }), "");
}

TEST_F(MeshSourceError, OfTheWorldIsKeptByWhatPasses) {
  for (const double share : {kLeastShare, 0.5, 0.99}) {
    SCOPED_TRACE(share);
    const Checker near = besideCube(mesh_, share * error());
    EXPECT_EQ(slide(near), Verdict::Undecided);
    EXPECT_EQ(stay(near), Verdict::Undecided);
  }
  EXPECT_EQ(
      slide(besideCube(mesh_, 0.5 * error())
                .withReplaced("far", mesh_.withSourceError(0.0),
                              Isometry3d(Translation3d(0.1 + 0.5 * error() - kFar, -0.5, -0.5)))),
      Verdict::Free);
  EXPECT_EQ(slide(besideCube(mesh_.withSourceError(0.0), 0.5 * error())), Verdict::Free);
  EXPECT_EQ(stay(besideCube(mesh_, error() + 1e-4)), Verdict::Free);
  EXPECT_EQ(slide(besideCube(mesh_, error() + 2e-3)), Verdict::Free);
  EXPECT_EQ(slide(besideCube(mesh_, -1e-3)), Verdict::Collision);
  const Checker checker = besideCube(mesh_, 0.1);
  Workspace workspace(checker);
  const MotionClearance clearance =
      checker.motionClearance(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0.3), 1e-6, workspace);
  EXPECT_LE(clearance.lower, 0.1 - error() + 1e-9);
  EXPECT_GE(clearance.lower, 0.1 - error() - 1e-4);
}

TEST_F(MeshSourceError, OfALinkIsKeptByThePairsOfTheRobot) {
  const auto checker = [&](double gap) {
    return Checker(robotWithMesh(gap, -1.0, 1.0), "all", std::make_shared<const World>());
  };
  for (const double share : {kLeastShare, 0.99}) {
    SCOPED_TRACE(share);
    EXPECT_EQ(slide(checker(share * error())), Verdict::Undecided);
    EXPECT_EQ(stay(checker(share * error())), Verdict::Undecided);
  }
  EXPECT_EQ(slide(checker(error() + 2e-3)), Verdict::Free);
  // The same against the world.
  const auto beside = [&](double gap) {
    return Checker(robotWithMesh(9.0, -1.0, 1.0), "all", std::make_shared<const World>())
        .withBody("box", makeBox({0.2, 0.2, 0.2}), Isometry3d(Translation3d(9.0 - gap, 0.0, 0.0)));
  };
  EXPECT_EQ(slide(beside(0.9 * error())), Verdict::Undecided);
  EXPECT_EQ(slide(beside(error() + 2e-3)), Verdict::Free);
}

/// Links that may meet where their file has them are no pair that never meets.
TEST_F(MeshSourceError, OfALinkCountsWhereNothingElseCanMeet) {
  const auto status = [&](double gap) {
    const auto robot = robotWithMesh(gap, 0.0, 1e-6);
    for (const LinkPairReport& pair : computeAllowedCollisionMatrix(*robot))
      if (robot->links()[static_cast<std::size_t>(pair.linkB)].name == "mesh") return pair.status;
    return PairStatus::Adjacent;
  };
  // Neither is shown: as they were read, the two do not touch.
  EXPECT_EQ(status(0.5 * error()), PairStatus::Unknown);
  EXPECT_EQ(status(0.1), PairStatus::Never);
}

}  // namespace
}  // namespace swept
