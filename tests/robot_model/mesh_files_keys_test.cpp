// SPDX-License-Identifier: BSD-3-Clause
// What becomes of each part of a mesh file, as robot_model/FORMATS.md says.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "format_table.hpp"
#include "gltf_text.hpp"
#include "input_files.hpp"
#include "io/mesh_file.hpp"

namespace swept {
namespace {

using test::KeyCase;
using test::walkFormat;
using Answer = std::function<std::string(const std::string&)>;

/// The triangles of a file with that ending.
Answer trianglesOf(const std::string& ending) {
  return [ending](const std::string& text) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("a" + ending, text);
    std::ostringstream answer;
    try {
      detail::MeshFileReader reader;
      const detail::MeshFileContent content = reader.read(file);
      for (const Eigen::Vector3i& triangle : content.triangles) {
        for (const int corner : triangle)
          answer << content.vertices.at(static_cast<std::size_t>(corner)).transpose() << "; ";
        answer << '\n';
      }
    } catch (const detail::MeshFileError& error) {
      throw InputError(file.string(), 0, error.what());
    }
    return answer.str();
  };
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// Cases that replace a part of one text.
struct Changes {
  std::string text;
  KeyCase operator()(const std::string& key, const std::string& from, const std::string& to) const {
    return {key, text, replaced(text, from, to)};
  }
};

/// One triangle; bytes of the header, its normal, x of its first corner, and the attribute.
std::string binaryStl(char header, float normal, float x, char attribute, std::uint32_t count = 1) {
  std::string bytes(80, header);
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float numbers[12] = {normal, normal, normal, x, 0, 0, 1, 0, 0, 0, 1, 0};
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers).append(2, attribute);
  }
  return bytes;
}

TEST(MeshFilesKeys, Stl) {
  const Changes change{test::kTriangleStl};
  const std::string bytes = binaryStl('a', 0, 2, 'a');
  walkFormat("Meshes: STL",
             {change("solid", "solid t", "solid facet normal"),
              change("facet normal", "normal 0 0 1", "normal -nan(ind) 1.#QNAN x"),
              change("vertex", "vertex 1 0 0", "vertex 2 0 0"),
              change("Vertex", "vertex 1", "Vertex 1"),
              {"header", bytes, binaryStl('s', 0, 2, 'a')},
              {"count", bytes, binaryStl('a', 0, 2, 'a', 2)},
              {"normal", bytes, binaryStl('a', std::nanf(""), 2, 'a')},
              {"attribute", bytes, binaryStl('a', 0, 2, 'b')},
              {"vertex", bytes, binaryStl('a', 0, 3, 'a')}},
             trianglesOf(".stl"));
}

TEST(MeshFilesKeys, Obj) {
  const Changes change{test::kCubeObj};
  std::vector<KeyCase> cases{change("#", "v 1 0 0", "# v 7 7 7\nv 1 0 0"),
                             change("v", "v 0 0 0", "v 0 0 -1"),
                             change("v/colour", "v 1 0 0", "v 1 0 0 -1.#IND 0 x"),
                             change("v/fourth", "v 1 0 0", "v 1 0 0 2"),
                             change("f", "f 5 6 7 8\n", ""),
                             change("f/texture", "f 5 6 7 8", "f 5/1/1 6//9 7/ 8//"),
                             change("l", "f 5", "l 1 2 3\nf 5"),
                             change("p", "f 5", "p 1\nf 5")};
  for (const std::string word :
       {"vt", "vn", "vp", "g", "o", "s", "mg", "usemtl", "mtllib", "usemap", "maplib"})
    cases.push_back(change(word, "f 5", word + " nan # 1.#QNAN\nf 5"));
  for (const std::string word : {"fo", "curv", "surf", "call"})
    cases.push_back(change(word, "f 5", word + " 1 2 3\nf 5"));
  walkFormat("Meshes: OBJ", cases, trianglesOf(".obj"));
}

TEST(MeshFilesKeys, Ply) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty float nx\nelement face 1\nproperty uchar flag\n"
      "property list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\nend_header\n"
      "0 0 0 1\n1 0 0 1\n0 2 0 1\n0 0 3 1\n7 3 0 1 2\n5\n";
  std::string bytes =
      " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar uchar vertex_index\nend_header\n";
  // Of either order of bytes.
  for (const char last : {'@', 'A', 'A', 'B', '@', 'A', 'A', 'B', 'B'})
    bytes += std::string("@") + "aa" + last;
  bytes += std::string("\x03\0\x01\x02", 4);
  const Changes change{ply};
  walkFormat("Meshes: PLY",
             {{"format", "ply\nformat binary_little_endian" + bytes,
               "ply\nformat binary_big_endian" + bytes},
              change("comment", "element vertex", "comment scale 1000\nelement vertex"),
              change("obj_info", "element vertex", "obj_info scale 1000\nelement vertex"),
              change("element vertex/x", "1 0 0 1", "2 0 0 1"),
              change("element vertex/other", "1 0 0 1", "1 0 0 1.#QNAN"),
              change("element face/vertex_indices", "3 0 1 2", "3 0 1 3"),
              {"element face/vertex_index", replaced(ply, "vertex_indices", "vertex_index"),
               replaced(replaced(ply, "vertex_indices", "vertex_index"), "3 0 1 2", "3 0 1 3")},
              change("element face/other", "7 3 0", "nan 3 0"),
              change("element other", "\n5\n", "\nx\n"),
              change("element tristrips", "element edge 1\nproperty int vertex1",
                     "element tristrips 1\nproperty list int int vertex_indices")},
             trianglesOf(".ply"));
}

TEST(MeshFilesKeys, Off) {
  const Changes change{"OFF\n4 1 3\n0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 1 2\n"};
  walkFormat("Meshes: OFF",
             {change("COFF", "OFF", "STCNOFF"),
              change("#", "4 1 3", "4 1 3 # 7"),
              change("vertices", "4 1 3\n0 0 0\n", "3 1 3\n"),
              {"faces", change.text, replaced(change.text, "4 1 3", "4 2 3") + "3 1 2 3\n"},
              change("edges", "4 1 3", "4 1 99"),
              change("vertex", "1 0 0", "2 0 0"),
              change("vertex/other", "1 0 0", "1 0 0 nan x"),
              change("face", "3 0 1 2", "3 0 1 3"),
              change("face/colour", "3 0 1 2", "3 0 1 2 x"),
              change("BINARY", "OFF", "OFF BINARY"),
              change("4OFF", "OFF", "4OFF")},
             trianglesOf(".off"));
}

/// Cases that replace a part of the JSON of a file.
struct GltfChanges {
  std::string json = test::GltfTetrahedron().json();
  static std::string file(const std::string& text) {
    return test::glbOf(text, test::GltfTetrahedron().bytes);
  }
  KeyCase operator()(const std::string& key, const std::string& from, const std::string& to) const {
    return {key, file(json), file(replaced(json, from, to))};
  }
  GltfChanges with(const std::string& from, const std::string& to) const {
    return {replaced(json, from, to)};
  }
};

std::vector<KeyCase> gltfNodes() {
  const GltfChanges change;
  const std::string node = R"([{"mesh":0}])";
  const GltfChanges twoScenes =
      change.with(R"([{"nodes":[0]}])", R"([{"nodes":[0]},{"nodes":[1]}])")
          .with(node, R"([{"mesh":0},{"mesh":0,"scale":[1,2,3]}])");
  const auto placed = [&](const std::string& key, const std::string& more) {
    return change(key, node, R"([{"mesh":0,)" + more + "}]");
  };
  return {
      change("asset/version", "2.0", "1.0"),
      change("extensionsRequired", R"("scene":0)",
             R"("scene":0,"extensionsRequired":["KHR_mesh_quantization"])"),
      twoScenes("scene", R"("scene":0)", R"("scene":1)"),
      twoScenes("scenes/nodes", R"([{"nodes":[0]})", R"([{"nodes":[0,1]})"),
      change.with(R"({"nodes":[0]})", R"({"nodes":[0,1]})")
          .with(node, R"([{"mesh":0},{"name":"b","scale":[2,2,2]}])")("nodes/mesh", R"("name":"b")",
                                                                      R"("mesh":0)"),
      change.with(node, R"([{"mesh":0},{"mesh":0}])")("nodes/children", R"([{"mesh":0})",
                                                      R"([{"children":[1],"mesh":0})"),
      placed("nodes/matrix", R"("matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1])"),
      placed("nodes/translation", R"("translation":[1,2,3])"),
      placed("nodes/rotation", R"("rotation":[0,0,1,0])"),
      placed("nodes/scale", R"("scale":[1,2,3])"),
      placed("nodes/skin", R"("skin":0)"),
      change.with(R"("scene":0)",
                  R"("scene":0,"cameras":[{"type":"perspective","perspective":{"yfov":1,)"
                  R"("znear":1}}])")("nodes/camera", node, R"([{"mesh":0,"camera":0}])"),
      placed("nodes/extensions/EXT_mesh_gpu_instancing",
             R"("extensions":{"EXT_mesh_gpu_instancing":{}})"),
      change("animations", R"("scene":0)", R"("scene":0,"animations":[])"),
  };
}

std::vector<KeyCase> gltfMeshes() {
  const GltfChanges change;
  const std::string indices = R"("indices":1)", mesh = "meshes/primitives/";
  const GltfChanges fewer = change.with(R"("count":12)", R"("count":9)");
  return {
      {mesh + "attributes/POSITION", test::GltfTetrahedron().glb(),
       test::GltfTetrahedron(2.0F).glb()},
      change(mesh + "attributes/NORMAL", R"("POSITION":0)", R"("POSITION":0,"NORMAL":0)"),
      change.with(indices, indices + R"(,"mode":5)")(mesh + "indices", indices + ",", ""),
      change(mesh + "mode", indices, indices + R"(,"mode":6)"),
      change.with(R"("scene":0)", R"("scene":0,"materials":[{}])")(mesh + "material", indices,
                                                                   indices + R"(,"material":0)"),
      change(mesh + "targets", indices, indices + R"(,"targets":[])"),
      change("accessors/count", R"("count":12)", R"("count":9)"),
      change("accessors/componentType", "5123", "5121"),
      fewer("accessors/byteOffset", "5123", R"(5123,"byteOffset":6)"),
      change("accessors/sparse", "5123", R"(5123,"sparse":{})"),
      fewer("bufferViews/byteOffset", R"("byteOffset":48,"byteLength":24)",
            R"("byteOffset":54,"byteLength":18)"),
      change("bufferViews/byteStride", R"("byteLength":48)", R"("byteLength":72,"byteStride":16)"),
      change("buffers/uri", R"("byteLength":72)", R"("byteLength":72,"uri":"a.bin")"),
  };
}

TEST(MeshFilesKeys, Gltf) {
  std::vector<KeyCase> cases = gltfNodes();
  for (KeyCase& key : gltfMeshes()) cases.push_back(std::move(key));
  walkFormat("Meshes: glTF (.gltf, .glb)", cases, trianglesOf(".glb"));
}

/// Four corners of a geometry whose faces are `faces`, below a node with `placed`.
std::string collada(const std::string& faces, const std::string& placed = "") {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="15">0 0 0 1 0 0 1 2 0 0 2 0 7 8 9</float_array>
<technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<source id="n"><float_array id="na" count="3">0 0 1</float_array>
<technique_common><accessor source="#na" count="1" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
)" + faces +
         R"(
</mesh></geometry></library_geometries>
<library_nodes><node id="other"><translate>0 0 5</translate><instance_geometry url="#g"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s">
<node id="a">)" +
         placed + R"(<instance_geometry url="#g"></instance_geometry></node>
</visual_scene><visual_scene id="t">
<node><instance_geometry url="#g"/><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";
}

const std::string kInput = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";

/// A group of faces, as it is and with another corner.
KeyCase group(const std::string& name, const std::string& faces) {
  return {"mesh/" + name, collada(faces), collada(replaced(faces, "0 1", "0 3"))};
}

std::vector<KeyCase> colladaMeshes() {
  const std::string faces = "<triangles count=\"1\">" + kInput + "<p>0 1 2</p></triangles>";
  const Changes change{collada(faces)};
  const std::string normals = "<triangles count=\"1\" material=\"a\">" + kInput +
                              "<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/>" +
                              "<p>0 0 1 0 2 0</p></triangles>";
  return {
      change("mesh/source/float_array", "0 0 0 1 0 0", "0 0 0 2 0 0"),
      change("mesh/source/technique_common/accessor", "count=\"4\"", "offset=\"1\" count=\"4\""),
      {"mesh/source/technique_common/accessor/param", collada(faces),
       replaced(replaced(collada(faces), "stride=\"3\"", "stride=\"4\""), "count=\"4\" s",
                "count=\"3\" s")},
      {"mesh/vertices/input POSITION", collada(replaced(faces, "0 1 2", "0 0 0")),
       replaced(
           replaced(collada(replaced(faces, "0 1 2", "0 0 0")), "source=\"#p\"", "source=\"#n\""),
           "0 0 1<", "1 0 1<")},
      change("mesh/vertices/input NORMAL", "<input semantic=\"POSITION\"",
             "<input semantic=\"NORMAL\" source=\"#none\"/><input semantic=\"POSITION\""),
      group("triangles", faces),
      group("polylist",
            "<polylist count=\"1\">" + kInput + "<vcount>3</vcount><p>0 1 2</p></polylist>"),
      group("polygons", "<polygons count=\"1\">" + kInput + "<p>0 1 2</p></polygons>"),
      group("tristrips", "<tristrips count=\"1\">" + kInput + "<p>0 1 2</p></tristrips>"),
      {"mesh/triangles/input VERTEX", collada(normals),
       collada(replaced(replaced(normals, "VERTEX\" source=\"#v\" offset=\"0\"",
                                 "VERTEX\" source=\"#v\" offset=\"1\""),
                        "NORMAL\" source=\"#n\" offset=\"1\"",
                        "NORMAL\" source=\"#n\" offset=\"0\""))},
      {"mesh/triangles/input NORMAL", collada(normals),
       collada(
           replaced(replaced(normals, "source=\"#n\"", "source=\"#m\""), "0 0 1 0", "0 x 1 7"))},
      {"mesh/triangles material", collada(normals),
       collada(replaced(normals, "material=\"a\"", "material=\"b\""))},
      change("mesh/lines", "</mesh>", "<lines count=\"9\"><p>0 1 nan</p></lines></mesh>"),
      change("mesh/linestrips", "</mesh>", "<linestrips count=\"9\"><p>8</p></linestrips></mesh>"),
      change("mesh/extra", "</mesh>", "<extra><triangles/></extra></mesh>"),
      change("mesh/trifans", "</mesh>", "<trifans count=\"1\"/></mesh>"),
      change("mesh/polygons/ph", "</mesh>", "<polygons count=\"1\"><ph/></polygons></mesh>"),
      change("geometry/convex_mesh", "</mesh>", "</mesh><convex_mesh/>"),
      change("geometry/spline", "</mesh>", "</mesh><spline/>"),
  };
}

std::vector<KeyCase> colladaScenes() {
  const std::string faces = "<triangles count=\"1\">" + kInput + "<p>0 1 2</p></triangles>";
  const Changes change{collada(faces)};
  const auto placed = [&](const std::string& key, const std::string& more) {
    return KeyCase{key, collada(faces), collada(faces, more)};
  };
  std::vector<KeyCase> cases{
      change("asset/unit", "meter=\"1\"", "meter=\"0.01\""),
      change("asset/up_axis", "Z_UP", "Y_UP"),
      placed("node/translate", "<translate>1 0 0</translate>"),
      placed("node/rotate", "<rotate>0 0 1 90</rotate>"),
      placed("node/scale", "<scale>1 2 1</scale>"),
      placed("node/matrix", "<matrix>1 0 0 3 0 1 0 0 0 0 1 0 0 0 0 1</matrix>"),
      placed("node/skew", "<skew>0 1 0 0 0 1 0</skew>"),
      placed("node/lookat", "<lookat>1 1 1 0 0 0 0 0 1</lookat>"),
      placed("node/instance_geometry", "<instance_geometry url=\"#g\"/>"),
      change("node/instance_geometry/bind_material", "\"#g\"></instance_geometry>",
             "\"#g\"><bind_material><technique_common/></bind_material></instance_geometry>"),
      placed("node/instance_node", "<instance_node url=\"#other\"/>"),
      placed("node/instance_controller", "<instance_controller url=\"#c\"/>"),
      placed("node/instance_camera", "<instance_camera url=\"#none\"/>"),
      placed("node/instance_light", "<instance_light url=\"#none\"/>"),
      placed("node without geometry", "<node id=\"a\"><lookat/><scale>x</scale></node>"),
      change("scene/instance_visual_scene", "url=\"#s\"", "url=\"#t\"")};
  for (const std::string name :
       {"animations", "cameras", "controllers", "effects", "images", "lights", "materials"}) {
    const std::string library = "library_" + name;
    cases.push_back(change(library, "<library_geometries>",
                           "<" + library +
                               "><source id=\"p\"><float_array id=\"pa\" count=\"1\">"
                               "-1.#IND</float_array></source></" +
                               library + "><library_geometries>"));
  }
  return cases;
}

TEST(MeshFilesKeys, Collada) {
  std::vector<KeyCase> cases = colladaMeshes();
  for (KeyCase& key : colladaScenes()) cases.push_back(std::move(key));
  walkFormat("Meshes: COLLADA (.dae)", cases, trianglesOf(".dae"));
}

}  // namespace
}  // namespace swept
