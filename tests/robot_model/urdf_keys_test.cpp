// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <sstream>
#include <utility>

#include "format_table.hpp"
#include "input_files.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

const Eigen::IOFormat kOneLine(17, Eigen::DontAlignCols, " ", " ");

/// Everything of a robot that answers are made of.
std::string described(const Robot& robot) {
  std::ostringstream text;
  text.precision(17);
  text << robot.name() << '\n';
  for (const Link& link : robot.links()) {
    text << link.name << ' ' << link.parentJoint;
    for (const CollisionGeometry& part : link.collision) {
      const Aabb box = boundingBox(part.shape);
      text << ' ' << part.shape.index() << ' ' << box.lower.transpose() << ' '
           << box.upper.transpose() << ' ' << part.link_from_shape.matrix().format(kOneLine);
    }
    text << '\n';
  }
  for (const Joint& joint : robot.joints()) {
    text << joint.name << ' ' << static_cast<int>(joint.type) << ' ' << joint.parentLink << ' '
         << joint.childLink << ' ' << joint.parent_from_joint.matrix().format(kOneLine) << ' '
         << joint.axis.transpose();
    if (joint.mimic)
      text << ' ' << joint.mimic->master << ' ' << joint.mimic->multiplier << ' '
           << joint.mimic->offset;
    text << '\n';
  }
  for (const Variable& variable : robot.variables())
    text << variable.name << ' ' << variable.lower << ' ' << variable.upper << ' '
         << variable.velocity << '\n';
  return text.str();
}

/// A good robot in which one piece of text takes the place of another.
class UrdfText {
 public:
  std::string with(const std::string& old, const std::string& now) const {
    std::string text = kText;
    const std::size_t at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), now);
  }
  test::KeyCase changed(const std::string& key, const std::string& old,
                        const std::string& now) const {
    return {key, kText, with(old, now)};
  }
  /// Behind `place`.
  test::KeyCase added(const std::string& key, const std::string& place,
                      const std::string& more) const {
    return changed(key, place, place + more);
  }

 private:
  static constexpr const char* kText = R"(<robot name="r">
<link name="a"><collision><origin xyz="1 0 0" rpy="0 0 1"/><geometry><box size="1 2 3"/></geometry></collision></link>
<link name="b">
  <collision><geometry><sphere radius="1"/></geometry></collision>
  <collision><geometry><cylinder radius="1" length="2"/></geometry></collision>
  <collision><geometry><capsule radius="3" length="4"/></geometry></collision>
</link>
<link name="c"><collision><geometry><mesh filename="cube.obj" scale="1 1 1"/></geometry></collision></link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1" rpy="0 0 0"/>
  <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="k" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/><limit lower="-3" upper="3"/>
  <mimic joint="j" multiplier="1" offset="0"/></joint>
</robot>)";
};

std::vector<test::KeyCase> ofRobot(const UrdfText& urdf) {
  const std::string robot = "<robot name=\"r\">";
  std::vector<test::KeyCase> cases{
      urdf.changed("robot name", robot, "<robot name=\"other\">"),
      urdf.changed("robot version", robot, "<robot name=\"r\" version=\"1.0\">"),
      urdf.added("robot/drake:plugin", robot, "<drake:plugin><geometry/></drake:plugin>"),
      urdf.added("robot/xacro:include", robot, "<xacro:include filename='x'/>"),
      urdf.added("robot/jiont", robot, "<jiont name='x'/>"),
      urdf.added("robot/links", robot, "<links/>")};
  for (const std::string key :
       {"material", "transmission", "gazebo", "sensor", "ros2_control", "mujoco", "plugin"})
    cases.push_back(
        urdf.added("robot/" + key, robot, "<" + key + " name='x'><collision/></" + key + ">"));
  return cases;
}

std::vector<test::KeyCase> ofLinks(const UrdfText& urdf) {
  const std::string link = "<link name=\"b\">";
  std::vector<test::KeyCase> cases{
      urdf.added("link", "<robot name=\"r\">",
                 "<link name='d'/><joint name='l' type='fixed'><parent link='a'/><child "
                 "link='d'/></joint>"),
      {"link name", urdf.with("scale=\"1 1 1\"", ""), urdf.with("scale=\"1 1 1\"", "")},
      urdf.changed("link type", link, "<link name=\"b\" type=\"laser\">"),
      urdf.added("link/visual", link, "<visual><geometry><box size='1'/></geometry></visual>"),
      urdf.added("link/colision", link,
                 "<colision><geometry><box size='1 1 1'/></geometry></colision>")};
  std::string& renamed = cases[1].with;
  for (std::size_t at = 0; (at = renamed.find("\"c\"", at)) != std::string::npos;)
    renamed.replace(at, 3, "\"z\"");
  for (const std::string key :
       {"inertial", "contact", "gravity", "self_collide", "sensor", "origin"})
    cases.push_back(urdf.added("link/" + key, link, "<" + key + " xyz='1 2 3'>1</" + key + ">"));
  cases.push_back(
      urdf.added("link/self_filter", link,
                 "<self_filter><geometry><box size='9 9 9'/></geometry></self_filter>"));
  return cases;
}

std::vector<test::KeyCase> ofCollisions(const UrdfText& urdf) {
  const std::string first = "<link name=\"a\"><collision>", shapes = "link/collision/geometry/";
  std::vector<test::KeyCase> cases{
      urdf.added("link/collision", "<link name=\"b\">",
                 "<collision><geometry><sphere radius='9'/></geometry></collision>"),
      urdf.changed("link/collision name", first, "<link name=\"a\"><collision name='x'>"),
      urdf.changed("link/collision/origin xyz", "xyz=\"1 0 0\" rpy", "xyz=\"1 2 0\" rpy"),
      urdf.changed("link/collision/origin rpy", "rpy=\"0 0 1\"", "rpy=\"0 1 1\""),
      urdf.changed("link/collision/origin quat_xyzw", "rpy=\"0 0 1\"", "quat_xyzw=\"0 0 0 1\""),
      urdf.changed(shapes + "box size", "size=\"1 2 3\"", "size=\"1 2 0\""),
      urdf.changed(shapes + "sphere radius", "sphere radius=\"1\"", "sphere radius=\"0\""),
      urdf.changed(shapes + "cylinder radius", "cylinder radius=\"1\"", "cylinder radius=\"0\""),
      urdf.changed(shapes + "cylinder length", "length=\"2\"", "length=\"0\""),
      urdf.changed(shapes + "capsule radius", "capsule radius=\"3\"", "capsule radius=\"0\""),
      urdf.changed(shapes + "capsule length", "length=\"4\"", "length=\"0\""),
      urdf.changed(shapes + "mesh filename", "cube.obj", "other.obj"),
      urdf.changed(shapes + "mesh scale", "scale=\"1 1 1\"", "scale=\"-1 1 1\""),
      urdf.changed(shapes + "torus", "<sphere radius=\"1\"/>", "<torus radius=\"1\"/>"),
      urdf.changed(shapes + "sphere diameter", "<sphere radius=\"1\"/>",
                   "<sphere radius=\"1\" diameter=\"2\"/>"),
      urdf.added("link/collision/geometri", first, "<geometri/>")};
  for (const std::string key : {"material", "contact_coefficients", "verbose"})
    cases.push_back(urdf.added("link/collision/" + key, first, "<" + key + " name='x'/>"));
  return cases;
}

std::vector<test::KeyCase> ofJoints(const UrdfText& urdf) {
  const std::string joint = "<joint name=\"j\" type=\"revolute\">", limit = "<limit lower=\"-1\"";
  std::vector<test::KeyCase> cases{
      urdf.changed("joint", "</robot>",
                   "<link name='d'/><joint name='l' type='fixed'><parent link='a'/><child "
                   "link='d'/></joint></robot>"),
      {"joint name", urdf.with("<mimic joint=\"j\" multiplier=\"1\" offset=\"0\"/>", ""), ""},
      urdf.changed("joint type", "type=\"prismatic\"", "type=\"revolute\""),
      urdf.changed("joint/parent link", "<parent link=\"b\"/>", "<parent link=\"a\"/>"),
      {"joint/child link", urdf.with("<child link=\"c\"/>", "<child link=\"c\"/>"), ""},
      urdf.changed("joint/origin xyz", "xyz=\"0 0 1\" rpy", "xyz=\"0 0 2\" rpy"),
      urdf.changed("joint/origin rpy", "rpy=\"0 0 0\"", "rpy=\"0 0 2\""),
      urdf.changed("joint/origin quat_xyzw", "rpy=\"0 0 0\"", "quat_xyzw=\"0 0 0 1\""),
      urdf.changed("joint/axis xyz", "axis xyz=\"0 0 1\"", "axis xyz=\"0 1 0\""),
      urdf.changed("joint/axis rpy", "axis xyz=\"0 0 1\"", "axis xyz=\"0 0 1\" rpy=\"0 0 0\""),
      urdf.changed("joint/limit lower", "lower=\"-1\"", "lower=\"-2\""),
      urdf.changed("joint/limit upper", "upper=\"1\"", "upper=\"2\""),
      urdf.changed("joint/limit min", limit, limit + " min=\"-2\""),
      urdf.added("joint/limits", joint, "<limits lower='0' upper='1'/>"),
      {"joint/mimic joint", urdf.with("<mimic joint=\"j\" multiplier=\"1\" offset=\"0\"/>", ""),
       urdf.with("", "")},
      urdf.changed("joint/mimic multiplier", "multiplier=\"1\"", "multiplier=\"2\""),
      urdf.changed("joint/mimic offset", "offset=\"0\"", "offset=\"1\"")};
  cases[1].with = cases[1].without;
  cases[1].with.replace(cases[1].with.find("name=\"k\""), 8, "name=\"m\"");
  // The two children change places.
  std::string& swapped = cases[4].with = cases[4].without;
  swapped.replace(swapped.find("<child link=\"b\"/>"), 17, "<child link=\"c\"/>");
  swapped.replace(swapped.rfind("<parent link=\"b\"/><child link=\"c\"/>"), 35,
                  "<parent link=\"c\"/><child link=\"b\"/>");
  for (const std::string key : {"acceleration", "deceleration", "jerk", "damping", "friction",
                                "command_effort", "current", "gear_velocity"})
    cases.push_back(urdf.changed("joint/limit " + key, limit, limit + " " + key + "=\"5\""));
  cases.push_back(urdf.changed("joint/limit effort", "effort=\"1\"", "effort=\"7\""));
  cases.push_back(urdf.changed("joint/limit velocity", "velocity=\"1\"", "velocity=\"7\""));
  for (const std::string key :
       {"dynamics", "calibration", "safety_controller", "hardwareInterface"})
    cases.push_back(urdf.added("joint/" + key, joint,
                               "<" + key + " soft_lower_limit='0' soft_upper_limit='0.1'/>"));
  return cases;
}

TEST(UrdfKeys, AreWhatTheTableSays) {
  const test::TemporaryFolder folder;
  folder.write("cube.obj", test::kCubeObj);
  folder.write("other.obj",
               "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const std::string name = (folder.path() / "r.urdf").string();
  const UrdfText urdf;
  std::vector<test::KeyCase> cases;
  for (auto* part : {ofRobot, ofLinks, ofCollisions, ofJoints})
    for (test::KeyCase& one : part(urdf)) cases.push_back(std::move(one));
  std::map<std::string, std::string> known;  // most cases change the same text
  test::walkFormat("URDF (.urdf)", cases, [&](const std::string& text) {
    if (!known.contains(text)) known.emplace(text, described(*Robot::parse(text, name)));
    return known.at(text);
  });
}

}  // namespace
}  // namespace swept
