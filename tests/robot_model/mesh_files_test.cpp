// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <sstream>

#include "input_files.hpp"
#include "swept/core/distance.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A robot whose one link has these <mesh> elements, read beside `folder`.
std::shared_ptr<const Robot> withMeshes(const test::TemporaryFolder& folder,
                                        const std::vector<std::string>& meshes,
                                        const LoadOptions& options = {}) {
  std::string text = "<robot name='m'><link name='a'>";
  for (const std::string& mesh : meshes) {
    text += "\n<collision><geometry><mesh " + mesh + "/></geometry></collision>";
  }
  return Robot::load(folder.write("m.urdf", text + "</link></robot>"), {}, options);
}

const TriangleMesh& mesh(const Robot& robot, int index) {
  return std::get<TriangleMesh>(robot.links()[0].collision[index].shape);
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> bounds(const TriangleMesh& mesh) {
  Eigen::Vector3d lower = mesh.vertices()[0], upper = lower;
  for (const Eigen::Vector3d& v : mesh.vertices()) {
    lower = lower.cwiseMin(v);
    upper = upper.cwiseMax(v);
  }
  return {lower, upper};
}

/// A tetrahedron with corners 0, x, 2y, 3z below a node that moves it by (10, 0, 0) in the file's
/// unit.
std::string collada(const std::string& meter, const std::string& up) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter=")" +
         meter + R"(" name="u"/><up_axis>)" + up + R"(</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array>
<technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 2 1 0 1 3 1 2 3 2 0 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><translate>10 0 0</translate>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

TEST(MeshFiles, PolygonsBecomeTrianglesOfAClosedSolid) {
  const test::TemporaryFolder folder;
  folder.write("cube.obj", test::kCubeObj);
  test::Warnings warnings;
  const auto robot = withMeshes(folder, {"filename='cube.obj'"}, warnings.options());
  EXPECT_EQ(mesh(*robot, 0).triangles().size(), 12u);
  EXPECT_EQ(mesh(*robot, 0).vertices().size(), 8u);
  EXPECT_TRUE(mesh(*robot, 0).isClosed());
  EXPECT_EQ(robot->links()[0].collision[0].source, "cube.obj");
  EXPECT_THAT(warnings.lines, IsEmpty());
}

TEST(MeshFiles, SameFileAndScaleIsOneMesh) {
  const test::TemporaryFolder folder;
  folder.write("cube.obj", test::kCubeObj);
  const auto robot =
      withMeshes(folder, {"filename='cube.obj'", "filename='./cube.obj' scale='1 1 1'",
                          "filename='cube.obj' scale='-2 1 0.5'"});
  EXPECT_EQ(&mesh(*robot, 0).vertices(), &mesh(*robot, 1).vertices());
  const auto [lower, upper] = bounds(mesh(*robot, 2));
  EXPECT_EQ(lower, Eigen::Vector3d(-2, 0, 0));
  EXPECT_EQ(upper, Eigen::Vector3d(0, 1, 0.5));
  EXPECT_TRUE(mesh(*robot, 2).isClosed());
}

TEST(MeshFiles, OpenSurfacesAreNamedOnce) {
  const test::TemporaryFolder folder;
  folder.write("t.stl", test::kTriangleStl);
  test::Warnings warnings;
  const auto robot =
      withMeshes(folder, {"filename='t.stl'", "filename='t.stl'"}, warnings.options());
  EXPECT_FALSE(mesh(*robot, 0).isClosed());
  EXPECT_THAT(
      warnings.lines,
      ElementsAre((folder.path() / "m.urdf").string() +
                  ":2: warning: mesh 't.stl' is an open surface (1 open component): its interior "
                  "is not solid"));
}

/// Each corner of each triangle written by itself, as STL has them; every third one off by `error`
/// along x.
std::string tetrahedronStl(float error) {
  const std::array<std::array<float, 3>, 4> corners = {
      {{1, 0, 0}, {2, 0, 0}, {1, 2, 0}, {1, 0, 3}}};
  std::ostringstream text;
  text.precision(9);
  text << "solid t\n";
  int written = 0;
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) {
      const auto& [x, y, z] = corners[corner];
      text << "vertex " << x + (written++ % 3 == 1 ? error : 0.0F) << ' ' << y << ' ' << z << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  return text.str() + "endsolid t\n";
}

TEST(MeshFiles, CracksOfSinglePrecisionAreNoHoles) {
  const test::TemporaryFolder folder;
  const float step = 3.0F * std::numeric_limits<float>::epsilon();
  folder.write("cracked.stl", tetrahedronStl(step));
  folder.write("wider.stl", tetrahedronStl(2e-5F));
  folder.write("open.stl", tetrahedronStl(1e-3F));
  test::Warnings warnings;
  const auto robot =
      withMeshes(folder,
                 {"filename='cracked.stl'", "filename='cracked.stl' scale='-0.001 1 7'",
                  "filename='wider.stl'", "filename='open.stl'"},
                 warnings.options());
  EXPECT_GT(mesh(*robot, 0).report().cracksFilled, 0);
  for (const int index : {0, 1, 2}) EXPECT_TRUE(mesh(*robot, index).isClosed()) << index;
  EXPECT_TRUE(mesh(*robot, 0).encloses({1.2, 0.3, 0.3}));
  EXPECT_TRUE(mesh(*robot, 2).encloses({1.2, 0.3, 0.3}));
  EXPECT_FALSE(mesh(*robot, 3).isClosed());
  EXPECT_THAT(
      warnings.lines,
      ElementsAre(testing::MatchesRegex(".*m.urdf:4: warning: mesh 'wider.stl' has cracks of up to "
                                        "[12]\\.[0-9]+e-05 m, more than rounding explains: they "
                                        "are filled"),
                  testing::MatchesRegex(".*m.urdf:5: warning: mesh 'open.stl' is an open surface "
                                        "\\([0-9]+ open components?\\): its interior is not solid, "
                                        "for openings of up to 0\\.00[0-9]+ m")));
}

/// A cube of 2 m, each side by itself as far as edges go: the top has a corner in the middle of an
/// edge.
TEST(MeshFiles, CornersOnEdgesOfOtherFacesAreNoHoles) {
  const test::TemporaryFolder folder;
  const std::string corners =
      "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
  const std::string sides = "f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  folder.write("exact.obj", corners + "v 0 -1 1\n" + sides + "f 5 9 8\nf 9 6 7\nf 9 7 8\n");
  // As six decimals write it, in metres and in millimetres.
  folder.write("off.obj",
               corners + "v 0.1 -0.999999 1.000001\n" + sides + "f 5 9 8\nf 9 6 7\nf 9 7 8\n");
  test::Warnings warnings;
  const auto robot = withMeshes(
      folder,
      {"filename='exact.obj'", "filename='off.obj'", "filename='off.obj' scale='0.001 0.001 0.001'",
       "filename='off.obj' scale='2 1 5'"},
      warnings.options());
  for (const int index : {0, 1, 2, 3}) EXPECT_TRUE(mesh(*robot, index).isClosed()) << index;
  EXPECT_TRUE(mesh(*robot, 0).encloses({0.2, 0.2, 0.3}));
  EXPECT_TRUE(mesh(*robot, 1).encloses({0.2, 0.2, 0.3}));
  EXPECT_TRUE(mesh(*robot, 2).encloses({0.0002, 0.0002, 0.0003}));
  EXPECT_THAT(warnings.lines, IsEmpty());
}

/// A face with two equal corners is a line: part of the shape where it is no edge of another.
TEST(MeshFiles, FacesThatAreLinesOfNoOtherFaceAreKept) {
  const test::TemporaryFolder folder;
  const std::string cube = test::kCubeObj;
  folder.write("edge.obj", cube + "f 1 1 2\nf 7 7 7\nf 3 4 3\n");
  folder.write("line.obj", cube + "v 0.5 0.5 3\nv 0.5 0.5 3\nf 5 9 10\n");
  test::Warnings warnings;
  const auto robot = withMeshes(
      folder, {"filename='edge.obj'", "filename='line.obj' scale='1 1 2'"}, warnings.options());
  ASSERT_EQ(warnings.lines.size(), 1U);
  EXPECT_THAT(warnings.lines.front(),
              testing::HasSubstr("mesh 'line.obj' has 1 open component without an inside"));
  EXPECT_TRUE(mesh(*robot, 0).isClosed());
  const auto gap = [&](double x, double y, double z) {
    return distance(mesh(*robot, 1), makeSphere(0.125),
                    Eigen::Isometry3d(Eigen::Translation3d(x, y, z)))
        .upper;
  };
  // From (0, 0, 2) to (0.5, 0.5, 6), above a cube that is a solid as before.
  EXPECT_EQ(mesh(*robot, 1).report().openComponents, 1);
  EXPECT_TRUE(mesh(*robot, 1).encloses({0.5, 0.5, 1.0}));
  EXPECT_EQ(gap(0.5, 0.5, 6.25), 0.125);
  EXPECT_EQ(gap(0.25, 0.25, 4.0), 0.0);
}

TEST(MeshFiles, FacesThatArePointsOfNoOtherFaceAreRefused) {
  const test::TemporaryFolder folder;
  folder.write("point.obj", std::string(test::kCubeObj) + "v 0.5 0.5 3\nf 9 9 9\n");
  EXPECT_EQ(test::inputError([&] { withMeshes(folder, {"filename='point.obj' scale='1 1 2'"}); }),
            (folder.path() / "m.urdf").string() +
                ":2: error: mesh 'point.obj' of link 'a' has a face, its triangle 12 counted from "
                "0, that is only the point (0.5, 0.5, 6), in m, and no corner of another; faces "
                "must have distinct corners");
}

TEST(MeshFiles, MirroredSolidsAreSolid) {
  const test::TemporaryFolder folder;
  folder.write("cube.obj", test::kCubeObj);
  const auto robot = withMeshes(
      folder, {"filename='cube.obj' scale='-1 1 1'", "filename='cube.obj' scale='-1 -2 -1'"});
  EXPECT_TRUE(mesh(*robot, 0).encloses({-0.5, 0.5, 0.5}));
  EXPECT_FALSE(mesh(*robot, 0).encloses({0.5, 0.5, 0.5}));
  EXPECT_TRUE(mesh(*robot, 1).encloses({-0.5, -1.5, -0.5}));
}

/// At 100 km single precision has steps of 8 mm.
TEST(MeshFiles, CoordinatesAreInDoublePrecision) {
  const test::TemporaryFolder folder;
  folder.write("far.obj",
               "v 100000.00341796875 0 0\nv 100000.00341796875 1 0\nv 100000.00341796875 0 1\n"
               "f 1 2 3\n");
  const auto robot =
      withMeshes(folder, {"filename='far.obj'", "filename='far.obj' scale='0.1 0.1 0.1'"});
  EXPECT_EQ(mesh(*robot, 0).vertices()[0].x(), 100000.00341796875);
  EXPECT_EQ(mesh(*robot, 1).vertices()[0].x(), 0.1 * 100000.00341796875);
  EXPECT_EQ(mesh(*robot, 0).sourceError(), 0.0);
}

TEST(MeshFiles, ColladaUnitCountsAndUpAxisDoesNot) {
  const test::TemporaryFolder folder;
  folder.write("z.dae", collada("0.001", "Z_UP"));
  folder.write("y.dae", collada("0.001", "Y_UP"));
  folder.write("m.dae", collada("1", "Z_UP"));
  const auto robot =
      withMeshes(folder, {"filename='z.dae'", "filename='y.dae'", "filename='m.dae'"});
  for (const int index : {0, 1}) {
    const auto [lower, upper] = bounds(mesh(*robot, index));
    EXPECT_LT((lower - Eigen::Vector3d(0.010, 0, 0)).norm(), 1e-8) << lower.transpose();
    EXPECT_LT((upper - Eigen::Vector3d(0.011, 0.002, 0.003)).norm(), 1e-8) << upper.transpose();
  }
  const auto [lower, upper] = bounds(mesh(*robot, 2));
  EXPECT_EQ(lower, Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(upper, Eigen::Vector3d(11, 2, 3));
  EXPECT_TRUE(mesh(*robot, 2).isClosed());
}

TEST(MeshFiles, ColladaThatContradictsItselfIsRefused) {
  // Assimp read beyond the arrays of such files, or appended an index until memory ran out.
  struct Break {
    std::string from, to, message;
  };
  const test::TemporaryFolder folder;
  for (const Break& it : {
           Break{"2 1 0 1 3", "x 1 0 1 3", "line 11: <p> does not hold whole numbers only"},
           Break{"2 1 0 1 3", "-1 1 0 1 3", "line 11: <p> does not hold whole numbers only"},
           Break{"2 1 0 1 3", "<b/> 0 1 3", "line 11: <p> holds more than text"},
           Break{"2 1 0 1 3", "4 1 0 1 3", "line 11: <p> has an index past its source"},
           Break{"count=\"12\"", "", "line 5: <float_array> needs a whole number as 'count'"},
           Break{"count=\"12\"", "count=\"13\"",
                 "line 5: <float_array> does not hold as many numbers as its count"},
           Break{"count=\"4\" stride", "count=\"5\" stride",
                 "line 6: <accessor> reaches beyond its array"},
           Break{"stride=\"3\"", "stride=\"2\"", "line 6: <accessor> reaches beyond its array"},
           Break{"source=\"#pa\"", "source=\"#pb\"", "line 6: <accessor> reaches beyond its array"},
           Break{"source=\"#v\"", "source=\"#w\"",
                 "line 10: <input> names a source that does not exist"},
       }) {
    std::string text = collada("1", "Z_UP");
    ASSERT_NE(text.find(it.from), std::string::npos) << it.from;
    text.replace(text.find(it.from), it.from.size(), it.to);
    folder.write("bad.dae", text);
    EXPECT_EQ(test::inputError([&] { withMeshes(folder, {"filename='bad.dae'"}); }),
              (folder.path() / "m.urdf").string() +
                  ":2: error: mesh 'bad.dae' of link 'a' cannot be read: its " + it.message);
  }
}

TEST(MeshFiles, NoOtherFileIsOpened) {
  const test::TemporaryFolder folder;
  // A pipe that nobody writes to: opening it would block for ever.
  const std::string trap = (folder.path() / "trap.mtl").string();
  ASSERT_EQ(std::system(("mkfifo '" + trap + "'").c_str()), 0);
  folder.write("cube.obj", "mtllib trap.mtl\nusemtl steel\n" + std::string(test::kCubeObj));
  EXPECT_TRUE(mesh(*withMeshes(folder, {"filename='cube.obj'"}), 0).isClosed());
  // A pipe is no mesh file either.
  EXPECT_NE(test::inputError([&] { withMeshes(folder, {"filename='trap.mtl'"}); }), "");
}

/// Assimp 5.2 takes the two corners of this strip for 2^64 triangles.
TEST(MeshFiles, WhatCrashedAssimpIsRefused) {
  const test::TemporaryFolder folder;
  std::string text = collada("1", "Z_UP");
  for (const auto& [from, to] : {std::pair{"<triangles count=\"4\"", "<tristrips count=\"1\""},
                                 {"<p>0 2 1 0 1 3 1 2 3 2 0 3", "<p>0 2"},
                                 {"</triangles", "</tristrips"}}) {
    text.replace(text.find(from), std::string(from).size(), to);
  }
  folder.write("strip.dae", text);
  EXPECT_EQ(test::inputError([&] { withMeshes(folder, {"filename='strip.dae'"}); }),
            (folder.path() / "m.urdf").string() +
                ":2: error: mesh 'strip.dae' of link 'a' cannot be read: its line 10: <tristrips> "
                "has a <p> of less than 3 corners");
}

/// Assimp 5.2 looked without end for the rest of a PLY header that is cut.
TEST(MeshFiles, APlyHeaderThatIsCutIsRefusedBeforeReading) {
  const test::TemporaryFolder folder;
  const auto expectRefused = [&](const std::string& text, const std::string& problem) {
    folder.write("cut.ply", text);
    EXPECT_EQ(test::inputError([&] { withMeshes(folder, {"filename='cut.ply'"}); }),
              (folder.path() / "m.urdf").string() +
                  ":2: error: mesh 'cut.ply' of link 'a' cannot be read: " + problem);
  };
  const std::string unknown =
      "its line 3: unknown word 'eleme' in a PLY header; allowed are format, comment, obj_info, "
      "element, "
      "property and end_header";
  expectRefused("ply\nformat ascii 1.0\neleme", unknown);
  expectRefused("ply\r\nformat ascii 1.0\r\neleme", unknown);
  expectRefused("ply\nformat ascii 1.0\ncomment end_header\nelement",
                "its line 4: 'element' must have a name and a count behind it");
  expectRefused("ply\nformat ascii 1.0\n", "the file ends where 'end_header' should follow");
}

/// Assimp 5.2 handed the null address of nothing to memcpy.
TEST(MeshFiles, EmptyIsRefusedBeforeReading) {
  const test::TemporaryFolder folder;
  for (const std::string name : {"none.stl", "none.dae", "none.obj"}) {
    folder.write(name, "");
    EXPECT_EQ(test::inputError([&] { withMeshes(folder, {"filename='" + name + "'"}); }),
              (folder.path() / "m.urdf").string() + ":2: error: mesh '" + name +
                  "' of link 'a' is empty");
  }
}

TEST(MeshFiles, TooLargeIsRefusedBeforeReading) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("huge.stl", "");
  std::filesystem::resize_file(file, (std::uintmax_t{256} << 20) + 1);  // sparse
  EXPECT_EQ(test::inputError([&] { withMeshes(folder, {"filename='huge.stl'"}); }),
            (folder.path() / "m.urdf").string() +
                ":2: error: mesh 'huge.stl' of link 'a' has 268435457 bytes; at most 268435456 are "
                "allowed");
}

}  // namespace
}  // namespace swept
