// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <locale>
#include <numbers>
#include <sstream>
#include <thread>

#include "input_files.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Children before parents, on purpose.
const char* const kAllTypes = R"(<robot name="zoo">
  <joint name="fl" type="floating"><parent link="c"/><child link="fl_link"/><axis xyz="0 0 0"/></joint>
  <joint name="pl" type="planar"><parent link="c"/><child link="pl_link"/><axis xyz="0 3 0"/></joint>
  <joint name="pr" type="prismatic"><parent link="b"/><child link="c"/>
    <axis xyz="1 1 0"/><limit lower="0.1" upper="0.5"/></joint>
  <joint name="co" type="continuous"><parent link="a"/><child link="b"/><limit effort="1" velocity="1"/></joint>
  <joint name="fi" type="fixed"><parent link="a"/><child link="fi_link"/><axis xyz="0 0 0"/></joint>
  <joint name="re" type="revolute"><parent link="root"/><child link="a"/>
    <origin xyz="1 2 3" rpy="0.3 -0.5 0.7"/><axis xyz="0 0 -2"/>
    <limit lower="-1" upper="+2" effort="10" velocity="1"/></joint>
  <link name="fl_link"/><link name="pl_link"/><link name="c"/><link name="b"/>
  <link name="fi_link"/><link name="a"/><link name="root"/>
</robot>)";

std::vector<std::string> names(const auto& entries) {
  std::vector<std::string> result;
  for (const auto& entry : entries) result.push_back(entry.name);
  return result;
}

TEST(Urdf, StoresParentsFirstAndSiblingsInFileOrder) {
  const auto robot = Robot::parse(kAllTypes, "zoo.urdf");
  EXPECT_EQ(robot->name(), "zoo");
  EXPECT_THAT(names(robot->links()),
              ElementsAre("root", "a", "b", "c", "fl_link", "pl_link", "fi_link"));
  EXPECT_THAT(names(robot->joints()), ElementsAre("re", "co", "pr", "fl", "pl", "fi"));
  EXPECT_EQ(robot->links()[0].parentJoint, -1);
  for (std::size_t j = 0; j < robot->joints().size(); ++j) {
    const Joint& joint = robot->joints()[j];
    EXPECT_LT(joint.parentLink, joint.childLink);
    EXPECT_EQ(robot->links()[joint.childLink].parentJoint, static_cast<int>(j));
  }
}

TEST(Urdf, GivesEachJointItsVariables) {
  const auto robot = Robot::parse(kAllTypes, "zoo.urdf");
  struct Expected {
    const char* name;
    double lower, upper;
    bool cyclic;
  };
  const std::vector<Expected> expected{{"re", -1, 2, false},
                                       {"co", -kPi, kPi, true},
                                       {"pr", 0.1, 0.5, false},
                                       {"fl/trans_x", -kInfinity, kInfinity, false},
                                       {"fl/trans_y", -kInfinity, kInfinity, false},
                                       {"fl/trans_z", -kInfinity, kInfinity, false},
                                       {"fl/rot_x", -1, 1, false},
                                       {"fl/rot_y", -1, 1, false},
                                       {"fl/rot_z", -1, 1, false},
                                       {"fl/rot_w", -1, 1, false},
                                       {"pl/x", -kInfinity, kInfinity, false},
                                       {"pl/y", -kInfinity, kInfinity, false},
                                       {"pl/theta", -kPi, kPi, true}};
  ASSERT_EQ(robot->variables().size(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v) {
    const Variable& variable = robot->variables()[v];
    EXPECT_EQ(variable.name, expected[v].name);
    EXPECT_EQ(variable.lower, expected[v].lower) << variable.name;
    EXPECT_EQ(variable.upper, expected[v].upper) << variable.name;
    EXPECT_EQ(variable.cyclic, expected[v].cyclic) << variable.name;
    const Joint& joint = robot->joints()[variable.joint];
    EXPECT_EQ(variable.name.substr(0, 2), joint.name);
    EXPECT_LE(joint.firstVariable, static_cast<int>(v));
  }
  EXPECT_EQ(robot->joints()[*robot->findJoint("fi")].firstVariable, -1);
  EXPECT_EQ(robot->findVariable("pl/theta"), 12);
  EXPECT_EQ(robot->findVariable("pl"), std::nullopt);
}

TEST(Urdf, DefaultStateIsZeroOrMiddleOrIdentity) {
  const auto robot = Robot::parse(kAllTypes, "zoo.urdf");
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(13);
  expected[2] = 0.3;  // [0.1, 0.5] leaves out zero
  expected[9] = 1.0;  // quaternion w
  EXPECT_TRUE(robot->defaultState().isApprox(expected, 1e-15)) << robot->defaultState();
}

TEST(Urdf, OriginIsFixedAxisRollPitchYaw) {
  const auto robot = Robot::parse(kAllTypes, "zoo.urdf");
  const Joint& joint = robot->joints()[*robot->findJoint("re")];
  // R = Rz(0.7) Ry(-0.5) Rx(0.3), written out.
  const double cr = std::cos(0.3), sr = std::sin(0.3), cp = std::cos(-0.5), sp = std::sin(-0.5),
               cy = std::cos(0.7), sy = std::sin(0.7);
  Eigen::Matrix3d rotation;
  rotation << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,          //
      -sp, cp * sr, cp * cr;
  EXPECT_LT((joint.parent_from_joint.linear() - rotation).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(joint.parent_from_joint.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(Urdf, AxesAreUnitAndDefaultToX) {
  const auto robot = Robot::parse(kAllTypes, "zoo.urdf");
  const auto axis = [&](const char* name) { return robot->joints()[*robot->findJoint(name)].axis; };
  EXPECT_EQ(axis("re"), Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(axis("co"), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(axis("pl"), Eigen::Vector3d(0, 1, 0));
  EXPECT_LT((axis("pr") - Eigen::Vector3d(std::sqrt(0.5), std::sqrt(0.5), 0)).norm(), 1e-15);
}

/// Squares of components would overflow, or vanish, long before the components do.
TEST(Urdf, AxesAreUnitAtEveryScale) {
  for (int decade = -322; decade <= 307; ++decade) {
    const auto axisOf = [&](const std::string& x, const std::string& y, const std::string& z) {
      const std::string scale = "e" + std::to_string(decade);
      const auto robot = Robot::parse(
          "<robot name='s'><link name='a'/><link name='b'/><joint name='j' type='continuous'>"
          "<parent link='a'/><child link='b'/><axis xyz='" +
              x + scale + " " + y + scale + " " + z + scale + "'/></joint></robot>",
          "s.urdf");
      return robot->joints().at(0).axis;
    };
    EXPECT_EQ(axisOf("0", "0", "-3"), Eigen::Vector3d(0, 0, -1)) << decade;
    const Eigen::Vector3d axis = axisOf("1", "-2", "2");
    EXPECT_NEAR(axis.norm(), 1.0, 1e-15) << decade;
    // Denormal components have few digits themselves.
    const double error = decade > -305 ? 1e-15 : std::pow(10.0, -decade) * 5e-324;
    EXPECT_LE((axis - Eigen::Vector3d(1, -2, 2) / 3.0).norm(), error) << decade;
  }
}

std::string chain(const std::string& limitOfD) {
  return "<robot name='m'><link name='l0'/><link name='l1'/><link name='l2'/><link name='l3'/>"
         "<link name='l4'/>\n"
         "<joint name='d' type='prismatic'><parent link='l0'/><child link='l1'/>" +
         limitOfD +
         "\n<mimic joint='c' multiplier='0.5' offset='0.25'/></joint>\n"
         "<joint name='c' type='continuous'><parent link='l1'/><child link='l2'/>"
         "<mimic joint='b' multiplier='-2' offset='1'/></joint>\n"
         "<joint name='b' type='continuous'><parent link='l2'/><child link='l3'/>"
         "<mimic joint='a' offset='0.125'/></joint>\n"
         "<joint name='a' type='revolute'><parent link='l3'/><child link='l4'/>"
         "<limit lower='-1' upper='1'/></joint>\n</robot>";
}

TEST(Urdf, MimicChainsEndAtTheirMaster) {
  const auto robot = Robot::parse(chain("<limit lower='-1' upper='2'/>"), "m.urdf");
  const int master = *robot->findJoint("a");
  ASSERT_EQ(robot->variables().size(), 1u);
  EXPECT_EQ(robot->variables()[0].joint, master);
  const double q = 0.75;
  const double b = q + 0.125, c = -2 * b + 1, d = 0.5 * c + 0.25;
  for (const auto& [name, value] : {std::pair{"b", b}, {"c", c}, {"d", d}}) {
    const Joint& joint = robot->joints()[*robot->findJoint(name)];
    ASSERT_TRUE(joint.mimic) << name;
    EXPECT_EQ(joint.firstVariable, -1);
    EXPECT_EQ(joint.mimic->master, master);
    EXPECT_DOUBLE_EQ(joint.mimic->multiplier * q + joint.mimic->offset, value) << name;
  }
}

TEST(Urdf, WarnsWhenAMimicPassesItsLimits) {
  test::Warnings fits, passes;
  Robot::parse(chain("<limit lower='-1' upper='2'/>"), "m.urdf", {}, {}, fits.options());
  EXPECT_THAT(fits.lines, IsEmpty());
  Robot::parse(chain("<limit lower='-1' upper='1'/>"), "m.urdf", {}, {}, passes.options());
  EXPECT_THAT(
      passes.lines,
      ElementsAre("m.urdf:3: warning: joint 'd' mimics 'a' and takes values in [-0.375, 1.625], "
                  "beyond its limits [-1, 1]"));
}

TEST(Urdf, ReadsEveryPrimitiveInFileOrder) {
  const auto robot = Robot::parse(R"(<robot name="p"><link name="a">
    <collision><origin xyz="0 0 1"/><geometry><capsule radius="0.1" length="0.6"/></geometry></collision>
    <collision><geometry><box size="1 2	3"/></geometry></collision>
    <collision><geometry><sphere radius="1e-1"/></geometry></collision>
    <collision><geometry><cylinder radius=".5" length="2"/></geometry></collision>
    </link></robot>)",
                                  "p.urdf");
  const auto& collision = robot->links()[0].collision;
  ASSERT_EQ(collision.size(), 4u);
  EXPECT_EQ(std::get<Capsule>(collision[0].shape).radius, 0.1);
  EXPECT_EQ(std::get<Capsule>(collision[0].shape).halfLength, 0.3);
  EXPECT_EQ(collision[0].link_from_shape.translation().z(), 1.0);
  EXPECT_EQ(std::get<Box>(collision[1].shape).halfExtents, Eigen::Vector3d(0.5, 1, 1.5));
  EXPECT_EQ(std::get<Sphere>(collision[2].shape).radius, 0.1);
  EXPECT_EQ(std::get<Cylinder>(collision[3].shape).radius, 0.5);
  EXPECT_EQ(std::get<Cylinder>(collision[3].shape).halfLength, 1.0);
  EXPECT_EQ(collision[3].source, "cylinder");
}

TEST(Urdf, LimitsAreThoseOfTheLimitElement) {
  test::Warnings warnings;
  const auto robot = Robot::parse(
      "<robot name='s'><link name='a'/><link name='b'/><joint name='j' type='revolute'>"
      "<parent link='a'/><child link='b'/><limit lower='-1' upper='2'/>"
      "<safety_controller soft_lower_limit='-0.5' soft_upper_limit='1.5' k_velocity='10'/></joint>"
      "</robot>",
      "s.urdf", {}, {}, warnings.options());
  EXPECT_EQ(robot->variables().at(0).lower, -1.0);
  EXPECT_EQ(robot->variables()[0].upper, 2.0);
  EXPECT_THAT(warnings.lines, IsEmpty());
}

TEST(Urdf, IgnoresWhatIsNotCollisionButNamesWhatItDoesNotKnow) {
  test::Warnings warnings;
  ::testing::internal::CaptureStderr();
  Robot::parse(R"(<robot name="v"><material name="m"/><material name="m"/>
  <link name="a">
    <visual><geometry><mesh filename="package://nowhere/x.dae"/></geometry></visual>
    <visual/>
    <inertial><mass value="heavy"/></inertial>
    <laser_spot/><drake:thing/>
  </link>
  <link name="b"/>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/>
    <origin drake:note="1"/><mimic joint="nobody"/></joint>
  <gazebo><joint name="j"/></gazebo></robot>)",
               "v.urdf", {}, {}, warnings.options());
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(
      warnings.lines,
      ElementsAre("v.urdf:6: warning: link 'a': unknown element <laser_spot> is ignored",
                  "v.urdf:10: warning: joint 'j' is fixed: its <mimic> is ignored",
                  "v.urdf:2: warning: link 'a' has a <visual> and no <collision>: nothing is "
                  "checked against it"));
}

/// The value of a slide that mimics `target`.
std::string withMimicOf(const std::string& target) {
  return "<robot name='m'><link name='a'/><link name='b'/><link name='c'/>\n"
         "<joint name='f' type='fixed'><parent link='a'/><child link='b'/></joint>\n"
         "<joint name='s' type='prismatic'><parent link='b'/><child link='c'/>"
         "<limit lower='-1' upper='2'/><mimic joint='" +
         target + "' multiplier='3'/></joint></robot>";
}

TEST(Urdf, AMimicOfNothingIsAJointOfItsOwn) {
  for (const auto& [target, why] : {std::pair{"gone", "does not exist"},
                                    {"f", "is no revolute, continuous or prismatic joint"}}) {
    test::Warnings warnings;
    const auto robot = Robot::parse(withMimicOf(target), "m.urdf", {}, {}, warnings.options());
    ASSERT_EQ(robot->variables().size(), 1U);
    EXPECT_EQ(robot->variables()[0].name, "s");
    EXPECT_EQ(robot->variables()[0].upper, 2.0);
    EXPECT_FALSE(robot->joints()[1].mimic);
    EXPECT_THAT(warnings.lines,
                ElementsAre(std::string("m.urdf:3: warning: joint 's' mimics '") + target +
                            "', which " + why + ": 's' is read as a joint of its own"));
  }
}

TEST(Urdf, APlanarJointWithoutAxisMovesNormalToXWithAWarning) {
  test::Warnings warnings;
  const auto robot = Robot::parse(
      "<robot name='p'><link name='a'/><link name='b'/>\n<joint name='j' type='planar'>"
      "<parent link='a'/><child link='b'/></joint></robot>",
      "p.urdf", {}, {}, warnings.options());
  EXPECT_EQ(robot->joints()[0].axis, Eigen::Vector3d(1, 0, 0));
  EXPECT_THAT(warnings.lines,
              ElementsAre("p.urdf:2: warning: joint 'j' is planar and has no <axis>: it moves in "
                          "the plane normal to the x axis, which URDF takes then"));
}

TEST(Urdf, AnXmlDeclarationComesFirst) {
  EXPECT_EQ(test::inputError([] {
              (void)Robot::parse("<!-- first -->\n<?xml version='1.0'?>\n<robot name='r'/>",
                                 "r.urdf");
            }),
            "r.urdf:2: error: malformed XML: <?xml ...?> must be the first thing in the file, "
            "before comments and elements");
}

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

TEST(Urdf, ReadsNumbersTheSameInEveryLocale) {
  const std::locale before = std::locale::global({std::locale::classic(), new DecimalComma});
  std::ostringstream shown;
  shown << 0.5;
  const auto robot = Robot::parse(kAllTypes, "zoo.urdf");
  const std::string refused = test::inputError([] {
    Robot::parse(
        "<robot name='r'><link name='a'><collision><geometry><sphere radius='0,5'/>"
        "</geometry></collision></link></robot>",
        "r.urdf");
  });
  std::locale::global(before);
  ASSERT_EQ(shown.str(), "0,5");
  EXPECT_EQ(robot->variables()[2].lower, 0.1);
  EXPECT_EQ(robot->joints()[0].parent_from_joint.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(refused, HasSubstr("must be a finite number"));
}

TEST(Urdf, ThreadsMayLoadAtTheSameTime) {
  std::vector<std::string> errors(4);
  std::vector<std::thread> threads;
  for (std::string& error : errors) {
    threads.emplace_back([&error] {
      for (int i = 0; i < 50; ++i) {
        Robot::parse(kAllTypes, "zoo.urdf");
        error = test::inputError([] {
          Robot::parse("<robot name='r' version='9.0'><link name='a'/></robot>", "r.urdf");
        });
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(errors, ::testing::Each(HasSubstr("urdfdom refuses the robot: Invalid 'version'")));
}

TEST(Urdf, ALongChainIsNoProblem) {
  std::string text = "<robot name='long'><link name='l0'/>";
  for (int i = 1; i <= 3000; ++i) {
    const std::string n = std::to_string(i), before = std::to_string(i - 1);
    text += "<link name='l" + n + "'/><joint name='j" + n + "' type='continuous'><parent link='l" +
            before + "'/><child link='l" + n + "'/></joint>";
  }
  EXPECT_EQ(Robot::parse(text + "</robot>", "long.urdf")->variables().size(), 3000u);
}

}  // namespace
}  // namespace swept
