// SPDX-License-Identifier: BSD-3-Clause
// A COLLADA file is read whole or not at all. Assimp 5.2, which read it once, left out holes,
// groups without a count, nodes and geometries that it did not find, what follows a comment in a
// list, and skewing, took a fan for one polygon, and could take the faces of one group for those of
// another: robots were loaded without part of their geometry.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "mesh_file_changes.hpp"

namespace swept {
namespace {

using test::changed;
using test::expectSaid;
using test::kLine;
using test::said;

/// A tetrahedron in two groups of faces, and a square that a node of the library shows.
const std::string kDae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="0.5"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array>
<technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3</p></triangles>
<polylist count="2"><input semantic="VERTEX" source="#v" offset="0"/>
<vcount>3 3</vcount><p>1 2 3 2 0 3</p></polylist>
</mesh></geometry>
<geometry id="h"><mesh>
<source id="q"><float_array id="qa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
<technique_common><accessor source="#qa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="w"><input semantic="POSITION" source="#q"/></vertices>
<polygons count="1"><input semantic="VERTEX" source="#w" offset="0"/><p>0 1 2 3</p></polygons>
</mesh></geometry></library_geometries>
<library_nodes><node id="square"><instance_geometry url="#h"/></node></library_nodes>
<library_visual_scenes><visual_scene id="s">
<node id="n"><translate>10 0 0</translate><rotate>0 0 1 90</rotate>
<instance_geometry url="#g"/>
<node id="m"><scale>2 2 2</scale><instance_node url="#square"/></node></node>
</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
)";

TEST(WholeColladaFiles, AreRead) {
  EXPECT_EQ(said("m.dae", kDae), "6");
  const std::string strips = changed(kDae, {"<polygons", "<tristrips", ""});
  expectSaid("m.dae", strips, {{"</polygons", "</tristrips", "6"}});
  expectSaid(
      "m.dae", kDae,
      {{"<p>0 1 2 3</p>", "<p>0 1 <!-- 7 -->2 3</p>", "6"},
       {"<translate>10 0 0</translate><rotate>0 0 1 90</rotate>",
        "<matrix>0 -1 0 10 1 0 0 0 0 0 1 0 0 0 0 1</matrix>", "6"},
       {"<vcount>", "<extra/><vcount>", "6"},
       {"</polylist>",
        "</polylist><lines count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 "
        "1</p></lines>",
        "6"}});
}

TEST(WholeColladaFiles, GroupsOfFaces) {
  const std::string allowed =
      "is not read; allowed are triangles, polylist, polygons and tristrips, and lines and "
      "linestrips, which have no faces";
  expectSaid(
      "m.dae", kDae,
      {{"<p>0 1 2 3</p>", "<ph><p>0 1 2 3</p><h>0 1 2</h></ph>",
        kLine + "20: <ph> is a polygon with holes, which is not read"},
       {"<p>0 1 2 3</p>", "<p>0 1</p>", kLine + "20: <polygons> has a <p> of less than 3 corners"},
       {"polygons count=\"1\"", "polygons count=\"0\"",
        kLine + "20: <polygons> has 1 elements <p>; its count is 0"},
       {"polygons count=\"1\"", "polygons",
        kLine + "20: <polygons> needs a whole number as 'count'"},
       {"<p>0 2 1 0 1 3</p>", "<p>0 2 1</p>",
        kLine + "10: <triangles> has 3 corners; as many as 3 times its count, 2, have to be there"},
       {"<p>0 2 1 0 1 3</p>", "<p>0 2 1</p><p>0 1 3</p>",
        kLine + "10: <triangles> has more than one <p>; one is allowed"},
       {"<vcount>3 3", "<vcount>3 2",
        kLine + "12: <vcount> has a face of '2' corners; 3 are the least"},
       {"<vcount>3 3", "<vcount>3",
        kLine +
            "11: <polylist> has 1 faces of 3 corners by its <vcount>, and 6 corners in its <p>; "
            "its count is 2"},
       {"offset=\"0\"/><p>0 2", "/><p>0 2", kLine + "10: <input> needs a whole number as 'offset'"},
       {"<p>0 2 1 0 1 3", "<p>0 2 1 0 1 4", kLine + "10: <p> has an index past its source"},
       {"semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 2",
        "semantic=\"NORMAL\" source=\"#p\" offset=\"0\"/><p>0 2",
        kLine + "10: <p> has no <input> of vertices to index"}});
  const std::string fans = changed(kDae, {"<polygons", "<trifans", ""});
  expectSaid("m.dae", fans, {{"</polygons", "</trifans", kLine + "20: <trifans> " + allowed}});
}

TEST(WholeColladaFiles, Positions) {
  expectSaid("m.dae", kDae,
             {{"source=\"#v\" offset=\"0\"/><p>", "source=\"#p\" offset=\"0\"/><p>",
               kLine + "10: <input> does not name the <vertices> of its <mesh>"},
              {"<vertices id=\"v\">", "<vertices>",
               kLine + "9: <vertices> needs an 'id', and to be the only one"},
              {"<param name=\"X\" type=\"float\"/><param name=\"Y\"",
               "<param name=\"Y\" type=\"float\"/><param name=\"X\"",
               kLine + "9: <input> needs a source whose <param> are X, Y and Z, in this order"},
              {">0 0 0 1 0 0 0 2", ">0 0 0 1 nan 0 0 2",
               kLine + "5: <float_array> has 'nan', which is no finite number"},
              {">0 0 0 1 0 0 0 2", ">0 0 0 1 0 0 2",
               kLine + "5: <float_array> does not hold as many numbers as its count"}});
  // Which other readers take for 0.
  expectSaid("m.dae", kDae, {{"0 0 3<", "0 0 3000000000000000000000e-21<", "6"}});
}

TEST(WholeColladaFiles, Scenes) {
  const std::string kinds =
      "is not read; allowed are instance_geometry and instance_node, and translate, rotate, scale "
      "and matrix";
  expectSaid(
      "m.dae", kDae,
      {{"<instance_node url=\"#square\"/>", "",
        kLine + "14: <geometry> with the id 'h' has faces, and no node of the scene shows it"},
       {"<instance_node url=\"#square\"/>", "<instance_node url=\"#round\"/>",
        kLine + "26: <instance_node> has url=\"#round\"; it must be # and an id of this file"},
       {"<node id=\"n\">", "<node id=\"n\" name=\"square\">",
        kLine + "26: <instance_node> names the id of one node, which is the name of another"},
       {"<instance_node url=\"#square\"/>", "<instance_node url=\"#m\"/>",
        kLine +
            "26: <node> is one too many: 1000000 nodes are the most that are shown, 500 in each "
            "other"},
       {"<instance_geometry url=\"#g\"/>", "<instance_geometry url=\"#k\"/>",
        kLine + "25: <instance_geometry> names a <geometry> that does not exist"},
       {"<instance_geometry url=\"#g\"/>", "<instance_controller url=\"#g\"/>",
        kLine + "25: <instance_controller> " + kinds},
       {"<scale>2 2 2</scale>", "<skew>0 1 0 0 0 1 0</skew>", kLine + "26: <skew> " + kinds},
       {"<scale>2 2 2</scale>", "<scale>2 2</scale>",
        kLine + "26: <scale> has 2 numbers; 3 have to be there"},
       {"<rotate>0 0 1 90", "<rotate>0 0 2 90",
        kLine + "24: <rotate> has an axis whose length is 2; it must be 1"},
       {"<geometry id=\"h\">", "<geometry id=\"g\">",
        kLine + "14: <geometry> is a second one with the id 'g'"},
       {"meter=\"0.5\"", "meter=\"-1\"",
        kLine + "3: <unit> has meter=\"-1\"; it must be a number greater than 0"},
       {"<scene><instance_visual_scene url=\"#s\"/></scene>", "",
        "cannot be read: it has no <scene> with an <instance_visual_scene>"},
       {"<instance_geometry url=\"#g\"/>",
        "<instance_geometry url=\"#g\"/><instance_geometry "
        "url=\"#g\"><bind_material/></instance_geometry>",
        "10"},
       {"<instance_geometry url=\"#g\"/>",
        "<instance_geometry url=\"#g\"/><instance_geometry url=\"#g\"/>", "10"}});
}

/// Nodes place corners in double precision, and what that rounds by is known where it is more than
/// any proof takes for rounding.
TEST(WholeColladaFiles, NodesPlaceInDoublePrecision) {
  const test::TemporaryFolder folder;
  detail::MeshFileReader reader;
  const auto content = [&](const std::string& from, const std::string& to) {
    return reader.read(folder.write("m.dae", changed(kDae, {from, to, ""})));
  };
  const auto has = [](const detail::MeshFileContent& mesh, const Eigen::Vector3d& corner) {
    return std::ranges::any_of(mesh.vertices, [&](const Eigen::Vector3d& vertex) {
      return (vertex - corner).norm() <= 1e-15 + mesh.error;
    });
  };
  // Turned from (0, 2, 0), moved by (10, 0, 0), in units of 0.5 m.
  const auto plain = content("<translate>10 0 0", "<translate>10.1 0 0");
  EXPECT_TRUE(has(plain, {0.5 * (10.1 - 2.0), 0.0, 0.0}));
  EXPECT_EQ(plain.error, 0.0);
  // Many whole turns.
  const auto turned = content("<rotate>0 0 1 90", "<rotate>0 0 1 360000000090");
  EXPECT_TRUE(has(turned, {4.0, 0.0, 0.0}));
  EXPECT_GT(turned.error, 1e-10);
  EXPECT_LT(turned.error, 1e-3);
  // What cancels has been rounded nevertheless.
  const auto far = content("<translate>10 0 0</translate>",
                           "<translate>1e9 0 0</translate><translate>10.1 0 0</translate>"
                           "<translate>-1e9 0 0</translate>");
  EXPECT_GT((far.vertices[0] - Eigen::Vector3d(5.05, 0.0, 0.0)).norm(), 1e-9);
  EXPECT_TRUE(has(far, {5.05, 0.0, 0.0}));
  EXPECT_LT(far.error, 1e-4);
}

TEST(WholeColladaFiles, OtherXmlIsRefused) {
  EXPECT_EQ(said("m.dae", "<robot/>"), "cannot be read: its root element is not <COLLADA>");
  EXPECT_EQ(said("m.dae", "\n<COLLADA>"), kLine + "2: malformed XML");
}

}  // namespace
}  // namespace swept
