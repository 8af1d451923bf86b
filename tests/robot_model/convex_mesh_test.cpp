// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "input_files.hpp"
#include "io/mesh_file.hpp"

namespace swept {
namespace {

/// A tetrahedron; `open` and `close` are the tags around its data.
std::string collada(const std::string& open, const std::string& close) {
  return "<COLLADA><library_geometries><geometry id=\"g\">\n " + open +
         "<source id=\"p\"><float_array id=\"pa\" count=\"12\">0 0 0 1 0 0 0 1 0 0 0 "
         "1</float_array><technique_common><accessor source=\"#pa\" count=\"4\" stride=\"3\">"
         "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
         "type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input "
         "semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"4\"><input "
         "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 2 1 0 1 3 1 2 3 2 0 3</p>"
         "</triangles>" +
         close +
         "</geometry></library_geometries><library_visual_scenes><visual_scene id=\"s\"><node "
         "id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

TEST(ConvexMesh, IsReadAsAMesh) {
  const test::TemporaryFolder folder;
  detail::MeshFileReader reader;
  const auto plain = reader.read(folder.write("a.dae", collada("<mesh>", "</mesh>")));
  ASSERT_EQ(plain.triangles.size(), 4U);
  for (const char* open : {"<convex_mesh>", "<convex_mesh >"}) {
    const auto convex = reader.read(folder.write("b.dae", collada(open, "</convex_mesh>")));
    EXPECT_EQ(convex.vertices, plain.vertices);
    EXPECT_EQ(convex.triangles, plain.triangles);
  }
}

TEST(ConvexMesh, IsRefusedWhereItHasNoFacesOrIsASecondOne) {
  const test::TemporaryFolder folder;
  detail::MeshFileReader reader;
  for (const auto& text :
       {collada("<convex_mesh convex_hull_of=\"#h\">", "</convex_mesh>"),
        collada("<mesh>", "</mesh><convex_mesh></convex_mesh>"), collada("<convex_mesh/>", "")})
    EXPECT_THROW(reader.read(folder.write("c.dae", text)), detail::MeshFileError) << text;
}

}  // namespace
}  // namespace swept
