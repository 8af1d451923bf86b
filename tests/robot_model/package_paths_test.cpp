// SPDX-License-Identifier: BSD-3-Clause
#include "io/package_paths.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "input_files.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

class PackagePaths : public ::testing::Test {
 protected:
  void SetUp() override {
    unsetenv("ROS_PACKAGE_PATH");
    unsetenv("AMENT_PREFIX_PATH");
  }
  void TearDown() override { SetUp(); }

  std::vector<std::string> candidates(const std::string& reference) const {
    std::vector<std::string> texts;
    for (const fs::path& path : detail::candidatePaths(reference, "/home/arm/urdf", options)) {
      texts.push_back(path.string());
    }
    return texts;
  }
  LoadOptions options;
};

TEST_F(PackagePaths, LooksBesideTheFileAndItsParents) {
  EXPECT_THAT(candidates("package://meshes/x/y.stl"),
              ElementsAre("/home/arm/urdf/meshes/x/y.stl", "/home/arm/meshes/x/y.stl",
                          "/home/meshes/x/y.stl", "/meshes/x/y.stl"));
  EXPECT_EQ(candidates("model://meshes/x/y.stl"), candidates("package://meshes/x/y.stl"));
}

TEST_F(PackagePaths, LongestMappedNameComesFirstAndEndsAtASlash) {
  options.packages = {{"arm", "/short"}, {"arm/description", "/long"}, {"ar", "/never"}};
  const auto found = candidates("package://arm/description/link.stl");
  ASSERT_GE(found.size(), 2u);
  EXPECT_EQ(found[0], "/long/link.stl");
  EXPECT_EQ(found[1], "/short/description/link.stl");
  EXPECT_THAT(found, ::testing::Not(::testing::Contains(::testing::HasSubstr("/never"))));
}

TEST_F(PackagePaths, RosPackagePathComesLastAsPackageOrFolderOfPackages) {
  setenv("ROS_PACKAGE_PATH", "/ros/share::/ws/arm/:/other", 1);
  const auto found = candidates("package://arm/link.stl");
  const std::vector<std::string> last(found.end() - 4, found.end());
  EXPECT_THAT(last, ElementsAre("/ros/share/arm/link.stl", "/ws/arm/arm/link.stl",
                                "/ws/arm/link.stl", "/other/arm/link.stl"));
}

TEST_F(PackagePaths, AmentPrefixesHaveSharedFolders) {
  setenv("AMENT_PREFIX_PATH", "/ws/install:/opt/ros/x", 1);
  const auto found = candidates("package://arm/link.stl");
  const std::vector<std::string> last(found.end() - 2, found.end());
  EXPECT_THAT(last, ElementsAre("/ws/install/share/arm/link.stl", "/opt/ros/x/share/arm/link.stl"));
}

TEST_F(PackagePaths, SlashesInFrontAreNoAbsolutePath) {
  options.packages = {{"arm", "/mapped"}};
  setenv("ROS_PACKAGE_PATH", "/home/arm", 1);
  const auto plain = candidates("package://arm/link.stl");
  EXPECT_EQ(plain.front(), "/mapped/link.stl");
  for (const char* slashes :
       {"package:///arm/link.stl", "package:////arm/link.stl", "model:///arm/link.stl"})
    EXPECT_EQ(candidates(slashes), plain) << slashes;
  std::vector<std::string> sorted = plain;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end());
  EXPECT_EQ(detail::packageOf("package:///arm/link.stl"), "arm");
  EXPECT_EQ(detail::packageOf("arm/link.stl"), "");
}

/// A checked-out package is seldom in a folder of its name.
TEST_F(PackagePaths, AManifestAboveTheFileNamesItsFolder) {
  const test::TemporaryFolder folder;
  const std::string urdf =
      "<robot name='r'><link name='a'><collision><geometry>"
      "<mesh filename='package://arm_description/meshes/link.obj'/></geometry></collision></link>"
      "</robot>";
  const fs::path file = folder.write("checkout/robots/deep/arm.urdf", urdf);
  folder.write("checkout/meshes/link.obj", test::kCubeObj);
  EXPECT_NE(test::inputError([&] { Robot::load(file); }), "");
  for (const char* other : {"<package><name>other</name></package>", "<package>", ""}) {
    folder.write("checkout/package.xml", other);
    EXPECT_NE(test::inputError([&] { Robot::load(file); }), "") << other;
  }
  folder.write("checkout/package.xml",
               "<?xml version='1.0'?>\n<!-- c --><package format='3'>\n<name> arm_description\n"
               "</name></package>");
  EXPECT_EQ(Robot::load(file)->links()[0].collision.size(), 1U);
}

TEST_F(PackagePaths, PlainAndFileReferences) {
  EXPECT_THAT(candidates("a/../b.stl"), ElementsAre("/home/arm/urdf/b.stl"));
  EXPECT_THAT(candidates("/b.stl"), ElementsAre("/b.stl"));
  EXPECT_THAT(candidates("file:///b.stl"), ElementsAre("/b.stl"));
  EXPECT_THAT(candidates("file://b.stl"), ElementsAre("/home/arm/urdf/b.stl"));
  EXPECT_THAT(candidates("http://host/b.stl"), IsEmpty());
}

TEST_F(PackagePaths, TheFirstFileThatExistsIsLoaded) {
  const test::TemporaryFolder folder;
  folder.write("mapped/link.obj", test::kCubeObj);
  folder.write("arm/link.obj", test::kTriangleStl);
  const fs::path urdf = folder.write(
      "arm/urdf/arm.urdf",
      "<robot name='r'><link name='a'><collision><geometry>"
      "<mesh filename='package://arm/link.obj'/></geometry></collision></link></robot>");
  // Without a mapping: the parent folder is itself called `arm`, and its file is no OBJ.
  EXPECT_NE(test::inputError([&] { Robot::load(urdf); }), "");
  options.packages = {{"arm", folder.path() / "mapped"}};
  const auto robot = Robot::load(urdf, {}, options);
  EXPECT_TRUE(std::get<TriangleMesh>(robot->links()[0].collision[0].shape).isClosed());
}

}  // namespace
}  // namespace swept
