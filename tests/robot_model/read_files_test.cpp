// SPDX-License-Identifier: BSD-3-Clause
#include "io/read_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "swept/robot_model/mesh_file.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

TEST(ReadFiles, AreThoseReadMeanwhile) {
  const fs::path folder = fs::canonical(fs::temp_directory_path()) / "swept_read_files_test";
  fs::create_directories(folder / "below");
  const auto write = [&](const char* name, const char* text) {
    std::ofstream(folder / name) << text;
    return folder / name;
  };
  const fs::path text = write("a.txt", "text"), other = write("b.txt", "text");
  const fs::path mesh = write("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  static_cast<void>(readTextFile(other));
  {
    const detail::ReadFiles read;
    EXPECT_THAT(read.files(), testing::IsEmpty());
    static_cast<void>(readTextFile(folder / "below" / ".." / "a.txt"));
    static_cast<void>(loadMesh(mesh));
    EXPECT_THAT(read.files(), testing::UnorderedElementsAre(text, mesh));
  }
  static_cast<void>(readTextFile(other));
  EXPECT_THAT(detail::ReadFiles().files(), testing::IsEmpty());
  fs::remove_all(folder);
}

}  // namespace
}  // namespace swept
