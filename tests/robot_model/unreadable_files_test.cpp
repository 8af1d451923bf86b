// SPDX-License-Identifier: BSD-3-Clause
// What the file system, or the system, says of a file is an InputError that names it. Of meshes
// std::filesystem::filesystem_error and std::system_error came out.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cerrno>
#include <system_error>

#include "gltf_text.hpp"
#include "input_files.hpp"
#include "nobody.hpp"
#include "swept/robot_model/cloud_file.hpp"
#include "swept/robot_model/planning_request.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

std::string robotWith(const std::string& mesh) {
  return "<robot name='m'><link name='a'><collision><geometry><mesh filename='" + mesh +
         "'/></geometry></collision></link></robot>";
}

/// A kind of file, and how it is read.
struct Reader {
  const char* ending;
  void (*read)(const fs::path& file);
};

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all{
      {".urdf", [](const fs::path& file) { (void)Robot::load(file); }},
      {".srdf",
       [](const fs::path& file) {
         const test::TemporaryFolder folder;
         const fs::path urdf = folder.write("r.urdf", "<robot name='r'><link name='a'/></robot>");
         (void)Robot::load(urdf, file);
       }},
      {".yaml", [](const fs::path& file) { (void)World::load(file); }},
      {".scene", [](const fs::path& file) { (void)World::load(file); }},
      {".json", [](const fs::path& file) { (void)ProblemFile::load(file); }},
      {".yml", [](const fs::path& file) { (void)PlanningRequest::load(file); }},
      {".pcd", [](const fs::path& file) { (void)loadPoints(file); }},
      {".bt", [](const fs::path& file) { (void)loadOctomap(file); }}};
  return all;
}

/// `message` for all kinds of files that are `folder / stem` and an ending. A mesh's is about the
/// robot that names it, and says where it was looked for, and why in vain.
void expectRefused(const fs::path& folder, const std::string& stem, const std::string& message) {
  for (const Reader& reader : readers()) {
    const fs::path file = folder / (stem + reader.ending);
    EXPECT_EQ(test::inputError([&] { reader.read(file); }), file.string() + ": error: " + message);
  }
  const std::string mesh = (folder / (stem + ".stl")).string();
  const std::string found =
      test::inputError([&] { (void)Robot::parse(robotWith(mesh), "m.urdf"); });
  EXPECT_EQ(found, "m.urdf:1: error: mesh '" + mesh + "' of link 'a' not found; looked for " +
                       mesh + (message == "file not found" ? "" : " (" + message + ")"));
}

/// Calls `make(file)` for a file of each kind.
template <typename Make>
void forAllEndings(const fs::path& folder, const std::string& stem, const Make& make) {
  for (const Reader& reader : readers()) make(folder / (stem + reader.ending));
  make(folder / (stem + ".stl"));
}

TEST(UnreadableFiles, AreMissing) {
  const test::TemporaryFolder folder;
  expectRefused(folder.path(), "none", "file not found");
}

TEST(UnreadableFiles, AreFolders) {
  const test::TemporaryFolder folder;
  forAllEndings(folder.path(), "is_folder",
                [](const fs::path& file) { fs::create_directory(file); });
  expectRefused(folder.path(), "is_folder", "not a regular file");
}

TEST(UnreadableFiles, AreLinksInACircle) {
  const test::TemporaryFolder folder;
  forAllEndings(folder.path(), "loop",
                [](const fs::path& file) { fs::create_symlink(file, file); });
  expectRefused(folder.path(), "loop", "file cannot be read: Too many levels of symbolic links");
}

TEST(UnreadableFiles, HaveNamesThatAreTooLong) {
  const test::TemporaryFolder folder;
  expectRefused(folder.path(), std::string(300, 'x'), "file cannot be read: File name too long");
}

TEST(UnreadableFiles, AreInAFolderThatMayNotBeLookedInto) {
  const test::TemporaryFolder folder;
  const fs::path closed = folder.path() / "closed";
  fs::create_directory(closed);
  fs::permissions(folder.path(), fs::perms::all);
  fs::permissions(closed, fs::perms::none);
  {
    const test::Nobody nobody;
    expectRefused(closed, "any", "file cannot be read: Permission denied");
  }
  fs::permissions(closed, fs::perms::all);
}

TEST(UnreadableFiles, MayNotBeRead) {
  const test::TemporaryFolder folder;
  fs::permissions(folder.path(), fs::perms::all);
  forAllEndings(folder.path(), "secret", [&](const fs::path& file) {
    folder.write(file.filename().string(), "secret");
    fs::permissions(file, fs::perms::none);
  });
  const test::Nobody nobody;
  for (const Reader& reader : readers()) {
    const fs::path file = folder.path() / (std::string("secret") + reader.ending);
    EXPECT_EQ(test::inputError([&] { reader.read(file); }),
              file.string() + ": error: file cannot be read");
  }
  const std::string mesh = (folder.path() / "secret.stl").string();
  EXPECT_EQ(test::inputError([&] { (void)Robot::parse(robotWith(mesh), "m.urdf"); }),
            "m.urdf:1: error: mesh '" + mesh + "' of link 'a' cannot be read");
}

/// Where no pipe can be opened, no process can be made that reads a mesh in glTF.
TEST(UnreadableFiles, AreMeshesWhereNoProcessCanBeMade) {
  const test::TemporaryFolder folder;
  const std::string mesh = folder.write("a.glb", test::GltfTetrahedron().glb()).string();
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = open("/dev/null", O_RDONLY | O_CLOEXEC);
  ASSERT_GE(next, 0);
  close(next);
  // UndefinedBehaviorSanitizer looks at the first object of each type through a pipe.
  const std::system_error first(EMFILE, std::generic_category(), "first");
  ASSERT_STREQ(static_cast<const std::runtime_error&>(first).what(), "first: Too many open files");
  // One file at a time, and a pipe has two ends.
  const rlimit one{.rlim_cur = static_cast<rlim_t>(next) + 1, .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &one), 0);
  const std::string message =
      test::inputError([&] { (void)Robot::parse(robotWith(mesh), "m.urdf"); });
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_EQ(message,
            "m.urdf:1: error: mesh '" + mesh +
                "' of link 'a' cannot be read: no process can be made: Too many open files");
  EXPECT_EQ(test::inputError([&] { (void)Robot::parse(robotWith(mesh), "m.urdf"); }), "");
}

#if defined(__linux__)
/// A file without a name that can be told is read nonetheless.
TEST(UnreadableFiles, AreNotThoseThatHaveLostTheirName) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.write("lost.obj", test::kCubeObj);
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  ASSERT_GE(descriptor, 0);
  fs::remove(file);
  const fs::path mesh = folder.path() / "cube.obj";
  fs::create_symlink("/proc/self/fd/" + std::to_string(descriptor), mesh);
  const auto robot = Robot::parse(robotWith(mesh.string()), "m.urdf");
  close(descriptor);
  const auto& shape = robot->links().front().collision.front().shape;
  EXPECT_EQ(std::get<TriangleMesh>(shape).triangles().size(), 12U);
}

/// The folder of a text that is read in a working folder that is gone.
TEST(UnreadableFiles, AreMeshesBesideATextThatIsNowhere) {
  const test::TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::create_directory(folder.path() / "gone");
  fs::current_path(folder.path() / "gone");
  fs::remove(folder.path() / "gone");
  const std::string message =
      test::inputError([&] { (void)Robot::parse(robotWith("x.stl"), "m.urdf"); });
  fs::current_path(before);
  EXPECT_EQ(message, "m.urdf:1: error: mesh 'x.stl' of link 'a' not found; looked for x.stl");
}
#endif

}  // namespace
}  // namespace swept
