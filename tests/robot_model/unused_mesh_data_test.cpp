// SPDX-License-Identifier: BSD-3-Clause
// No face needs a normal, a colour, a texture, a material, a camera or a lamp, so none of them
// costs a file. Assimp 5.2 refused whole files for NaN as Windows writes it, with the rest of the
// file in the message.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "mesh_file_changes.hpp"

namespace swept {
namespace {

using test::Change;
using test::changed;
using Face = std::array<std::array<double, 3>, 3>;

std::vector<Face> facesOf(const std::string& name, const std::string& text) {
  const test::TemporaryFolder folder;
  detail::MeshFileReader reader;
  std::vector<Face> faces;
  try {
    const detail::MeshFileContent content = reader.read(folder.write(name, text));
    for (const Eigen::Vector3i& triangle : content.triangles) {
      Face face;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& v = content.vertices.at(static_cast<std::size_t>(triangle[int(i)]));
        face[i] = {v.x(), v.y(), v.z()};
      }
      faces.push_back(face);
    }
  } catch (const detail::MeshFileError& error) {
    ADD_FAILURE() << error.what();
  }
  return faces;
}

/// The same faces come of the text with each of the changes; `message` of a change is not looked
/// at.
void expectSame(const std::string& name, const std::string& text,
                const std::vector<Change>& changes) {
  const std::vector<Face> plain = facesOf(name, text);
  ASSERT_FALSE(plain.empty());
  for (const Change& change : changes) {
    SCOPED_TRACE("'" + change.from + "' -> '" + change.to + "'");
    EXPECT_EQ(facesOf(name, changed(text, change)), plain);
  }
}

/// NaN and infinity, and what is no number to anybody.
const std::vector<std::string> kNoNumbers{
    "nan",    "-nan",      "nan(ind)",    "-nan(ind)", "1.#QNAN", "-1.#IND",
    "1.#INF", "-1.#IND00", "inf",         "1e999",     "0,5",     "-",
    "x",      "0x10",      "1.#QNAN(7f)", "nan(snan)", "\xff\x01"};

std::string three(const std::string& word) {
  return word + " " + word + " " + word;
}

TEST(UnusedMeshData, NormalsOfStl) {
  const std::string text =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 0\nendloop\n"
      "endfacet\nfacet normal 0 1 0\nouter loop\nvertex 0 0 0\nvertex 0 0 3\nvertex 1 0 0\n"
      "endloop\nendfacet\nendsolid a\n";
  std::vector<Change> changes{{"normal 0 0 1", "normal", ""},
                              {"normal 0 0 1", "normal 0 0", ""},
                              {"normal 0 0 1", "normal 0 0 1 0", ""},
                              {"normal 0 1 0", "normal 7 8 9", ""}};
  for (const std::string& word : kNoNumbers) {
    changes.push_back({"normal 0 0 1", "normal " + three(word), ""});
    changes.push_back({"normal 0 1 0", "normal 0 " + word + " 0", ""});
  }
  expectSame("m.stl", text, changes);
}

TEST(UnusedMeshData, NormalsTexturesAndColoursOfObj) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nvt 0 0\nvn 0 0 1\nf 1/1/1 3/1/1 2/1/1\nf 1//1 2//1 "
      "4//1\n";
  std::vector<Change> changes{
      {"vn 0 0 1\n", "", ""},      {"vn 0 0 1", "vn 0", ""},
      {"vt 0 0\n", "", ""},        {"vt 0 0", "vt", ""},
      {"1//1 2//1", "1//1 2", ""}, {"1//1 2//1", "1//9 2/0/-7", ""},
      {"1//1 2//1", "1/ 2//", ""}, {"vt 0 0", "usemtl a\nmtllib b\nvt 0 0\ng c\no d\ns 1", ""}};
  for (const std::string& word : kNoNumbers) {
    changes.push_back({"vn 0 0 1", "vn " + three(word), ""});
    changes.push_back({"vt 0 0", "vt " + word + " 0", ""});
    changes.push_back({"v 1 0 0", "v 1 0 0 " + three(word), ""});
  }
  expectSame("m.obj", text, changes);
}

TEST(UnusedMeshData, PropertiesOfPly) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement camera 1\nproperty float view_px\nelement vertex 4\n"
      "property float x\nproperty float nx\nproperty float y\nproperty float z\nproperty uchar "
      "red\n"
      "element face 2\nproperty float quality\nproperty list uchar int vertex_indices\n"
      "element edge 1\nproperty int vertex1\nend_header\n"
      "0.5\n0 5 0 0 9\n1 5 0 0 9\n0 5 2 0 9\n0 5 0 3 9\n8 3 0 2 1\n8 3 0 1 3\n5\n";
  std::vector<Change> changes{{"property uchar red", "property double red", ""}};
  for (const std::string& word : kNoNumbers) {
    changes.push_back({"1 5 0 0 9", "1 " + word + " 0 0 9", ""});
    changes.push_back({"1 5 0 0 9", "1 5 0 0 " + word, ""});
    changes.push_back({"8 3 0 2 1", word + " 3 0 2 1", ""});
    changes.push_back({"\n0.5\n", "\n" + word + "\n", ""});
  }
  expectSame("m.ply", text, changes);
}

/// A tetrahedron with normals, which a node shows, beside a camera.
const std::string kDae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_cameras><camera id="c"><optics><technique_common><perspective><xfov>50</xfov></perspective></technique_common></optics></camera></library_cameras>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array>
<technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<source id="n"><float_array id="na" count="3">0 0 1</float_array>
<technique_common><accessor source="#na" count="1" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4" material="m"><input semantic="NORMAL" source="#n" offset="0"/><input semantic="VERTEX" source="#v" offset="1"/>
<p>0 0 0 2 0 1 0 0 0 1 0 3 0 1 0 2 0 3 0 2 0 0 0 3</p></triangles>
</mesh></geometry></library_geometries>
<library_nodes><node id="spare"><translate>1 2 3</translate></node></library_nodes>
<library_visual_scenes><visual_scene id="s">
<node id="a"><translate>10 0 0</translate><instance_geometry url="#g"><bind_material/></instance_geometry></node>
<node id="k"><translate>1 1 1</translate><instance_camera url="#c"/></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

TEST(UnusedMeshData, SourcesThatGiveNoCornerInCollada) {
  std::vector<Change> changes{
      {">0 0 1<", ">0 0<", ""},
      {"id=\"na\" count=\"3\"", "id=\"na\" count=\"many\"", ""},
      {"id=\"na\" count=\"3\"", "id=\"pa\" count=\"3\"", ""},
      {"source=\"#na\" count=\"1\"", "source=\"#nb\" count=\"100\"", ""},
      {"NORMAL\" source=\"#n\"", "NORMAL\" source=\"#lost\"", ""},
      {"<p>0 0 0 2", "<p>7 0 -1 2", ""},
      {"<source id=\"n\">", "<source id=\"m\">", ""},
      {"<vertices id=\"v\">", "<vertices id=\"v\"><input semantic=\"NORMAL\" source=\"#none\"/>",
       ""},
      {"</mesh>", "<lines count=\"x\"><p>a</p></lines><extra><ph/></extra></mesh>", ""},
      {"</library_geometries>",
       "<geometry id=\"empty\"><mesh><source id=\"p\"><float_array>x</float_array></source>"
       "<vertices/></mesh></geometry><geometry id=\"empty\"/><geometry/></library_geometries>",
       ""}};
  for (const std::string& word : kNoNumbers) {
    if (word.find('\x01') != std::string::npos) continue;  // no XML
    changes.push_back({">0 0 1<", ">" + three(word) + "<", ""});
  }
  expectSame("m.dae", kDae, changes);
  // Normals in one array with the positions.
  const Change woven{
      "id=\"pa\" count=\"12\">0 0 0 1 0 0 0 2 0 0 0 3",
      "id=\"pa\" count=\"25\">x 0 0 0 nan 1 # 1 0 0 nan 1 # 0 2 0 nan 1 # 0 0 3 nan 1 #", ""};
  const Change strides{"count=\"4\" stride=\"3\"", "count=\"4\" offset=\"1\" stride=\"6\"", ""};
  EXPECT_EQ(facesOf("m.dae", changed(changed(kDae, woven), strides)), facesOf("m.dae", kDae));
}

TEST(UnusedMeshData, NodesWithoutGeometryInCollada) {
  const std::string camera = "<node id=\"k\"><instance_camera url=\"#c\"/></node>";
  std::vector<Change> changes{
      {"<translate>1 1 1</translate>", "<lookat>1 1 1 0 0 0 0 0 1</lookat>", ""},
      {"<translate>1 1 1</translate>", "<skew>45 0 1 0 1 0 0</skew>", ""},
      {"<translate>1 1 1</translate>", "<translate>1 -1.#IND</translate>", ""},
      {"<translate>1 1 1</translate>", "<rotate>0 0 7 90</rotate><matrix/>", ""},
      {"<translate>1 2 3</translate>", "<lookat/>", ""},
      {"</visual_scene>", camera + camera + "</visual_scene>", ""},
      {"</visual_scene>", "<node id=\"spare\"/><node id=\"a\" name=\"a\"/></visual_scene>", ""},
      {"<instance_camera url=\"#c\"/>", "<instance_light url=\"#none\"/><node><scale/></node>", ""},
      {"</visual_scene>",
       "</visual_scene><visual_scene id=\"t\"><node><lookat/><instance_geometry "
       "url=\"#lost\"/></node></visual_scene>",
       ""},
      {"<xfov>50</xfov>", "<xfov>wide</xfov>", ""},
      {"<bind_material/>",
       "<bind_material><technique_common><b/></technique_common></bind_material>", ""},
      {"<library_nodes>",
       "<library_effects><effect><profile_COMMON><newparam/></profile_COMMON></effect>"
       "</library_effects><library_animations><animation><source id=\"p\"/></animation>"
       "</library_animations><library_nodes>",
       ""}};
  expectSame("m.dae", kDae, changes);
}

/// Names of one id, where a face depends on which one is meant.
TEST(UnusedMeshData, WhatAFaceNeedsIsJudged) {
  test::expectSaid(
      "m.dae", kDae,
      {{"<source id=\"n\">", "<source id=\"p\">",
        test::kLine + "14: <input> names the id 'p', which more than one source has"},
       {"<node id=\"k\">", "<node id=\"a\"><lookat/><instance_geometry url=\"#g\"/></node><node>",
        test::kLine + "21: <lookat> is not read; allowed are instance_geometry and instance_node, "
                      "and translate, rotate, scale and matrix"},
       {"<instance_camera url=\"#c\"/>", "<instance_node url=\"#spare\"/>", "4"},
       {"<instance_camera url=\"#c\"/>",
        "<instance_node url=\"#spare\"/></node><node id=\"spare\"><instance_geometry url=\"#g\"/>",
        test::kLine + "21: <instance_node> has url=\"#spare\"; the elements at lines 18 and 21 "
                      "both have that id"},
       {"</visual_scene>", "</visual_scene><visual_scene id=\"s\"/>",
        test::kLine + "23: <instance_visual_scene> has url=\"#s\"; the elements at lines 19 and 22 "
                      "both have that id"},
       {"</library_geometries>", "<geometry id=\"g\"/></library_geometries>",
        test::kLine + "17: <geometry> is a second one with the id 'g'"},
       {"<geometry id=\"g\">", "<geometry>", test::kLine + "5: <geometry> has no attribute 'id'"},
       {"<p>0 0 0 2", "<p>0 0 0 -2", test::kLine + "16: <p> does not hold whole numbers only"}});
}

TEST(UnusedMeshData, CrossingFacesOfColladaAreNamed) {
  const std::string five =
      changed(changed(kDae, {"count=\"12\">0 0 0 1 0 0 0 2 0 0 0 3",
                             "count=\"15\">2 0 0 2 3 0 3 1 0 2 1 0 1 0 0", ""}),
              {"count=\"4\" stride", "count=\"5\" stride", ""});
  const std::string must =
      " of 5 corners crosses or touches itself; a face of more than 4 corners must not, or has to "
      "be given as "
      "triangles";
  const auto with = [&](const std::string& faces) {
    std::string text = five;
    const auto begin = text.find("<triangles");
    const auto end = text.find("</triangles>") + 12;
    return text.replace(begin, end - begin, faces);
  };
  const std::string input = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>\n";
  EXPECT_EQ(test::said("m.dae", with("<polygons count=\"2\">" + input +
                                     "<p>0 2 1 3 4</p>\n<p>0 1 2 3 4</p></polygons>")),
            test::kLine + "17: a face" + must);
  EXPECT_EQ(test::said("m.dae", with("<polylist count=\"3\">" + input +
                                     "<vcount>3 5 5</vcount>\n<p>0 1 2 0 2 1 3 4 0 1 2 3 "
                                     "4</p></polylist>")),
            test::kLine + "17: face 2, counted from 0," + must);
}

}  // namespace
}  // namespace swept
