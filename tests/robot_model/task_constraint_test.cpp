// SPDX-License-Identifier: BSD-3-Clause
// Constraints of arms of one and two joints, whose truths are plain.
#include "swept/robot_model/task_constraint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "heap_counter.hpp"
#include "message_of.hpp"
#include "swept/core/tolerances.hpp"
#include "swept/robot_model/checker.hpp"
#include "urdf_text.hpp"

namespace swept {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Parameterization = OrientationConstraint::Parameterization;

/// A link of 1 m along x, on a joint about y at the origin.
std::shared_ptr<const Robot> oneJoint(const std::string& type = "revolute") {
  return Robot::parse("<robot name='one'><link name='base'/><link name='arm'/><link name='tip'/>" +
                          test::joint("turn", type, "base", "arm", test::limited("0 1 0", -9, 9)) +
                          test::joint("end", "fixed", "arm", "tip", "<origin xyz='1 0 0'/>") +
                          "</robot>",
                      "one.urdf");
}

/// Two such links; the second joint is at the end of the first link.
std::shared_ptr<const Robot> twoJoints() {
  return Robot::parse(
      "<robot name='two'><link name='base'/><link name='upper'/><link name='lower'/>"
      "<link name='tip'/>" +
          test::joint("shoulder", "revolute", "base", "upper", test::limited("0 1 0", -9, 9)) +
          test::joint("elbow", "revolute", "upper", "lower",
                      "<origin xyz='1 0 0'/>" + test::limited("0 1 0", -9, 9)) +
          test::joint("end", "fixed", "lower", "tip", "<origin xyz='1 0 0'/>") + "</robot>",
      "two.urdf");
}

/// One checker and its workspace.
class Asked {
 public:
  Asked(std::shared_ptr<const Robot> robot, TaskConstraint constraints,
        const TrackingTolerance& tracking = {})
      : checker_(std::move(robot), "all", std::make_shared<const World>(),
                 {.tracking = tracking, .constraints = std::move(constraints)}),
        workspace_(checker_) {}

  MotionCertificate motion(const std::vector<double>& from, const std::vector<double>& to,
                           MotionQuery query = MotionQuery::FirstContact) {
    return checker_.certifyMotion(from, to, workspace_, query);
  }
  Verdict state(const std::vector<double>& q) { return checker_.checkState(q, workspace_); }
  const Checker& checker() const { return checker_; }
  Workspace& workspace() { return workspace_; }

 private:
  Checker checker_;
  Workspace workspace_;
};

TaskConstraint orientation(Eigen::Vector3d tolerance,
                           Parameterization kind = Parameterization::EulerAngles,
                           const std::string& link = "arm") {
  return {.orientations = {
              {.frame = {.body = link}, .tolerance = tolerance, .parameterization = kind}}};
}

TEST(TaskConstraint, UprightUpToItsAngle) {
  Asked asked(oneJoint(), TaskConstraint::upright("arm", 0.25));
  EXPECT_EQ(asked.state({0.2499999}), Verdict::Free);
  EXPECT_EQ(asked.state({0.2500001}), Verdict::Violation);
  EXPECT_EQ(asked.motion({-0.2499}, {0.2499}).verdict, Verdict::Free);
  const MotionCertificate found = asked.motion({0.0}, {1.0});
  ASSERT_EQ(found.verdict, Verdict::Violation);
  EXPECT_FALSE(found.witness);
  EXPECT_EQ(found.violation->kind, ConstraintViolation::Kind::Axis);
  EXPECT_LE(found.freeUntil, 0.25);
  EXPECT_GT(found.freeUntil, 0.249);
  EXPECT_GT(found.violation->t, 0.25);
  EXPECT_LT(found.violation->t, 0.251);
  EXPECT_NEAR(found.violation->excess, found.violation->t - 0.25, 1e-12);
  const MotionCertificate any = asked.motion({0.0}, {1.0}, MotionQuery::VerdictOnly);
  EXPECT_EQ(any.verdict, Verdict::Violation);
  EXPECT_EQ(any.freeUntil, 0.0);
  EXPECT_EQ(describe(*any.violation, asked.checker().options().constraints),
            "axis of 'arm' is 0.25 rad beyond its angle");
  const StateReport report = asked.checker().reportState(std::vector{0.75}, asked.workspace());
  ASSERT_EQ(report.violations.size(), 1U);
  EXPECT_NEAR(report.violations[0].excess, 0.5, 1e-12);
  EXPECT_FALSE(report.constraintsHold);
}

/// All angles of both parameterizations, wide and narrow: a turn about y by q.
TEST(TaskConstraint, AnglesOfATurn) {
  for (const double most : {0.1, 0.7, 1.5})
    for (const auto kind : {Parameterization::EulerAngles, Parameterization::RotationVector}) {
      Asked asked(oneJoint(), orientation({0.01, most, 0.01}, kind));
      EXPECT_EQ(asked.motion({-most + 1e-4}, {most - 1e-4}).verdict, Verdict::Free) << most;
      EXPECT_EQ(asked.motion({0.0}, {most + 1e-4}).verdict, Verdict::Violation) << most;
    }
  // Half a turn and more: R = Rx(pi) Ry(pi - q) Rz(pi), while the rotation vector is y q.
  Asked vector(oneJoint(), orientation({0.01, 2.5, 0.01}, Parameterization::RotationVector));
  EXPECT_EQ(vector.motion({0.0}, {2.499}).verdict, Verdict::Free);
  EXPECT_EQ(vector.state({2.501}), Verdict::Violation);
  EXPECT_EQ(vector.state({2.0 * kPi - 2.499}), Verdict::Free);
  Asked euler(oneJoint(), orientation({0.01, 1.0, 0.01}));
  EXPECT_EQ(euler.state({kPi}), Verdict::Violation);
  EXPECT_EQ(Asked(oneJoint(), orientation({kPi, 1.0, kPi})).state({kPi}), Verdict::Free);
}

/// MoveIt's way to say upright: the third tolerance allows everything.
TEST(TaskConstraint, AFreeAngleIsFreeAllTheWayRound) {
  const auto about = [](const char* axis) {
    return Robot::parse("<robot name='one'><link name='base'/><link name='arm'/>" +
                            test::joint("turn", "continuous", "base", "arm",
                                        std::string("<axis xyz='") + axis + "'/>") +
                            "</robot>",
                        "one.urdf");
  };
  for (const double any : {kPi, 4.0, kInfinity})
    for (const auto kind : {Parameterization::EulerAngles, Parameterization::RotationVector}) {
      Asked asked(about("0 0 1"), orientation({0.1, 0.1, any}, kind));
      EXPECT_EQ(asked.motion({2.0}, {-2.0}).verdict, Verdict::Free);
      EXPECT_EQ(asked.motion({-1.0}, {1.5}).verdict, Verdict::Free);
    }
  Asked all(oneJoint(), orientation({kPi, kPi, kPi}));
  EXPECT_EQ(all.motion({-9.0}, {9.0}).verdict, Verdict::Free);
  EXPECT_EQ(Asked(oneJoint(), TaskConstraint::upright("arm", kPi)).motion({-9.0}, {9.0}).verdict,
            Verdict::Free);
}

/// Where the middle angle is a right one, the others are none: nothing is Free there.
TEST(TaskConstraint, NothingIsProvenAtTheSingularAngle) {
  Asked asked(oneJoint(), orientation({3.0, 2.0, 3.0}));
  EXPECT_NE(asked.state({0.5 * kPi}), Verdict::Free);
  EXPECT_NE(asked.motion({1.0}, {2.0}).verdict, Verdict::Free);
  EXPECT_EQ(asked.motion({1.0}, {1.5}).verdict, Verdict::Free);
  // Only the middle angle counts where the others are free.
  EXPECT_EQ(Asked(oneJoint(), orientation({4.0, 1.58, 4.0})).motion({-9.0}, {9.0}).verdict,
            Verdict::Free);
}

TEST(TaskConstraint, WithoutToleranceNothingIsFree) {
  for (const auto kind : {Parameterization::EulerAngles, Parameterization::RotationVector}) {
    Asked asked(oneJoint(), orientation({0.0, 0.0, 0.0}, kind));
    EXPECT_EQ(asked.state({0.0}), Verdict::Undecided);
    EXPECT_EQ(asked.state({1e-9}), Verdict::Violation);
    EXPECT_EQ(asked.motion({0.0}, {0.0}).verdict, Verdict::Undecided);
    EXPECT_EQ(asked.motion({0.0}, {0.5}).verdict, Verdict::Violation);
  }
  Asked upright(oneJoint(), TaskConstraint::upright("arm", 0.0));
  EXPECT_EQ(upright.state({0.0}), Verdict::Undecided);
  EXPECT_EQ(upright.motion({0.0}, {0.1}).verdict, Verdict::Violation);
  Asked point(oneJoint(), TaskConstraint::inside("tip", {0, 0, 0}, Eigen::Isometry3d::Identity()));
  EXPECT_EQ(point.state({0.0}), Verdict::Violation);
}

/// A parallel motion: what one joint turns the other turns back.
TEST(TaskConstraint, TwoJointsKeepTheTipLevel) {
  Asked asked(twoJoints(), TaskConstraint::upright("tip", 1e-4));
  EXPECT_EQ(asked.motion({-1.0, 1.0}, {1.0, -1.0}).verdict, Verdict::Free);
  EXPECT_EQ(asked.motion({-1.0, 1.0}, {1.0, -1.001}).verdict, Verdict::Violation);
  Eigen::Isometry3d turned = Eigen::Isometry3d::Identity();
  turned.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).toRotationMatrix();
  Asked level(twoJoints(), TaskConstraint::level("tip", turned, 1e-3));
  EXPECT_EQ(level.motion({0.0, 0.5}, {1.0, -0.5}).verdict, Verdict::Free);
  EXPECT_EQ(level.state({0.0, 0.0}), Verdict::Violation);
}

/// The tip as seen from the upper link: the shoulder moves nothing.
TEST(TaskConstraint, RelativeToAnotherLink) {
  TaskConstraint task = TaskConstraint::upright("tip", 0.1);
  task.axes[0].reference.body = "upper";
  Asked asked(twoJoints(), task);
  EXPECT_EQ(asked.motion({-3.0, 0.0}, {3.0, 0.05}).verdict, Verdict::Free);
  EXPECT_EQ(asked.state({0.0, 0.11}), Verdict::Violation);
  // The base as seen from the tip: 2 m away at most, and the tip turns.
  TaskConstraint far{
      .positions = {{.frame = {.body = "base"},
                     .reference = {.body = "tip"},
                     .regions = {{.type = ConstraintRegion::Type::Sphere, .size = {1.9, 0, 0}}}}}};
  Asked reach(twoJoints(), far);
  EXPECT_EQ(reach.motion({-3.0, 1.0}, {3.0, 2.0}).verdict, Verdict::Free);
  const MotionCertificate stretched = reach.motion({0.0, 1.0}, {1.0, 0.0});
  ASSERT_EQ(stretched.verdict, Verdict::Violation);
  // The distance is 2 cos(q / 2).
  EXPECT_NEAR(stretched.freeUntil, 1.0 - 2.0 * std::acos(0.95), 2e-3);
}

TEST(TaskConstraint, RegionsOfACircle) {
  const Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  // The tip is at (cos q, 0, -sin q).
  Asked plane(oneJoint(), TaskConstraint::onPlane("tip", {5, 0, 3}, {0, 2, 0}, 1e-6));
  EXPECT_EQ(plane.motion({-9.0}, {9.0}).verdict, Verdict::Free);
  Asked line(oneJoint(), TaskConstraint::onLine("tip", {1, 0, 7}, {0, 0, -3}, 0.01));
  const double most = std::acos(0.99);
  EXPECT_EQ(line.motion({-most + 1e-3}, {most - 1e-3}).verdict, Verdict::Free);
  EXPECT_EQ(line.motion({0.0}, {most + 1e-3}).verdict, Verdict::Violation);
  Asked box(oneJoint(), TaskConstraint::inside("tip", {kInfinity, 1, 1}, origin));
  EXPECT_EQ(box.motion({-0.523}, {0.523}).verdict, Verdict::Free);
  const MotionCertificate outside = box.motion({0.0}, {1.0});
  ASSERT_EQ(outside.verdict, Verdict::Violation);
  EXPECT_NEAR(outside.violation->excess, std::sin(outside.violation->t) - 0.5, 1e-9);
  // Of two regions side by side each holds a part: where they overlap, and not where they touch.
  const auto slab = [&](double low, double high) {
    ConstraintRegion region{.size = {high - low, 1, 4}, .reference_from_region = origin};
    region.reference_from_region.translation().x() = 0.5 * (low + high);
    return region;
  };
  TaskConstraint both{.positions = {{.frame = {.body = "tip"}, .regions = {slab(0.0, 0.5)}}}};
  both.positions[0].regions.push_back(slab(0.45, 1.05));
  EXPECT_EQ(Asked(oneJoint(), both).motion({0.0}, {1.5}).verdict, Verdict::Free);
  both.positions[0].regions[1] = slab(0.5, 1.05);
  EXPECT_EQ(Asked(oneJoint(), both).motion({0.0}, {1.5}).verdict, Verdict::Undecided);
  both.positions[0].regions[1] = slab(0.55, 1.05);
  EXPECT_EQ(Asked(oneJoint(), both).motion({0.0}, {1.5}).verdict, Verdict::Violation);
  both.positions[0].regions.clear();
  EXPECT_NE(test::messageOf([&] { Asked(oneJoint(), both); }).find("has no region"),
            std::string::npos);
}

TEST(TaskConstraint, JointsAtTheEnds) {
  const double slack = tolerance::kLimit;
  Asked asked(twoJoints(), {.joints = {{.joint = "elbow", .position = 1.0, .above = 0.5}}});
  EXPECT_EQ(asked.motion({-3.0, 1.0}, {3.0, 1.5}).verdict, Verdict::Free);
  EXPECT_EQ(asked.motion({0.0, 1.0}, {0.0, 1.5 + 1.1 * slack}).verdict, Verdict::Violation);
  EXPECT_EQ(asked.motion({0.0, 1.0 - 1.1 * slack}, {0.0, 1.0}).verdict, Verdict::Violation);
  // Cyclic values: the shorter difference, over a full turn.
  const auto round = [](double position, double above, double below) {
    return TaskConstraint{
        .joints = {{.joint = "turn", .position = position, .above = above, .below = below}}};
  };
  Asked cyclic(oneJoint("continuous"), round(3.0 + 2.0 * kPi, 0.5, 0.5));
  EXPECT_EQ(cyclic.motion({2.6}, {-2.8}).verdict, Verdict::Free);
  EXPECT_EQ(cyclic.motion({2.6}, {-2.7}).verdict, Verdict::Violation);
  EXPECT_EQ(Asked(oneJoint("continuous"), round(3.0, 3.2, 3.2)).motion({0.0}, {3.1}).verdict,
            Verdict::Free);
  Asked held(oneJoint(), round(0.25, 0.0, 0.0));
  EXPECT_EQ(held.motion({0.25}, {0.25}).verdict, Verdict::Free);
}

/// A tube of 0.02 rad takes as much from what a motion may do.
TEST(TaskConstraint, HoldsInTheTube) {
  const TrackingTolerance tube{{.rotation = 0.02, .translation = 0.0}, {}};
  for (const TaskConstraint& task :
       {TaskConstraint::upright("arm", 0.2), orientation({0.1, 0.2, 0.1}),
        orientation({0.1, 0.2, 0.1}, Parameterization::RotationVector),
        TaskConstraint{.joints = {{.joint = "turn", .above = 0.2, .below = 0.2}}}}) {
    Asked asked(oneJoint(), task, tube);
    EXPECT_EQ(asked.motion({-0.178}, {0.178}).verdict, Verdict::Free);
    EXPECT_EQ(asked.motion({-0.178}, {0.19}).verdict, Verdict::Undecided);
    EXPECT_EQ(asked.state({0.179}), Verdict::Free);
    EXPECT_EQ(asked.state({0.181}), Verdict::Undecided);
    EXPECT_EQ(asked.state({0.201}), Verdict::Violation);
  }
}

TEST(TaskConstraint, HoldsAlongACurve) {
  Eigen::MatrixXd swing(1, 3);
  swing << 0.0, 0.5, 0.0;  // 0.25 in the middle
  const PiecewisePolynomial curve({1.0, 3.0}, {swing});
  Asked wide(oneJoint(), TaskConstraint::upright("arm", 0.252));
  EXPECT_EQ(wide.checker().certifyTrajectory(curve, wide.workspace()).verdict, Verdict::Free);
  Asked narrow(oneJoint(), TaskConstraint::upright("arm", 0.2));
  const TrajectoryCertificate found = narrow.checker().certifyTrajectory(curve, narrow.workspace());
  ASSERT_EQ(found.verdict, Verdict::Violation);
  EXPECT_FALSE(found.contact);
  // 0.5 * 2 u (1 - u) = 0.2
  const double first = 2.0 * 0.5 * (1.0 - std::sqrt(1.0 - 0.8)) + 1.0;
  EXPECT_NEAR(found.freeUntil, first, 5e-3);
  EXPECT_NEAR(found.violation->time, first, 5e-3);
}

/// A million metres from the origin: what rounding takes of places is some 1e-7 m there.
TEST(TaskConstraint, FarFrames) {
  const auto robot = Robot::parse(
      "<robot name='one'><link name='base'/><link name='arm'/><link name='tip'/>" +
          test::joint("turn", "revolute", "base", "arm",
                      "<origin xyz='1000000 0 0'/>" + test::limited("0 1 0", -9, 9)) +
          test::joint("end", "fixed", "arm", "tip", "<origin xyz='1 0 0'/>") + "</robot>",
      "one.urdf");
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.translation().x() = 1e6;
  EXPECT_EQ(Asked(robot, TaskConstraint::inside("tip", {3, 1, 3}, place)).motion({-9}, {9}).verdict,
            Verdict::Free);
  place.translation().x() = 1e6 + 1.0;
  Asked edge(robot, TaskConstraint::inside("tip", {1e-9, 1, 1}, place));
  EXPECT_NE(edge.state({0.0}), Verdict::Free);
  EXPECT_NE(edge.state({0.0}), Verdict::Violation);
  EXPECT_EQ(edge.state({1e-2}), Verdict::Violation);
}

TEST(TaskConstraint, NotFiniteIsUndecided) {
  Asked asked(oneJoint(), TaskConstraint::upright("arm", 0.25));
  EXPECT_EQ(asked.state({std::nan("")}), Verdict::Undecided);
  EXPECT_EQ(asked.motion({0.0}, {kInfinity}).verdict, Verdict::Undecided);
}

TEST(TaskConstraint, VersionsKeepThem) {
  const Checker plain(oneJoint(), "all", std::make_shared<const World>());
  const Checker upright = plain.withConstraints(TaskConstraint::upright("arm", 0.25));
  const Checker tube = upright.withTracking({{.rotation = 0.1, .translation = 0.0}, {}});
  const Checker again = tube.withConstraints({});
  const auto verdict = [](const Checker& checker) {
    Workspace workspace(checker);
    return checker.checkState(std::vector{0.5}, workspace);
  };
  EXPECT_EQ(verdict(plain), Verdict::Free);
  EXPECT_EQ(verdict(upright), Verdict::Violation);
  EXPECT_EQ(verdict(tube), Verdict::Violation);
  EXPECT_EQ(verdict(again), Verdict::Free);
}

/// A frame of what a link carries is one of that link.
TEST(TaskConstraint, OfAnAttachedBody) {
  const Checker plain(oneJoint(), "all", std::make_shared<const World>());
  const Checker carries =
      plain.withAttached("cup", "tip", makeSphere(0.05), Eigen::Isometry3d::Identity());
  const Checker upright = carries.withConstraints(TaskConstraint::upright("cup", 0.25));
  Workspace workspace(upright);
  EXPECT_EQ(upright.checkState(std::vector{0.2}, workspace), Verdict::Free);
  EXPECT_EQ(upright.checkState(std::vector{0.3}, workspace), Verdict::Violation);
  EXPECT_EQ(test::messageOf([&] { upright.withoutAttached("cup"); }),
            "Checker: constraint of an axis of 'cup' names 'cup', which is no link and no attached "
            "body");
}

TEST(TaskConstraint, RefusesWhatIsNone) {
  const auto message = [](const TaskConstraint& task) {
    return test::messageOf([&] { Asked(twoJoints(), task); });
  };
  EXPECT_EQ(message({.joints = {{.joint = "elbo"}}}),
            "Checker: constraint of joint 'elbo': robot 'two' has no such joint; did you mean "
            "'elbow'?");
  EXPECT_EQ(message({.joints = {{.joint = "end"}}}),
            "Checker: constraint of joint 'end' is about a joint that does not move");
  EXPECT_EQ(message({.joints = {{.joint = "elbow", .above = -0.5}}}),
            "Checker: constraint of joint 'elbow' has tolerance above -0.5, which must be a number "
            "that is not negative");
  EXPECT_EQ(message({.joints = {{.joint = "elbow", .position = 10, .above = 0.5, .below = 0.5}}}),
            "Checker: constraint of joint 'elbow' allows 9.5 to 10.5, of which nothing is within "
            "its limits");
  EXPECT_EQ(message(TaskConstraint::upright("tool", 0.1)),
            "Checker: constraint of an axis of 'tool' names 'tool', which is no link and no "
            "attached body");
  EXPECT_EQ(message(TaskConstraint::upright("tip", std::nan(""))),
            "Checker: constraint of an axis of 'tip' has angle nan rad, which must be a number "
            "that is not negative");
  EXPECT_EQ(message(TaskConstraint::upright("tip", 0.1, Eigen::Vector3d::Zero())),
            "Checker: constraint of an axis of 'tip': the axis has no direction");
  EXPECT_EQ(message(TaskConstraint::onLine("tip", {0, 0, 0}, {0, 0, 0}, 0.1)),
            "Checker: constraint of the position of 'tip' has a region with a pose that is no "
            "rotation and place");
  TaskConstraint turned = orientation({0.1, 0.1, 0.1}, Parameterization::EulerAngles, "tip");
  turned.orientations[0].orientation.coeffs().setZero();
  EXPECT_EQ(message(turned),
            "Checker: constraint of the orientation of 'tip' has a quaternion without direction");
  TaskConstraint many;
  for (int i = 0; i < 65; ++i) many.add(TaskConstraint::upright("tip", 0.1));
  EXPECT_EQ(message(many), "Checker: 65 constraints are more than 64");
  many.axes.pop_back();
  EXPECT_EQ(Asked(twoJoints(), many).state({0.0, 0.0}), Verdict::Free);
}

/// Single precision proves all eighths of a motion that keeps some distance; beside a tolerance the
/// rest is left to double precision, as is all of a motion in a tube.
TEST(TaskConstraint, PartsOfAMotionInSinglePrecision) {
  Asked asked(oneJoint(), TaskConstraint::upright("arm", 0.25));
  const MotionCertificate clear = asked.motion({-0.24}, {0.24});
  EXPECT_EQ(clear.verdict, Verdict::Free);
  EXPECT_EQ(clear.freeUntil, 1.0);
  EXPECT_EQ(clear.effort.constrained, 8);
  const MotionCertificate near = asked.motion({-0.24}, {0.2499999});
  EXPECT_EQ(near.verdict, Verdict::Free);
  EXPECT_GT(near.effort.constrained, 8);
  EXPECT_EQ(asked.motion({-0.24}, {0.2500001}).verdict, Verdict::Violation);
  Asked tube(oneJoint(), TaskConstraint::upright("arm", 0.25),
             {{.rotation = 0.01, .translation = 0.0}, {}});
  EXPECT_EQ(tube.motion({0.0}, {0.0}).effort.constrained, 1);
  // A joint's own value is left to double precision, too; so what is beside it is as it was.
  TaskConstraint both = TaskConstraint::upright("arm", 0.25);
  both.joints.push_back({.joint = "turn", .above = 0.2, .below = 0.3});
  Asked two(oneJoint(), both);
  EXPECT_EQ(two.motion({-0.24}, {0.19}).verdict, Verdict::Free);
  const MotionCertificate left = two.motion({-0.24}, {0.24});
  ASSERT_EQ(left.verdict, Verdict::Violation);
  EXPECT_EQ(left.violation->kind, ConstraintViolation::Kind::Joint);
}

TEST(TaskConstraint, QueriesAllocateNothing) {
  TaskConstraint task = orientation({0.3, 0.6, 0.3});
  task.add(TaskConstraint::inside("tip", {3, 3, 3}, Eigen::Isometry3d::Identity()));
  for (const double rotation : {0.0, 0.01}) {
    Asked asked(oneJoint(), task, {{.rotation = rotation, .translation = 0.0}, {}});
    const std::vector<double> left{-0.5}, middle{0.0}, right{0.5}, beyond{1.0};
    const auto ask = [&] {
      return asked.motion(left, right).verdict == Verdict::Free &&
             asked.motion(middle, beyond).verdict == Verdict::Violation &&
             asked.state(middle) == Verdict::Free;
    };
    EXPECT_TRUE(ask());
    const long before = test::allocations;
    EXPECT_TRUE(ask());
    EXPECT_EQ(test::allocations - before, 0);
  }
}

}  // namespace
}  // namespace swept
