// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/sphere_model.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "sphere_refuter.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace {

using namespace swept;
using namespace swept::test;

/// Two bodies of boxes and a tetrahedron, in poses that are not axes'.
std::filesystem::path writeRobot(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "wedge.obj")
      << "v 0 0 0\nv 0.4 0 0\nv 0 0.3 0\nv 0.1 0.1 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  const std::filesystem::path urdf = folder / "robot.urdf";
  std::ofstream(urdf) << R"(<robot name="robot">
  <link name="base">
    <collision><origin xyz="0.1 0.2 0.3" rpy="0.3 0.5 0.7"/><geometry><box size="0.5 0.1 0.2"/></geometry></collision>
    <collision><origin xyz="0.2 0 0.1" rpy="1 0 0"/><geometry><box size="0.1 0.4 0.1"/></geometry></collision>
  </link>
  <link name="tip"><collision><origin xyz="0 0 1" rpy="0 2 1"/><geometry><mesh filename="wedge.obj"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/></joint>
</robot>
)";
  return urdf;
}

class SphereModels : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) / (std::string("spheres_") + info->name());
    urdf_ = writeRobot(folder_);
    robot_ = Robot::load(urdf_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  SphereModel search(int spheres) const {
    SphereModelOptions options;
    options.spheres = spheres;
    options.search = {.pieces = 500, .restarts = 2, .rounds = 5};
    return enclosingSphereModel(*robot_, options);
  }

  std::filesystem::path folder_, urdf_;
  std::shared_ptr<const Robot> robot_;
};

/// A million points of the surface, and each triangle and gap, by code that shares nothing with
/// what made the spheres.
TEST_F(SphereModels, AreNotRefuted) {
  constexpr double kError = 1e-9;  // m, of the refuter's own arithmetic
  for (const int count : {2, 9, 25}) {
    const SphereModel model = search(count);
    EXPECT_LE(model.count(), static_cast<std::size_t>(count));
    const auto file = write("spheres.urdf", spherizedUrdf(model, readTextFile(urdf_), "robot"));
    for (auto& [name, link] : readRefuterLinks(urdf_, file)) {
      EXPECT_LE(sampledOutside(link, 170000, 1), 0.0) << name;
      EXPECT_TRUE(surfaceIsContained(link, kError)) << name;
      EXPECT_TRUE(insideIsContained(link, kError)) << name;
      // The refuter can tell: a thousandth less is too little for some point.
      if (count > 2) continue;
      for (RefuterBall& ball : link.balls) ball.radius *= 0.999;
      EXPECT_GT(sampledOutside(link, 1000, 1), 0.0) << name;
      EXPECT_FALSE(surfaceIsContained(link, kError)) << name;
    }
  }
}

TEST(SphereRefuter, SeesAGapInside) {
  RefuterLink link;
  const auto folder = std::filesystem::path(testing::TempDir()) / "spheres_gap";
  std::filesystem::create_directories(folder);
  const std::string start = "<robot name=\"r\"><link name=\"cube\">";
  std::ofstream(folder / "a.urdf")
      << start
      << "<collision><geometry><box size=\"2 2 2\"/></geometry></collision></link></robot>";
  std::ofstream balls(folder / "b.urdf");
  balls << start;
  for (int i = 0; i < 8; ++i)
    balls << "<collision><origin xyz=\"" << (i & 1 ? 1 : -1) << ' ' << (i & 2 ? 1 : -1) << ' '
          << (i & 4 ? 1 : -1) << "\"/><geometry><sphere radius=\"1.5\"/></geometry></collision>";
  balls << "</link></robot>";
  balls.close();
  link = readRefuterLinks(folder / "a.urdf", folder / "b.urdf")["cube"];
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(surfaceIsContained(link, 1e-9));
  EXPECT_FALSE(insideIsContained(link, 1e-9));
  link.balls.push_back({{0, 0, 0}, 0.6});  // the gap reaches 0.5 along the axes
  EXPECT_TRUE(insideIsContained(link, 1e-9));
}

TEST_F(SphereModels, DoNotDependOnThreads) {
  SphereModelOptions options;
  options.spheres = 9;
  options.search = {.pieces = 300, .restarts = 1, .rounds = 3};
  options.threads = 1;
  const SphereModel one = enclosingSphereModel(*robot_, options);
  options.threads = 3;
  const SphereModel three = enclosingSphereModel(*robot_, options);
  EXPECT_EQ(curoboSpheres(one, "r"), curoboSpheres(three, "r"));
}

TEST_F(SphereModels, AreTheSameWhenReadAgain) {
  const SphereModel model = search(8);
  const std::string expected = curoboSpheres(model, "robot");
  const std::string urdf = readTextFile(urdf_);
  for (const auto& file :
       {write("a.urdf", spherizedUrdf(model, urdf, "robot")),
        write("a.srdf", sphereApproximationSrdf(model, "robot", "", "")), write("a.yaml", expected),
        write("a.json", sphereModelJson(model, "robot", {}))})
    EXPECT_EQ(curoboSpheres(readSphereModel(file, *robot_), "robot"), expected) << file;
}

TEST_F(SphereModels, RefuseOptionsThatMakeNoSense) {
  EXPECT_THROW(search(1), UsageError);
  EXPECT_THROW(search(0), std::invalid_argument);
  EXPECT_THROW(enclosingSphereModel(*robot_, {}), std::invalid_argument);
}

}  // namespace
