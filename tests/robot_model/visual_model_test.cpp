// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "format_table.hpp"
#include "input_files.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/visual_model.hpp"

/// What robots look like: read apart from what they collide with, and never at its cost.
namespace swept {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

using Mesh = std::shared_ptr<const VisualMesh>;

std::string robotOf(const std::string& visuals, const std::string& materials = "") {
  return "<robot name='r'>" + materials + "<link name='a'>" + visuals + "</link></robot>";
}

std::string meshVisual(const std::string& file, const std::string& more = "") {
  return "<visual><geometry><mesh filename='" + file + "'/></geometry>" + more + "</visual>";
}

/// A cube with two materials, red below and of `upper` above, in centimetres.
std::string twoColours(const std::string& upper) {
  const auto effect = [](const std::string& id, const std::string& diffuse) {
    return "<effect id='" + id + "-fx'><profile_COMMON><technique sid='common'><phong><diffuse>" +
           diffuse + "</diffuse></phong></technique></profile_COMMON></effect>";
  };
  const auto material = [](const std::string& id) {
    return "<material id='" + id + "'><instance_effect url='#" + id + "-fx'/></material>";
  };
  const auto binding = [](const std::string& id) {
    return "<instance_material symbol='" + id + "-symbol' target='#" + id + "'/>";
  };
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "
         "version='1.4.1'><asset><unit meter='0.01'/></asset><library_effects>" +
         effect("low", "<color>1 0 0 1</color>") + effect("high", upper) +
         "</library_effects><library_materials>" + material("low") + material("high") +
         "</library_materials><library_geometries><geometry id='g'><mesh><source id='p'>"
         "<float_array id='f' count='12'>0 0 0 100 0 0 0 100 0 0 0 100</float_array>"
         "<technique_common><accessor source='#f' count='4' stride='3'><param name='X' "
         "type='float'/><param name='Y' type='float'/><param name='Z' type='float'/></accessor>"
         "</technique_common></source><vertices id='v'><input semantic='POSITION' "
         "source='#p'/></vertices><triangles material='low-symbol' count='1'><input "
         "semantic='VERTEX' source='#v' offset='0'/><p>0 2 1</p></triangles><triangles "
         "material='high-symbol' count='3'><input semantic='VERTEX' source='#v' offset='0'/>"
         "<p>0 1 3 1 2 3 2 0 3</p></triangles></mesh></geometry></library_geometries>"
         "<library_visual_scenes><visual_scene id='s'><node id='n'><instance_geometry url='#g'>"
         "<bind_material><technique_common>" +
         binding("low") + binding("high") +
         "</technique_common></bind_material></instance_geometry></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

/// A wavy sheet of 2 n n triangles over the unit square.
std::string sheetObj(int n) {
  std::ostringstream text;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      text << "v " << double(i) / n << ' ' << double(j) / n << ' ' << 0.1 * std::sin(9.0 * i / n)
           << '\n';
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int at = i * (n + 1) + j + 1;
      text << "f " << at << ' ' << at + n + 1 << ' ' << at + n + 2 << "\nf " << at << ' '
           << at + n + 2 << ' ' << at + 1 << '\n';
    }
  return text.str();
}

class VisualModelTest : public testing::Test {
 protected:
  VisualModel read(const std::string& urdf, const VisualLimits& limits = {}) {
    warnings_.lines.clear();
    return VisualModel::parse(urdf, (folder_.path() / "r.urdf").string(), warnings_.options(),
                              limits);
  }
  std::string place(int line) {
    return (folder_.path() / "r.urdf").string() + ":" + std::to_string(line) + ": warning: ";
  }
  test::TemporaryFolder folder_;
  test::Warnings warnings_;
};

TEST_F(VisualModelTest, ShapesAreWhereTheirOriginSays) {
  const VisualModel model = read(robotOf(
      "<visual><origin xyz='1 2 3' rpy='0.1 0.2 0.3'/><geometry><box size='1 2 3'/></geometry>"
      "</visual><visual><geometry><cylinder radius='2' length='6'/></geometry></visual>"
      "<visual><geometry><capsule radius='1' length='4'/></geometry></visual>"));
  ASSERT_THAT(model.links, SizeIs(1));
  ASSERT_THAT(model.links[0].visuals, SizeIs(3));
  EXPECT_EQ(std::get<Box>(model.links[0].visuals[0].shape).halfExtents,
            Eigen::Vector3d(0.5, 1.0, 1.5));
  EXPECT_EQ(std::get<Cylinder>(model.links[0].visuals[1].shape).halfLength, 3.0);
  EXPECT_EQ(std::get<Capsule>(model.links[0].visuals[2].shape).radius, 1.0);
  // The collision reader, which has its poses from urdfdom, is the judge.
  const auto robot = Robot::parse(
      robotOf("<collision><origin xyz='1 2 3' rpy='0.1 0.2 0.3'/><geometry><box size='1 2 3'/>"
              "</geometry></collision>"),
      "r.urdf");
  EXPECT_TRUE(model.links[0].visuals[0].link_from_shape.isApprox(
      robot->links()[0].collision[0].link_from_shape, 1e-12));
  EXPECT_THAT(warnings_.lines, IsEmpty());
}

TEST_F(VisualModelTest, MaterialsGiveColoursByNameOrInline) {
  const std::string box = "<geometry><box size='1 1 1'/></geometry>";
  const auto visual = [&](const std::string& material) {
    return "<visual>" + box + material + "</visual>";
  };
  const VisualModel model =
      read(robotOf(visual("<material name='steel'/>") +
                       visual("<material name=''><color rgba='0 1 0 0.5'/>"
                              "</material>") +
                       visual("<material name='steel'><color rgba='0 0 0 1'/></material>") +
                       visual("<material name='later'/>") +
                       visual("<material name='later'><color rgba='1 0 0 1'/>"
                              "</material>") +
                       visual("") + visual("<material name='nobody'/>"),
                   "<material name='steel'><color rgba='0.5 0.6 0.7 1'/></material>"));
  std::vector<std::optional<Colour>> colours;
  for (const Visual& one : model.links.at(0).visuals) colours.push_back(one.colour);
  const Colour steel{0.5, 0.6, 0.7, 1.0}, red{1.0, 0.0, 0.0, 1.0};
  EXPECT_THAT(colours, ElementsAre(steel, Colour{0.0, 1.0, 0.0, 0.5}, steel, red, red, std::nullopt,
                                   std::nullopt));
  EXPECT_EQ(model.links[0].colour, std::nullopt);
  EXPECT_THAT(warnings_.lines,
              ElementsAre(place(1) + "material 'nobody' of <visual> of link 'a' is not defined: it "
                                     "is shown without a colour"));
}

TEST_F(VisualModelTest, ALinkHasAColourWhereAllItsVisualsHaveIt) {
  const std::string red = "<material name='red'><color rgba='1 0 0 1'/></material>";
  const std::string shape = "<geometry><sphere radius='1'/></geometry>";
  const Colour expected{1.0, 0.0, 0.0, 1.0};
  const auto colourOf = [&](const std::string& visuals) {
    return read(robotOf(visuals)).links.at(0).colour;
  };
  EXPECT_EQ(colourOf("<visual>" + shape + red + "</visual><visual>" + shape +
                     "<material name='red'/></visual>"),
            expected);
  EXPECT_EQ(colourOf("<visual>" + shape + red + "</visual><visual>" + shape + "</visual>"),
            std::nullopt);
  EXPECT_EQ(colourOf("<visual>" + shape + "</visual><visual>" + shape + red + "</visual>"),
            std::nullopt);
  // Also where the shape itself cannot be shown.
  EXPECT_EQ(colourOf(meshVisual("nowhere.stl", red)), expected);
}

TEST_F(VisualModelTest, NothingThatIsWrongCostsTheRest) {
  folder_.write("bad.stl", "solid cut off\nfacet");
  folder_.write("cube.obj", test::kCubeObj);
  const VisualModel model = read(robotOf(
      meshVisual("gone.stl") + "\n" + meshVisual("gone.dae") + "\n" + meshVisual("bad.stl") + "\n" +
      "<visual><geometry><torus/></geometry></visual>\n<visual/>\n" +
      "<visual><origin xyz='1 2'/><geometry><box size='1 1 1'/></geometry></visual>\n" +
      "<visual><geometry><sphere radius='-1'/></geometry></visual>\n" + meshVisual("cube.obj")));
  ASSERT_THAT(model.links.at(0).visuals, SizeIs(1));
  EXPECT_EQ(model.links[0].leftOut, 7U);
  EXPECT_EQ(model.leftOut, 7U);
  EXPECT_THAT(std::get<Mesh>(model.links[0].visuals[0].shape)->triangles, SizeIs(12));
  ASSERT_THAT(warnings_.lines, SizeIs(3));
  EXPECT_EQ(warnings_.lines[0], place(1) +
                                    "2 meshes of <visual> are not found: they are left out of what "
                                    "is shown (first at line 1)");
  EXPECT_THAT(warnings_.lines[1],
              HasSubstr(place(3) + "mesh 'bad.stl' of <visual> of link 'a' cannot be read"));
  EXPECT_EQ(warnings_.lines[2],
            place(4) +
                "4 elements <visual> cannot be read: they are left out of what is shown (first at "
                "line 4)");
}

TEST_F(VisualModelTest, EveryWarningNamesItsOwnElement) {
  LoadOptions options = warnings_.options();
  options.everyWarning = true;
  folder_.write("bad.stl", "");
  static_cast<void>(VisualModel::parse(
      "<robot name='r'><link name='a'>" + meshVisual("bad.stl") + "</link>\n<link name='b'>" +
          meshVisual("bad.stl") +
          "<visual><geometry><box size='1 2'/></geometry></visual></link></robot>",
      (folder_.path() / "r.urdf").string(), options));
  EXPECT_THAT(
      warnings_.lines,
      ElementsAre(place(1) + "mesh 'bad.stl' of <visual> of link 'a' is empty: it is left out of "
                             "what is shown",
                  place(2) + "mesh 'bad.stl' of <visual> of link 'b' is empty: it is left out of "
                             "what is shown",
                  place(2) + "<box size=\"1 2\"> of link 'b' must be 3 finite numbers separated by "
                             "spaces: it is left out of what is shown"));
}

TEST_F(VisualModelTest, WhatIsNoRobotIsRefused) {
  EXPECT_THAT(test::inputError([&] { read("<robot"); }), HasSubstr("r.urdf:1: error: malformed"));
  EXPECT_THAT(test::inputError([&] { read("<sdf/>"); }), HasSubstr("must be <robot>"));
  EXPECT_THAT(test::inputError([&] { static_cast<void>(VisualModel::load("/nowhere.urdf")); }),
              HasSubstr("/nowhere.urdf"));
}

/// A mesh whose corners are written three times has each of them once.
TEST_F(VisualModelTest, CornersAreWelded) {
  folder_.write("cube.obj", test::kCubeObj);
  const VisualModel model = read(
      robotOf("<visual><geometry><mesh filename='cube.obj' scale='2 1 -1'/></geometry></visual>"));
  const Mesh mesh = std::get<Mesh>(model.links.at(0).visuals.at(0).shape);
  EXPECT_THAT(mesh->vertices, SizeIs(8));
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& vertex : mesh->vertices) box.extend(vertex);
  EXPECT_EQ(box.min(), Eigen::Vector3f(0, 0, -1));
  EXPECT_EQ(box.max(), Eigen::Vector3f(2, 1, 0));
}

TEST_F(VisualModelTest, AColladaFileHasItsOwnColours) {
  folder_.write("two.dae", twoColours("<color>0 0 1 1</color>"));
  const std::string green = "<material name='g'><color rgba='0 1 0 1'/></material>";
  const VisualModel model = read(robotOf(meshVisual("two.dae", green)));
  EXPECT_THAT(warnings_.lines, IsEmpty());
  const std::vector<Visual>& parts = model.links.at(0).visuals;
  ASSERT_THAT(parts, SizeIs(2));
  EXPECT_EQ(parts[0].colour, (Colour{1.0, 0.0, 0.0, 1.0}));
  EXPECT_EQ(parts[1].colour, (Colour{0.0, 0.0, 1.0, 1.0}));
  EXPECT_THAT(std::get<Mesh>(parts[0].shape)->triangles, SizeIs(1));
  ASSERT_THAT(std::get<Mesh>(parts[1].shape)->triangles, SizeIs(3));
  // Centimetres.
  for (const Eigen::Vector3f& vertex : std::get<Mesh>(parts[1].shape)->vertices)
    EXPECT_LE(vertex.norm(), 1.0F);
  EXPECT_EQ(model.links[0].colour, (Colour{0.0, 1.0, 0.0, 1.0}));
}

/// Faces that the mesh gives no colour have the URDF's.
TEST_F(VisualModelTest, APictureIsNoColour) {
  folder_.write("two.dae", twoColours("<texture texture='t' texcoord='UV'/>"));
  const std::string green = "<material name='g'><color rgba='0 1 0 1'/></material>";
  const VisualModel model = read(robotOf(meshVisual("two.dae", green)));
  std::size_t triangles = 0;
  for (const Visual& part : model.links.at(0).visuals) {
    EXPECT_NE(part.colour, std::nullopt);
    triangles += std::get<Mesh>(part.shape)->triangles.size();
  }
  EXPECT_EQ(triangles, 4U);
  EXPECT_EQ(model.links[0].visuals.back().colour, (Colour{0.0, 1.0, 0.0, 1.0}));
}

/// Materials that cannot be read cost the colours alone.
TEST_F(VisualModelTest, BrokenMaterialsCostTheColoursAlone) {
  std::string text = twoColours("<color>0 0 1 1</color>");
  text.replace(text.find("<instance_effect url='#low-fx'/>"), 32,
               "<instance_effect url='nowhere'/>");
  folder_.write("two.dae", text);
  const VisualModel model = read(robotOf(meshVisual("two.dae")));
  EXPECT_THAT(warnings_.lines, IsEmpty());
  EXPECT_EQ(model.triangles, 4U);
}

TEST_F(VisualModelTest, LargeMeshesAreMadeCoarserAndKeepTheirShape) {
  folder_.write("large.obj", sheetObj(100));
  folder_.write("small.obj", test::kCubeObj);
  const std::string urdf =
      robotOf(meshVisual("large.obj") + meshVisual("large.obj") + meshVisual("small.obj"));
  EXPECT_EQ(read(urdf).triangles, 20'012U);
  const VisualModel model = read(urdf, {.triangles = 3000});
  EXPECT_LE(model.triangles, 3000U);
  EXPECT_GT(model.triangles, 2000U);
  EXPECT_EQ(model.trianglesOfFile, 20'012U);
  const std::vector<Visual>& visuals = model.links.at(0).visuals;
  EXPECT_EQ(std::get<Mesh>(visuals[0].shape), std::get<Mesh>(visuals[1].shape));
  EXPECT_THAT(std::get<Mesh>(visuals[2].shape)->triangles, SizeIs(12));
  const VisualMesh& large = *std::get<Mesh>(visuals[0].shape);
  // Cells have an edge of some 1/35: no corner is farther from the sheet, no triangle is twice
  // there, and together they cover the square.
  double area = 0.0;
  std::set<std::array<int, 3>> once;
  for (const Eigen::Vector3i& triangle : large.triangles) {
    std::array<int, 3> corners{triangle[0], triangle[1], triangle[2]};
    std::ranges::sort(corners);
    EXPECT_TRUE(once.insert(corners).second);
    const Eigen::Vector3f a = large.vertices[triangle[0]], b = large.vertices[triangle[1]],
                          c = large.vertices[triangle[2]];
    area += 0.5 * std::abs((b - a).head<2>().x() * (c - a).head<2>().y() -
                           (b - a).head<2>().y() * (c - a).head<2>().x());
  }
  EXPECT_NEAR(area, 1.0, 0.15);
  for (const Eigen::Vector3f& vertex : large.vertices)
    EXPECT_NEAR(vertex.z(), 0.1 * std::sin(9.0 * vertex.x()), 0.01);
}

/// All that pages take of a URDF.
std::string described(const VisualModel& model) {
  std::ostringstream text;
  text.precision(17);
  for (const LinkVisuals& link : model.links) {
    text << link.link << ' ' << link.leftOut;
    for (const Visual& visual : link.visuals) {
      text << ' ' << visual.shape.index() << ' '
           << visual.link_from_shape.matrix().reshaped().transpose();
      if (visual.colour)
        text << ' ' << visual.colour->red << ' ' << visual.colour->green << ' '
             << visual.colour->blue << ' ' << visual.colour->alpha;
      if (const Box* box = std::get_if<Box>(&visual.shape)) text << box->halfExtents.transpose();
      if (const Sphere* sphere = std::get_if<Sphere>(&visual.shape)) text << sphere->radius;
      if (const Cylinder* c = std::get_if<Cylinder>(&visual.shape))
        text << c->radius << ' ' << c->halfLength;
      if (const Capsule* c = std::get_if<Capsule>(&visual.shape))
        text << c->radius << ' ' << c->halfLength;
      if (const Mesh* mesh = std::get_if<Mesh>(&visual.shape))
        for (const Eigen::Vector3f& vertex : (*mesh)->vertices) text << ' ' << vertex.transpose();
    }
  }
  return text.str();
}

TEST_F(VisualModelTest, KeysAreWhatTheTableSays) {
  folder_.write("cube.obj", test::kCubeObj);
  folder_.write("other.stl", test::kTriangleStl);
  const std::string good =
      "<robot name='r'><material name='m'><color rgba='1 0 0 1'/></material><link name='a'>"
      "<visual><origin xyz='1 0 0' rpy='0 0 1'/><geometry><box size='1 2 3'/></geometry>"
      "<material name='m'/></visual>"
      "<visual><geometry><sphere radius='1'/></geometry><material name='n'><color rgba='0 1 0 "
      "1'/></material></visual>"
      "<visual><geometry><cylinder radius='3' length='4'/></geometry></visual>"
      "<visual><geometry><capsule radius='5' length='6'/></geometry></visual>"
      "<visual><geometry><mesh filename='cube.obj' scale='1 1 1'/></geometry></visual>"
      "</link></robot>";
  std::vector<test::KeyCase> cases;
  const auto change = [&](const std::string& key, const std::string& old, const std::string& now) {
    std::string text = good;
    EXPECT_NE(text.find(old), std::string::npos) << old;
    cases.push_back({key, good, text.replace(text.find(old), old.size(), now)});
  };
  const std::string shapes = "link/visual/geometry/";
  change("robot/material name", "<material name='m'><c", "<material name='o'><c");
  change("robot/material/color rgba", "'1 0 0 1'", "'1 0 0 0.5'");
  change("robot/material/texture filename", "'1 0 0 1'/>",
         "'1 0 0 1'/><texture filename='x.png'/>");
  change("link/visual", "<visual>", "<visual><geometry/></visual><visual>");
  change("link/visual name", "<visual>", "<visual name='x'>");
  change("link/visual/origin xyz", "xyz='1 0 0'", "xyz='1 0 2'");
  change("link/visual/origin rpy", "rpy='0 0 1'", "rpy='0 1 1'");
  change(shapes + "box size", "'1 2 3'", "'1 2 4'");
  change(shapes + "sphere radius", "sphere radius='1'", "sphere radius='2'");
  change(shapes + "cylinder radius", "radius='3'", "radius='2'");
  change(shapes + "cylinder length", "length='4'", "length='2'");
  change(shapes + "capsule radius", "radius='5'", "radius='2'");
  change(shapes + "capsule length", "length='6'", "length='2'");
  change(shapes + "mesh filename", "cube.obj", "other.stl");
  change(shapes + "mesh scale", "'1 1 1'", "'1 1 -1'");
  change("link/visual/material name", "<material name='m'/>", "<material name='n'/>");
  change("link/visual/material/color rgba", "'0 1 0 1'", "'0 1 1 1'");
  test::walkFormat("URDF on pages (.urdf)", cases,
                   [&](const std::string& text) { return described(read(text)); });
}

}  // namespace
}  // namespace swept
