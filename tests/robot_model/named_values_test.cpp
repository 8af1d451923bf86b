// SPDX-License-Identifier: BSD-3-Clause
// Configurations by the names of joints: in the group's order, whole, and of nothing else.
#include "swept/robot_model/named_values.hpp"

#include <gtest/gtest.h>

#include "message_of.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/named_states.hpp"

namespace swept {
namespace {

using test::messageOf;

std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                  const std::string& child, const std::string& more = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent +
         "'/><child link='" + child +
         "'/><axis xyz='0 0 1'/><limit lower='-1' upper='2' effort='1' velocity='1'/>" + more +
         "</joint>";
}

class NamedValuesOfAnArm : public testing::Test {
 protected:
  static std::shared_ptr<const Robot> arm() {
    std::string urdf = "<robot name='arm'>";
    for (const char* link : {"floor", "base", "column", "upper", "lower", "jaw", "thumb", "tool"})
      urdf += std::string("<link name='") + link + "'/>";
    urdf +=
        joint("drive", "planar", "floor", "base") + joint("lift", "prismatic", "base", "column") +
        joint("shoulder", "revolute", "column", "upper") +
        joint("elbow", "revolute", "upper", "lower") + joint("grip", "revolute", "lower", "jaw") +
        joint("thumb_grip", "revolute", "lower", "thumb", "<mimic joint='grip'/>") +
        joint("mount", "fixed", "lower", "tool") + "</robot>";
    return Robot::parse(urdf, "arm.urdf",
                        "<robot name='arm'><group name='arm'><joint name='elbow'/>"
                        "<joint name='shoulder'/><joint name='grip'/></group>"
                        "<group name='rover'><joint name='drive'/></group>"
                        "<group_state name='up' group='arm'><joint name='shoulder' value='0.5'/>"
                        "<joint name='elbow' value='0.25'/><joint name='grip' value='1'/>"
                        "</group_state></robot>",
                        "arm.srdf");
  }
  std::shared_ptr<const Robot> robot_ = arm();
  const Group& group_ = *robot_->findGroup("arm");
};

TEST_F(NamedValuesOfAnArm, HaveTheGroupsOrder) {
  const auto q =
      configurationOf(*robot_, group_, {{"grip", 0.3}, {"elbow", 0.2}, {"shoulder", 0.1}});
  ASSERT_EQ(q.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string& name = robot_->variables()[group_.variables[i]].name;
    EXPECT_EQ(q[i], name == "shoulder" ? 0.1 : name == "elbow" ? 0.2 : 0.3) << name;
  }
}

TEST_F(NamedValuesOfAnArm, ThatAreNotGivenStay) {
  const auto up = namedConfiguration(*robot_, group_, "up");
  const auto bent = configurationOf(*robot_, group_, {{"elbow", -0.5}}, up);
  EXPECT_EQ(namedValues(*robot_, group_, bent),
            (NamedValues{{"shoulder", 0.5}, {"elbow", -0.5}, {"grip", 1.0}}));
  EXPECT_EQ(configurationOf(*robot_, group_, {}, up), up);
}

TEST_F(NamedValuesOfAnArm, ComeBack) {
  const std::vector<double> q{0.7, -0.8, 0.9};
  EXPECT_EQ(configurationOf(*robot_, group_, namedValues(*robot_, group_, q)), q);
  const Group& rover = *robot_->findGroup("rover");
  const NamedValues there{{"drive/x", 1.0}, {"drive/y", 2.0}, {"drive/theta", 3.0}};
  EXPECT_EQ(namedValues(*robot_, rover, {1.0, 2.0, 3.0}), there);
  EXPECT_EQ(configurationOf(*robot_, rover, there), (std::vector<double>{1.0, 2.0, 3.0}));
}

TEST_F(NamedValuesOfAnArm, OfAllJointsAreAReference) {
  const Eigen::VectorXd whole = wholeStateOf(*robot_, {{"lift", 0.4}, {"drive/x", 2.0}});
  ASSERT_EQ(whole.size(), robot_->defaultState().size());
  for (int i = 0; i < whole.size(); ++i) {
    const std::string& name = robot_->variables()[i].name;
    EXPECT_EQ(whole[i], name == "lift" ? 0.4 : name == "drive/x" ? 2.0 : robot_->defaultState()[i]);
  }
  const CheckerOptions options{.reference = whole};
  EXPECT_EQ(Checker(robot_, "arm", std::make_shared<World>(), options).options().reference, whole);
}

TEST_F(NamedValuesOfAnArm, NamesThatAreNoneAreRefused) {
  const auto message = [&](const NamedValues& values) {
    const std::string text = messageOf([&] {
      (void)configurationOf(*robot_, group_, values, {0, 0, 0});
    });
    EXPECT_EQ(messageOf([&] { (void)configurationOf(*robot_, group_, values); }), text);
    return text;
  };
  EXPECT_EQ(message({{"elbwo", 0}}), "robot `arm` has no joint `elbwo`; did you mean 'elbow'?");
  EXPECT_EQ(message({{"something_else", 0}}), "robot `arm` has no joint `something_else`");
  EXPECT_EQ(message({{"lift", 0}}),
            "joint `lift` is not in group `arm`, which has `shoulder`, `elbow`, `grip`");
  EXPECT_EQ(message({{"thumb_grip", 0}}),
            "joint `thumb_grip` has no value of its own: it follows `grip`");
  EXPECT_EQ(message({{"mount", 0}}), "joint `mount` has no value: it is fixed");
  EXPECT_EQ(message({{"drive", 0}}),
            "joint `drive` has 3 values, each by its name: `drive/x`, `drive/y`, `drive/theta`");
  EXPECT_EQ(messageOf([&] {
              (void)wholeStateOf(*robot_, {{"lifd", 0}});
            }),
            "robot `arm` has no joint `lifd`; did you mean 'lift'?");
}

TEST_F(NamedValuesOfAnArm, ValuesThatAreMissingAreNamed) {
  EXPECT_EQ(messageOf([&] {
              (void)configurationOf(*robot_, group_, {{"elbow", 0}});
            }),
            "group `arm`: no value for `shoulder`, `grip`");
  const std::string wrong = "a configuration of group `arm` has 3 values, not 2";
  EXPECT_EQ(messageOf([&] { (void)configurationOf(*robot_, group_, {}, {0, 0}); }), wrong);
  EXPECT_EQ(messageOf([&] { (void)namedValues(*robot_, group_, {0, 0}); }), wrong);
}

}  // namespace
}  // namespace swept
