// SPDX-License-Identifier: BSD-3-Clause
// A glTF file is read whole or not at all, though assimp, which reads it, leaves out what it does
// not understand and says nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "gltf_text.hpp"
#include "mesh_file_changes.hpp"

namespace swept {
namespace {

using test::Change;
using test::changed;
using test::said;

const test::GltfTetrahedron kTetrahedron;

/// What is said of the tetrahedron with a change of its JSON, as .glb.
std::string saidWith(const std::string& from, const std::string& to) {
  return said("m.glb",
              test::glbOf(changed(kTetrahedron.json(), {from, to, ""}), kTetrahedron.bytes));
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) {
    unsigned code = 0;
    for (std::size_t k = 0; k < 3; ++k) code = code << 8 | static_cast<unsigned char>(bytes[i + k]);
    for (const int shift : {18, 12, 6, 0}) text += kLetters[code >> shift & 63U];
  }
  return text;
}

TEST(WholeGltfFiles, AreRead) {
  EXPECT_EQ(said("m.glb", kTetrahedron.glb()), "4");
  EXPECT_EQ(said("m.GLB", kTetrahedron.glb("\"scale\":[2,3,4]")), "4");
  const std::string inText =
      changed(kTetrahedron.json(), {"\"byteLength\":72",
                                    "\"byteLength\":72,\"uri\":\"data:application/octet-stream;"
                                    "base64," +
                                        base64(kTetrahedron.bytes) + "\"",
                                    ""});
  EXPECT_EQ(said("m.gltf", inText), "4");
  EXPECT_EQ(saidWith("\"nodes\":[{\"mesh\":0}]", "\"nodes\":[{\"children\":[1]},{\"mesh\":0}]"),
            "4");
  EXPECT_EQ(saidWith("\"indices\":1", "\"indices\":1,\"mode\":5"), "10");  // a strip
  EXPECT_EQ(saidWith("\"indices\":1", "\"indices\":1},{\"attributes\":{\"POSITION\":0},\"mode\":1"),
            "4");
  EXPECT_EQ(saidWith("\"version\":\"2.0\"}",
                     "\"version\":\"2.0\"},\"extensionsRequired\":"
                     "[\"KHR_materials_unlit\"]"),
            "4");
}

TEST(WholeGltfFiles, NodesPlaceTheirMeshes) {
  const test::TemporaryFolder folder;
  detail::MeshFileReader reader;
  const detail::MeshFileContent content = reader.read(folder.write(
      "m.glb", kTetrahedron.glb("\"rotation\":[0,0,0.7071067811865476,0.7071067811865476],"
                                "\"translation\":[0.1,0.2,0.3],\"scale\":[2,2,2]")));
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : content.vertices) box.extend(vertex);
  EXPECT_LE((box.min() - Eigen::Vector3d(-1.9, 0.2, 0.3)).norm(), content.error);
  EXPECT_LE((box.max() - Eigen::Vector3d(0.1, 2.2, 2.3)).norm(), content.error);
  EXPECT_LT(content.error, 5e-5);
}

/// The tetrahedron below so many nodes of the same transform.
std::string nested(int count, const std::string& placed) {
  std::string nodes;
  for (int i = 0; i < count; ++i)
    nodes += "{" + placed +
             (i + 1 < count ? ",\"children\":[" + std::to_string(i + 1) + "]}," : ",\"mesh\":0}");
  return test::glbOf(changed(kTetrahedron.json(), {"{\"mesh\":0}", nodes, ""}), kTetrahedron.bytes);
}

/// Rooms in buildings in towns: what a node does to lengths, not how many there are, is what
/// single precision loses.
TEST(WholeGltfFiles, ManyNodesInEachOtherAreRead) {
  const test::TemporaryFolder folder;
  detail::MeshFileReader reader;
  const auto read = [&](int count, const std::string& placed) {
    return reader.read(folder.write("m.glb", nested(count, placed)));
  };
  // 60 times a third of a turn about the diagonal.
  const detail::MeshFileContent turned = read(60, "\"rotation\":[0.5,0.5,0.5,0.5]");
  // Moved by 6 m.
  const detail::MeshFileContent moved = read(60, "\"translation\":[0.1,0,0]");
  // 0.9^60 of the size.
  const detail::MeshFileContent scaled = read(60, "\"scale\":[0.9,0.9,0.9]");
  // Their corners may come in another order.
  const auto holds = [](const detail::MeshFileContent& content, const Eigen::Vector3d& corner) {
    return std::ranges::any_of(content.vertices, [&](const Eigen::Vector3d& vertex) {
      return (vertex - corner).norm() <= content.error;
    });
  };
  for (const auto& [x, y, z] : kTetrahedron.corners) {
    const Eigen::Vector3d corner(x, y, z);
    EXPECT_TRUE(holds(turned, corner));
    EXPECT_TRUE(holds(moved, corner + Eigen::Vector3d(6.0, 0.0, 0.0)));
    EXPECT_TRUE(holds(scaled, std::pow(0.9, 60) * corner));
  }
  EXPECT_LT(turned.error, 1e-3);
  EXPECT_LT(moved.error, 1e-4);
  EXPECT_LT(scaled.error, 1e-3 * std::pow(0.9, 60));
}

TEST(WholeGltfFiles, WhatNodesPlaceTooInexactlyIsRefused) {
  const std::string far = changed(
      kTetrahedron.json(),
      {"{\"mesh\":0}",
       "{\"translation\":[1e6,0,0],\"children\":[1]},{\"translation\":[-1e6,0,0],\"mesh\":0}", ""});
  EXPECT_EQ(said("m.glb", test::glbOf(far, kTetrahedron.bytes)),
            "cannot be read: in single precision its nodes place it only to within "
            "0.715256614807299 m; at most 0.01 m are allowed");
}

TEST(WholeGltfFiles, WhatIsCutOffIsRefused) {
  const std::string whole = kTetrahedron.glb();
  for (std::size_t size = 1; size < whole.size(); size += 7)
    EXPECT_EQ(said("m.glb", whole.substr(0, size)).find("cannot be read: "), 0U) << size;
  EXPECT_EQ(said("m.glb", whole + "more"),
            "cannot be read: its header says " + std::to_string(whole.size()) +
                " bytes, and there are " + std::to_string(whole.size() + 4));
  EXPECT_EQ(said("m.gltf", "{"),
            "cannot be read: its line 1: malformed JSON: syntax error while "
            "parsing object key - unexpected end of input; expected string "
            "literal");
}

TEST(WholeGltfFiles, WhatIsNotReadIsRefused) {
  const auto expect = [](const std::string& from, const std::string& to,
                         const std::string& message) {
    SCOPED_TRACE(from + " -> " + to);
    EXPECT_EQ(saidWith(from, to), "cannot be read: " + message);
  };
  expect("\"2.0\"", "\"1.0\"", "asset.version is \"1.0\"; it must be 2.0");
  expect("\"2.0\"}", "\"2.0\"},\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]",
         "extensionsRequired[0] is \"KHR_draco_mesh_compression\"; it must be an extension of "
         "materials, textures or lights");
  expect("{\"mesh\":0}", "{\"mesh\":0,\"skin\":0}", "nodes[0] has a skin, which is not read");
  expect("{\"mesh\":0}", "{\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{}}}",
         "nodes[0] has EXT_mesh_gpu_instancing, which is not read");
  expect("{\"mesh\":0}", "{\"mesh\":0,\"rotation\":[0,0,1,1]}",
         "nodes[0].rotation has another length than 1");
  expect("{\"mesh\":0}", "{\"mesh\":0,\"children\":[0]}",
         "nodes[0] is one too many: 1000000 nodes are the most, 500 in each other");
  expect("\"nodes\":[{\"mesh\":0}]", "\"nodes\":[{},{\"mesh\":0}]",
         "meshes[0] has faces, and no node of the scene shows it");
  expect("\"indices\":1", "\"indices\":1,\"targets\":[{}]",
         "meshes[0].primitives[0] has targets to change into, which are not read");
  expect("\"indices\":1", "\"indices\":2",
         "meshes[0].primitives[0].indices is 2; it must be a whole number between 0 and 1");
  expect("\"count\":12", "\"count\":11",
         "meshes[0].primitives[0] has 11 corners; 3 make a triangle");
  expect("\"count\":12", "\"count\":15", "accessors[1] reaches beyond its buffer");
  expect("\"count\":4", "\"count\":5", "accessors[0] reaches beyond its buffer");
  expect("\"count\":4", "\"sparse\":{},\"count\":4", "accessors[0] is sparse, which is not read");
  expect("5126", "5122",
         "accessors[0].componentType is 5122; it must be of a kind that is read there");
  expect("\"VEC3\"", "\"VEC2\"", "accessors[0].type is \"VEC2\"; it must be VEC3");
  expect("\"byteLength\":72", "\"byteLength\":76",
         "buffers[0] has 76 bytes, of which 72 are there");
  expect("\"byteLength\":72", "\"byteLength\":72,\"uri\":\"m.bin\"",
         "buffers[0].uri names another file; what is needed has to be in the file itself");
  expect("\"max\":[1,1,1]", "\"max\":[1,1,0.5]",
         "its faces reach no farther than from (0, 0, 0) to (1, 1, 0.5), and those that assimp "
         "makes of them from (0, 0, 0) to (1, 1, 1)");
}

}  // namespace
}  // namespace swept
