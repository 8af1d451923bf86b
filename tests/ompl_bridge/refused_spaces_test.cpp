// SPDX-License-Identifier: BSD-3-Clause
// Spaces whose states or motions are not those that would be certified.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>
#include <ompl/base/spaces/constraint/AtlasStateSpace.h>
#include <ompl/base/spaces/constraint/ProjectedStateSpace.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contract.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using State = ob::ScopedState<>;
using testing::HasSubstr;

/// |q| = 1/2 for the gantry.
class OnABall : public ob::Constraint {
 public:
  OnABall() : Constraint(3, 1) {}
  void function(const Eigen::Ref<const Eigen::VectorXd>& x,
                Eigen::Ref<Eigen::VectorXd> out) const override {
    out[0] = x.norm() - 0.5;
  }
};

/// Laid out as a gantry's space, and moves along curves.
class CurvedSpace : public ob::RealVectorStateSpace {
 public:
  CurvedSpace() : RealVectorStateSpace(3) { setBounds(-1.0, 1.0); }
  void interpolate(const ob::State* from, const ob::State* to, double t,
                   ob::State* state) const override {
    RealVectorStateSpace::interpolate(from, to, t * t, state);
  }
};

template <typename Space, typename... Arguments>
std::shared_ptr<Space> called(const std::string& name, Arguments&&... arguments) {
  auto space = std::make_shared<Space>(std::forward<Arguments>(arguments)...);
  static_cast<ob::StateSpace&>(*space).setName(name);
  return space;
}

template <typename... Parts>
ob::StateSpacePtr compoundOf(const std::string& name, const Parts&... parts) {
  auto space = called<ob::CompoundStateSpace>(name);
  (space->addSubspace(parts, 1.0), ...);
  return space;
}

/// What the constructors say; empty for one that takes the space.
std::vector<std::string> messages(const ob::StateSpacePtr& space,
                                  const std::shared_ptr<const Checker>& checker) {
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  std::vector<std::string> all;
  const auto attempt = [&](const auto& make) {
    all.emplace_back();
    try {
      make();
    } catch (const std::invalid_argument& error) {
      all.back() = error.what();
    }
  };
  attempt([&] { const ValidityChecker validity(si, checker); });
  attempt([&] { const CertifiedMotionValidator motions(si, checker); });
  attempt([&] { const CertifiedClearanceObjective objective(si, checker); });
  return all;
}

std::shared_ptr<const Checker> checkerIn(const std::string& robot, const std::string& group) {
  return std::make_shared<const Checker>(robotCalled(robot), group,
                                         std::make_shared<const World>());
}

void expectRefused(const ob::StateSpacePtr& space, const std::shared_ptr<const Checker>& checker) {
  // Names are not virtual: that of a wrapper is its own, not that of the space within.
  const std::string name = static_cast<const ob::StateSpace&>(*space).getName();
  for (const std::string& message : messages(space, checker)) {
    EXPECT_THAT(message,
                HasSubstr("state space `" + name + "` is not built as makeStateSpace does"));
    EXPECT_THAT(message, HasSubstr("group `" + checker->group().name + "`"));
  }
}

TEST(Spaces, OfAnotherLayoutAreRefused) {
  const auto arm = checkerIn("gantry", "all");
  for (const unsigned int dimension : {1u, 2u, 4u, 7u})
    expectRefused(called<ob::RealVectorStateSpace>("flat", dimension), arm);
  expectRefused(called<ob::SE2StateSpace>("plane"), arm);
  expectRefused(called<ob::SE3StateSpace>("free"), arm);
  expectRefused(called<ob::SO2StateSpace>("turn"), arm);
  expectRefused(compoundOf("parts", called<ob::RealVectorStateSpace>("flat", 3u)), arm);
  for (const char* name : {"limited", "turn_only", "all"})
    expectRefused(makeStateSpace(*everyJoint(), *everyJoint()->findGroup(name)),
                  name == std::string("limited") ? checkerIn("rook7", "arm") : arm);
  const auto body = checkerIn("drifter", "body");
  expectRefused(compoundOf("plane", called<ob::SE2StateSpace>("se2")), body);
  expectRefused(called<ob::SE3StateSpace>("bare"), body);
  const auto base = checkerIn("rook6_cart", "base");
  expectRefused(compoundOf("free", called<ob::SE3StateSpace>("se3")), base);
  const auto swapped = [](const auto& first, const auto& second) {
    return compoundOf("swapped", first, second);
  };
  expectRefused(swapped(called<ob::SE2StateSpace>("se2"), called<ob::SO2StateSpace>("so2")), base);
}

/// A left and a right arm have spaces of the same layout.
TEST(Spaces, OfTheOtherArmAreRefused) {
  std::string urdf = "<robot name='r'><link name='base'/>";
  for (const std::string side : {"left", "right"})
    urdf += "<link name='" + side + "_hand'><collision><origin xyz='0.5 0 0'/><geometry>" +
            "<sphere radius='0.1'/></geometry></collision></link><joint name='" + side +
            "' type='revolute'><parent link='base'/><child link='" + side +
            "_hand'/><axis xyz='0 0 1'/><limit lower='-2' upper='2' effort='1' velocity='1'/>" +
            "</joint>";
  const auto robot = Robot::parse(
      urdf + "</robot>", "r.urdf",
      "<robot name='r'><group name='left'><joint name='left'/></group><group name='port'>"
      "<joint name='left'/></group><group name='right'><joint name='right'/></group></robot>",
      "r.srdf");
  const auto checker = [&](const char* group) {
    return std::make_shared<const Checker>(robot, group, std::make_shared<const World>());
  };
  const auto space = makeStateSpace(*robot, *robot->findGroup("left"));
  for (const std::string& message : messages(space, checker("right")))
    EXPECT_THAT(message, HasSubstr("for group `right`: it is of another group's variables"));
  for (const std::string& message : messages(space, checker("port"))) EXPECT_EQ(message, "");
  const auto setup = makeSimpleSetup(checker("left"));
  EXPECT_THROW(setStartAndGoal(*setup, *checker("right"), std::vector<double>{0.0},
                               std::vector<double>{1.0}),
               std::invalid_argument);
}

/// Built by hand as makeStateSpace does, they are taken.
TEST(Spaces, OfTheSameLayoutAreTaken) {
  const std::vector<std::string> taken(3);
  EXPECT_EQ(messages(called<ob::RealVectorStateSpace>("flat", 3u), checkerIn("gantry", "all")),
            taken);
  EXPECT_EQ(messages(compoundOf("plane", called<ob::SE2StateSpace>("se2")),
                     checkerIn("rook6_cart", "base")),
            taken);
  EXPECT_EQ(
      messages(compoundOf("free", called<ob::SE3StateSpace>("se3")), checkerIn("drifter", "body")),
      taken);
}

/// Their motions are other ones than those that are certified.
TEST(Spaces, WithMotionsOfTheirOwnAreRefused) {
  const auto base = checkerIn("rook6_cart", "base");
  expectRefused(called<ob::DubinsStateSpace>("dubins"), base);
  expectRefused(called<ob::ReedsSheppStateSpace>("shepp"), base);
  expectRefused(compoundOf("driving", called<ob::DubinsStateSpace>("dubins")), base);
  expectRefused(compoundOf("parking", called<ob::ReedsSheppStateSpace>("shepp")), base);
  expectRefused(called<CurvedSpace>("curved"), checkerIn("gantry", "all"));
}

/// Their states hold those of the space within, and are no such states themselves.
TEST(Spaces, WithAConstraintAreRefused) {
  const auto arm = checkerIn("gantry", "all");
  const auto within = makeStateSpace(arm->robot(), arm->group());
  const auto constraint = std::make_shared<OnABall>();
  expectRefused(called<ob::ProjectedStateSpace>("projected", within, constraint), arm);
  expectRefused(called<ob::AtlasStateSpace>("atlas", within, constraint), arm);
  expectRefused(called<ob::WrapperStateSpace>("wrapped", within), arm);
}

TEST(Spaces, OfAnotherGroupAreRefusedWhereverTheyCome) {
  const auto checker = checkerIn("gantry", "all");
  const auto space = called<ob::RealVectorStateSpace>("other", 7u);
  space->setBounds(-1.0, 1.0);
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  const std::string wanted =
      "state space `other` is not built as makeStateSpace does for group `all`";
  const auto expectThrow = [&](const auto& act) {
    try {
      act();
      ADD_FAILURE() << "nothing thrown";
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), wanted);
    }
  };
  expectThrow([&] { PoseGoal(si, checker, "ball", Eigen::Isometry3d::Identity()); });
  expectThrow([&] { certifyPath(og::PathGeometric(si), *checker); });
  expectThrow([&] {
    og::PathGeometric path(si);
    simplifyPath(path, *checker, 0.1);
  });
  expectThrow([&] {
    ob::PlannerData data(si);
    certifyEdges(data, *checker);
  });
}

}  // namespace
}  // namespace swept::test
