// SPDX-License-Identifier: BSD-3-Clause
// A mesh file is read whole or not at all, each coordinate as the double nearest to it. Assimp 5.2,
// which read these formats once, left out faces whose words it did not know, made up those that a
// file was cut before, read vertices from beyond their array, and took numbers of more than 19
// digits for 0: robots were loaded without part of their geometry.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "mesh_file_changes.hpp"

namespace swept {
namespace {

using test::expectSaid;
using test::kLine;
using test::said;

TEST(WholeMeshFiles, OtherEndingsAreRefused) {
  for (const std::string ending : {".3mf", ".x3d", ".stl~", ".3ds", "."}) {
    EXPECT_EQ(said("m" + ending, test::kTriangleStl),
              "has the ending '" + ending +
                  "'; allowed are .stl, .obj, .dae, .ply, .off, .gltf and .glb");
  }
  EXPECT_EQ(said("m", test::kTriangleStl),
            "has the ending ''; allowed are .stl, .obj, .dae, .ply, .off, .gltf and .glb");
  EXPECT_EQ(said("m.STL", test::kTriangleStl), "1");
  EXPECT_EQ(said("m.Obj", test::kCubeObj), "12");
}

TEST(WholeMeshFiles, NamesOfAnyLettersAreRead) {
  for (const std::string name : {"a b.stl", "a\nb.stl", "\xc3\xa4#%.stl", ".stl.stl"})
    EXPECT_EQ(said(name, test::kTriangleStl), "1") << name;
}

const std::string kFacet =
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n"
    "      vertex 0 1 0\n    endloop\n  endfacet\n";

TEST(WholeMeshFiles, StlOfText) {
  EXPECT_EQ(
      said("m.stl", "solid a\n" + kFacet + kFacet + "endsolid a\nsolid\n" + kFacet + "endsolid\n"),
      "3");
  EXPECT_EQ(said("m.stl", "solid a\n" + kFacet),
            kLine + "8: the file ends where 'endsolid' has to follow");
  EXPECT_EQ(said("m.stl", "solid a\nendsolid a\n"), "has no triangles");
  expectSaid(
      "m.stl", "solid a\n" + kFacet + "endsolid a\n",
      {{"facet n", "FACET n",
        kLine + "2: '  FACET normal 0 0 1' where 'facet normal' has to be, and three numbers"},
       {"vertex 1 0 0", "Vertex 1 0 0",
        kLine + "5: '      Vertex 1 0 0' where 'vertex' has to be, and three numbers"},
       {"vertex 1 0 0", "vertex 1 0",
        kLine + "5: '      vertex 1 0' where 'vertex' has to be, and three numbers"},
       {"vertex 1 0 0", "vertex 1 nan 0", kLine + "5: 'nan' of a vertex must be a finite number"},
       {"vertex 1 0 0", "vertex 1 0,5 0", kLine + "5: '0,5' of a vertex must be a finite number"},
       {"vertex 1 0 0", "vertex +1.0E+00 -.5 5.", "1"},
       {"    endloop", "      vertex 1 1 0\n    endloop",
        kLine + "7: '      vertex 1 1 0' where 'endloop' has to be"},
       {"endsolid a\n", "loose\n",
        kLine + "9: 'loose' where 'facet normal' has to be, and three numbers"}});
}

/// So many triangles behind a header that says `count`.
std::string binaryStl(int triangles, std::uint32_t count, std::string header, float last = 0.0F) {
  header.resize(80, ' ');
  header.resize(84);
  std::memcpy(header.data() + 80, &count, sizeof count);
  for (int i = 0; i < triangles; ++i) {
    const float x = static_cast<float>(i);
    const float numbers[12] = {0, 0, 1, x, 0, 0, x + 1, 0, 0, 0, 1, last};
    header.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, '\0');
  }
  return header;
}

TEST(WholeMeshFiles, StlOfBytes) {
  EXPECT_EQ(said("m.stl", binaryStl(3, 3, "")), "3");
  EXPECT_EQ(said("m.stl", binaryStl(3, 3, "solid s")), "3");
  for (const std::string header : {"", "solid s"}) {
    for (const std::uint32_t count : {2U, 4U, 4294967295U}) {
      EXPECT_EQ(
          said("m.stl", binaryStl(3, count, header)),
          "cannot be read: neither STL as text, which starts with 'solid', nor a binary one: it "
          "has 234 bytes, and a binary STL of " +
              std::to_string(count) + " triangles, as its header says, has " +
              std::to_string(84 + 50 * std::uint64_t{count}));
    }
  }
  EXPECT_EQ(
      said("m.stl", "STL"),
      "cannot be read: neither STL as text, which starts with 'solid', nor a binary one: it has "
      "3 bytes, less than the 84 of a header");
  EXPECT_EQ(said("m.stl", binaryStl(3, 3, "", NAN)),
            "cannot be read: triangle 0 has a corner that is not finite");
}

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST(WholeMeshFiles, Obj) {
  const std::string word =
      " in an OBJ file; allowed are v, f, vt, vn, vp, p, l, g, o, s, mg, usemtl, mtllib, usemap, "
      "maplib";
  const auto corner = [](const std::string& text) {
    return kLine + "6: corner '" + text +
           "' of a face must be V, V/T, V//N or V/T/N, of whole numbers other than 0";
  };
  const std::string backslash =
      ": a backslash ends the line; lines that the next one continues are not allowed";
  const std::string numbers =
      kLine + "2: a vertex must have 3 numbers, a fourth that is 1, or 6 with its colour";
  expectSaid(
      "m.obj", kObj,
      {{"f 1 2 4", "f -4 -3 -1", "4"},
       {"f 1 2 4", "f 1/1 2/1/1 4//1", "4"},
       {"f 1 2 4", "g x\nf 1 2 4\np 1\nl 1 2", "4"},
       {"f 1 2 4", "f 1 2 3 4", "5"},
       {"v 0 0 0\n", "f 1 2 3\nv 0 0 0\n", "5"},
       {"v 1 0 0", "v 1 0 0 1.0", "4"},
       {"v 1 0 0", "v 1 0 0 .5 .5 .5", "4"},
       {"f 1 2 4", " f 1 2 4", kLine + "6: blanks before 'f'; lines have to start with a word"},
       {"v 1 0 0", "\tv 1 0 0", kLine + "2: blanks before 'v'; lines have to start with a word"},
       {"f 1 2 4", "F 1 2 4", kLine + "6: unknown word 'F'" + word},
       {"f 1 2 4", "fo 1 2 4", kLine + "6: unknown word 'fo'" + word},
       {"f 1 2 4", "surf 0 1 0 1 1 2 4", kLine + "6: unknown word 'surf'" + word},
       {"f 1 2 4", "f 1 2", kLine + "6: a face must have at least 3 corners"},
       {"f 1 2 4", "f 1 2 0", corner("0")},
       {"f 1 2 4", "f 1 2 4/x", corner("4/x")},
       {"f 1 2 4", "f 1 2 4 # c", corner("#")},
       {"f 1 2 4", "f 1 2 9", kLine + "6: a corner is vertex 9; there are 4"},
       {"f 1 2 4", "f 1 2 -5",
        kLine + "6: corner '-5' of a face is before the first of the 4 vertices so far"},
       {"f 1 2 4", "f 1 2 \\\n4", kLine + "6" + backslash},
       {"v 0 0 0", "# C:\\\nv 0 0 0", kLine + "1" + backslash},
       {"v 1 0 0", "v 1 0", numbers},
       {"v 1 0 0", "v 1 0 0 2", numbers},
       {"v 1 0 0", "v 1 0 0 0 0", numbers},
       {"v 1 0 0", "v 1 0 inf", kLine + "2: 'inf' of a vertex must be a finite number"}});
}

/// The corners of lines `v ...`, as PLY has them.
std::string replacedV(std::string text) {
  std::erase(text, 'v');
  return text;
}

/// These corners, and two faces of theirs, as bytes.
std::string binaryPolygons() {
  std::string bytes;
  const auto put = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const int value : {2, 0, 0, 2, 3, 0, 3, 1, 0, 2, 1, 0, 1, 0, 0})
    put(static_cast<float>(value));
  for (const std::int32_t first : {2, 1}) {
    put(std::uint8_t{5});
    for (const std::int32_t corner : {0, first, 3 - first, 3, 4}) put(corner);
  }
  return bytes;
}

TEST(WholeMeshFiles, FacesThatCrossThemselvesAreRefused) {
  const std::string corners = "v 2 0 0\nv 2 3 0\nv 3 1 0\nv 2 1 0\nv 1 0 0\n";
  EXPECT_EQ(said("m.obj", corners + "f 1 3 2 4 5\n"), "3");
  const std::string must =
      " of 5 corners crosses or touches itself; a face of more than 4 corners must not, or has to "
      "be given as "
      "triangles";
  EXPECT_EQ(said("m.obj", corners + "f 1 3 2 4 5\nf 1 2 3 4 5\n"), kLine + "7: a face" + must);
  EXPECT_EQ(said("m.obj", "f 1 2 3 4 5\n" + corners), kLine + "1: a face" + must);
  const std::string ply =
      " 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_EQ(
      said("m.ply", "ply\nformat ascii" + ply + replacedV(corners) + "5 0 2 1 3 4\n5 0 1 2 3 4\n"),
      kLine + "16: a face" + must);
  EXPECT_EQ(said("m.ply", "ply\nformat binary_little_endian" + ply + binaryPolygons()),
            "cannot be read: face 1, counted from 0," + must);
}

/// Words that other readers take for other numbers.
TEST(WholeMeshFiles, NumbersAreWhatTheySay) {
  const test::TemporaryFolder folder;
  detail::MeshFileReader reader;
  for (const auto& [word, value] : std::vector<std::pair<std::string, double>>{
           {"1000000000000000000000e-21", 1.0},
           {"0.0000000000000000000001e22", 1.0},
           {"0.1", 0.1},
           {"+123456.789012345678901", 123456.789012345678901},
           {"100000.00341796875", 100000.00341796875},
           {"1e200", 1e200}}) {
    SCOPED_TRACE(word);
    const std::string corners[] = {word + " 0 0", "0 1 0", "0 0 1"};
    const auto of = [&](const std::string& name, const std::string& text) {
      return reader.read(folder.write(name, text)).vertices.at(0).x();
    };
    EXPECT_EQ(of("m.obj", "v " + corners[0] + "\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"), value);
    EXPECT_EQ(of("m.off", "OFF\n3 1 0\n" + corners[0] + "\n0 1 0\n0 0 1\n3 0 1 2\n"), value);
    EXPECT_EQ(of("m.stl", "solid\nfacet normal 0 0 0\nouter loop\nvertex " + corners[0] +
                              "\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\nendsolid\n"),
              value);
    EXPECT_EQ(of("m.ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                 "property double z\nelement face 1\nproperty list uchar int vertex_index\n"
                 "end_header\n" +
                     corners[0] + "\n0 1 0\n0 0 1\n3 0 1 2\n"),
              value);
  }
}

/// What no face has does not count for the size of a mesh.
TEST(WholeMeshFiles, VerticesOfNoFaceAreDropped) {
  const test::TemporaryFolder folder;
  detail::MeshFileReader reader;
  const detail::MeshFileContent content =
      reader.read(folder.write("m.obj", "v 9e9 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 3 2 4\n"));
  EXPECT_EQ(content.vertices, (std::vector<Eigen::Vector3d>{{0, 2, 0}, {1, 0, 0}, {0, 0, 3}}));
  EXPECT_EQ(content.triangles, (std::vector<Eigen::Vector3i>{{0, 1, 2}}));
}

TEST(WholeMeshFiles, Off) {
  const std::string text =
      "OFF # made by hand\n4 4 6\n0 0 0\n1 0 0 # a remark\n\n0 2 0 255 0 0\n0 0 3\n"
      "3 0 2 1\n3 0 1 3 255 0 0\n3 1 2 3\n3 2 0 3\n";
  const std::string number = " must be a whole number from 0 to 50000000";
  expectSaid(
      "m.off", text,
      {{"OFF #", "COFF #", "4"},
       {"OFF # made by hand\n", "OFF ", "4"},
       {"3 1 2 3", "4 1 2 3 0", "5"},
       {"OFF #", "off #",
        kLine + "1: 'off # made by hand' where 'OFF' has to be, or that with C, N or ST ahead of "
                "it, as text"},
       {"OFF #", "OFF BINARY #",
        kLine + "1: 'OFF BINARY # made by hand' where 'OFF' has to be, or that with C, N or ST "
                "ahead of it, as text"},
       {"4 4 6", "4 -4 6", kLine + "2: the count of faces" + number},
       {"4 4 6", "4", kLine + "2: the count of faces" + number},
       {"4 4 6", "4 5 6", kLine + "11: the file ends where a face has to follow"},
       {"4 4 6", "4 3 6", kLine + "11: more follows after the last face"},
       {"4 4 6", "5 4 6", kLine + "11: the file ends where a face has to follow"},
       {"1 0 0 #", "1 nan 0 #", kLine + "4: a vertex must start with three finite numbers"},
       {"1 0 0 #", "1 0 #", kLine + "4: a vertex must start with three finite numbers"},
       {"3 1 2 3", "3 1 2 4", kLine + "10: a corner is vertex 4; there are 4, counted from 0"},
       {"3 1 2 3", "3 1 2 -1", kLine + "10: a corner" + number},
       {"3 1 2 3", "3 1 2", kLine + "10: the line ends where a corner has to follow"},
       {"3 1 2 3", "2 1 2", kLine + "10: a face has 2 corners; it must have at least 3"}});
}

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty float "
    "z\n"
    "property uchar red\nelement face 4\nproperty uchar flag\nproperty list uchar int "
    "vertex_indices\n"
    "element edge 1\nproperty int vertex1\nend_header\n"
    "0 0 0 9\n1 0 0 9\n0 2 0 9\n0 0 3 9\n7 3 0 2 1\n7 3 0 1 3\n7 3 1 2 3\n7 3 2 0 3\n5\n";

TEST(WholeMeshFiles, PlyOfText) {
  const std::string list =
      kLine + "8: the face must have one list of whole numbers 'vertex_indices' or 'vertex_index'";
  expectSaid(
      "m.ply", kPly,
      {{"7 3 2", "7 3 2", "4"},
       {"vertex_indices", "vertex_index", "4"},
       {"3 1 2 3", "4 1 2 3 0", "5"},
       {"vertex_indices", "indices", list},
       {"list uchar int", "list uchar float", list},
       {"list uchar int vertex_indices", "int vertex_indices", list},
       {"element face", "element polygon", "cannot be read: the header has no element 'face'"},
       {"element edge 1\nproperty int vertex1",
        "element tristrips 1\nproperty list int int vertex_indices",
        kLine + "11: the element 'tristrips' has corners; allowed are those of the element 'face'"},
       {"float x", "int x", kLine + "3: 'x' of the vertex must be float or double"},
       {"float x", "half x",
        kLine + "4: the type 'half' is not known; allowed are char, uchar, short, "
                "ushort, int, uint, float, double, int8, uint8, int16, uint16, int32, "
                "uint32, float32 and float64"},
       {"face 4", "face 3", kLine + "21: '3' follows the last value of the line"}});
}

TEST(WholeMeshFiles, PlyOfTextThatContradictsItsHeader) {
  expectSaid(
      "m.ply", kPly,
      {{"7 3 2 0 3\n5\n", "", kLine + "20: the file ends after 3 of 4 elements 'face'"},
       {"\n5\n", "\n5\n6\n", kLine + "23: more follows after the last element of the header"},
       {"7 3 0 1 3", "7 3 0 1 4", kLine + "19: a corner is vertex 4; there are 4, counted from 0"},
       {"7 3 0 1 3", "7 3 0 1 -1",
        kLine + "19: 'vertex_indices' has -1 where a whole number from 0 to 2^32 - 1 has to be"},
       {"7 3 0 1 3", "7 2 0 1", kLine + "19: a face has 2 corners; it must have at least 3"},
       {"7 3 0 1 3", "7 3 0 1", kLine + "19: the line ends where 'vertex_indices' should follow"},
       {"1 0 0 9", "1 0 nan 9", kLine + "15: 'z' must be a finite number"}});
}

template <typename Number>
void put(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string binaryPly(int faces, std::uint16_t last) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty float "
      "y\n"
      "property float z\nelement face " +
      std::to_string(faces) + "\nproperty list uchar ushort vertex_index\nend_header\n";
  for (int i = 0; i < 4; ++i) {
    put(text, i == 1 ? 1.0 : 0.0);
    put(text, i == 2 ? 2.0F : 0.0F);
    put(text, i == 3 ? 3.0F : 0.0F);
  }
  for (const auto& face :
       {std::array<std::uint16_t, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, last}}) {
    put(text, std::uint8_t{3});
    for (const std::uint16_t corner : face) put(text, corner);
  }
  return text;
}

TEST(WholeMeshFiles, PlyOfBytes) {
  EXPECT_EQ(said("m.ply", binaryPly(4, 3)), "4");
  EXPECT_EQ(said("m.ply", binaryPly(4, 4)),
            "cannot be read: at byte 263: a corner is vertex 4; there are 4, counted from 0");
  EXPECT_EQ(said("m.ply", binaryPly(3, 3)),
            "cannot be read: at byte 256: more follows after the last element of the header");
  EXPECT_EQ(said("m.ply", binaryPly(5, 3)),
            "cannot be read: at byte 263: the file ends within 5 elements 'face'");
}

}  // namespace
}  // namespace swept
