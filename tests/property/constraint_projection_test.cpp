// SPDX-License-Identifier: BSD-3-Clause
// What ConstraintProjection says and finds, on random robots: judged by a reading of the
// constraints with kinematics of its own, and by differences.
#include "swept/robot_model/constraint_projection.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "constraints/case.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace {

using namespace constraints;

constexpr std::uint64_t kSeed = 7;

/// A case's checker, whose group may have its values in another order.
class ProjectedCase {
 public:
  explicit ProjectedCase(std::uint64_t index)
      : made(makeCase(kSeed, index)),
        robot_(swept::Robot::parse(made.robot.urdf(), "random.urdf")),
        checker(robot_, robot_->groups().front().name, std::make_shared<const swept::World>(),
                {.constraints = made.constraint}) {
    for (const int variable : checker.group().variables) {
      const swept::Variable& own = robot_->variables()[static_cast<std::size_t>(variable)];
      const swept::Joint& joint = robot_->joints()[static_cast<std::size_t>(own.joint)];
      for (std::size_t i = 0; i < made.robot.joints.size(); ++i)
        if (made.robot.jointName(static_cast<int>(i)) == joint.name)
          order_.push_back(made.robot.joints[i].first + variable - joint.firstVariable);
    }
  }

  std::vector<double> inGroup(const std::vector<double>& q) const {
    std::vector<double> own;
    for (const int i : order_) own.push_back(q[static_cast<std::size_t>(i)]);
    return own;
  }
  double excessAt(const std::vector<double>& q) const {
    std::vector<Real> all(made.from.begin(), made.from.end());
    for (std::size_t i = 0; i < order_.size(); ++i) all[static_cast<std::size_t>(order_[i])] = q[i];
    return static_cast<double>(excess(made, all));
  }

  double lower(std::size_t i) const { return variable(i).lower; }
  double upper(std::size_t i) const { return variable(i).upper; }

  Case made;

 private:
  const swept::Variable& variable(std::size_t i) const {
    return robot_->variables()[static_cast<std::size_t>(checker.group().variables[i])];
  }

  std::shared_ptr<const swept::Robot> robot_;
  std::vector<int> order_;

 public:
  swept::Checker checker;
};

TEST(ConstraintProjection, FindsWhereTheConstraintsHold) {
  constexpr std::uint64_t kCases = 600;
  std::array<int, kKinds> asked{}, found{};
  int outside = 0, proven = 0, all = 0;
  for (std::uint64_t i = 0; i < kCases; ++i) {
    const ProjectedCase own(i);
    const swept::ConstraintProjection projection(own.checker);
    swept::ConstraintProjection::Workspace workspace(projection);
    std::vector<double> q = own.inGroup(own.made.from);
    Random random(kSeed, i);
    if (random.chance(0.5))
      for (std::size_t k = 0; k < q.size(); ++k)
        q[k] = std::clamp(q[k] + random.uniform(-0.5, 0.5), own.lower(k), own.upper(k));
    const double before = own.excessAt(q);
    const double used = projection.usedShare(q, workspace);
    if (before > 1e-9) {
      EXPECT_GT(used, 1.0) << "case " << i;
    } else if (before < -1e-9) {
      EXPECT_LT(used, 1.0) << "case " << i;
    }
    outside += before > 0.0 ? 1 : 0;
    const auto kind = static_cast<std::size_t>(own.made.kind);
    ++asked[kind];
    std::vector<double> again = q;
    const bool arrived = projection.project(q, {}, workspace);
    EXPECT_EQ(projection.project(again, {}, workspace), arrived);
    EXPECT_EQ(again, q) << "case " << i;
    if (!arrived) continue;
    ++found[kind];
    EXPECT_LE(own.excessAt(q), 1e-9) << "case " << i;
    EXPECT_LE(projection.usedShare(q, workspace), 0.55 + 1e-9) << "case " << i;
    swept::Workspace checking(own.checker);
    const swept::StateReport report = own.checker.reportState(q, checking);
    for (const swept::ConstraintViolation& violation : report.violations)
      EXPECT_LE(violation.excess, 1e-9) << "case " << i;  // of a tolerance of nothing
    proven += report.constraintsHold ? 1 : 0;
    ++all;
    // What holds well within the tolerances stays as it is.
    const std::vector<double> inside = q;
    projection.project(q, {.share = 0.9}, workspace);
    for (std::size_t k = 0; k < q.size(); ++k) EXPECT_NEAR(q[k], inside[k], 1e-14) << "case " << i;
  }
  EXPECT_GT(outside, static_cast<int>(0.3 * kCases));
  EXPECT_GT(proven, static_cast<int>(0.9 * all));
  EXPECT_GT(all, static_cast<int>(0.6 * kCases));
  for (int kind = 0; kind < kKinds; ++kind) {
    const auto k = static_cast<std::size_t>(kind);
    EXPECT_GT(asked[k], 20) << "kind " << kind;
    EXPECT_GT(found[k], asked[k] / 4) << "kind " << kind << " of " << asked[k];
  }
}

/// A hand that a ball of a millimetre and a hundredth of a radian hold: few of the default steps
/// lead there from half a radian beside in each joint, as the curvature of a length counts (without
/// it, from 47 of these 200).
TEST(ConstraintProjection, ClosesInOnASmallRegion) {
  const std::string rook = modelsDir() + "/robots/rook7/rook7";
  const swept::Checker arm(swept::Robot::load(rook + ".urdf", rook + ".srdf"), "arm",
                           std::make_shared<const swept::World>());
  Random random(kSeed, 0);
  constexpr int kTimes = 200;
  int found = 0;
  for (int i = 0; i < kTimes; ++i) {
    std::vector<double> q(7);
    for (double& value : q) value = random.uniform(-1.4, 1.4);
    q[3] = random.uniform(0.3, 2.3);  // its limits are -0.15 and 2.75
    const Eigen::Isometry3d hand = swept::linkPose(arm.robot(), "arm", "hand", q);
    swept::ConstraintRegion ball{.type = swept::ConstraintRegion::Type::Sphere,
                                 .size = {1e-3, 0.0, 0.0}};
    ball.reference_from_region.translation() = hand.translation();
    const swept::ConstraintProjection projection(arm.withConstraints(
        {.positions = {{.frame = {"hand"}, .regions = {ball}}},
         .orientations = {{.frame = {"hand"},
                           .orientation = Eigen::Quaterniond(hand.linear()),
                           .tolerance = Eigen::Vector3d::Constant(0.01),
                           .parameterization =
                               swept::OrientationConstraint::Parameterization::RotationVector}}}));
    swept::ConstraintProjection::Workspace workspace(projection);
    for (double& value : q) value += random.uniform(-0.5, 0.5);
    found += projection.project(q, {}, workspace) ? 1 : 0;
  }
  EXPECT_GT(found, static_cast<int>(0.85 * kTimes));
}

/// `q` moved by `step` along one degree of freedom.
std::vector<double> moved(const swept::Checker& checker, std::vector<double> q, int degree,
                          double step) {
  int at = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto& variable =
        checker.robot().variables()[static_cast<std::size_t>(checker.group().variables[i])];
    if (!variable.name.ends_with("rot_x")) {
      if (at++ == degree) q[i] += step;
      continue;
    }
    if (degree >= at && degree < at + 3) {
      Eigen::Vector3d axis = Eigen::Vector3d::Zero();
      axis[degree - at] = 1.0;
      const Eigen::Quaterniond before(&q[i]);
      Eigen::Map<Eigen::Quaterniond> after(&q[i]);
      after = Eigen::Quaterniond(Eigen::AngleAxisd(step, axis)) * before.normalized();
    }
    at += 3;
    i += 3;
  }
  return q;
}

TEST(ConstraintProjection, KnowsItsDerivatives) {
  constexpr std::uint64_t kCases = 400;
  // Rounding spoils differences of short steps, curvature those of long ones: one of them must fit.
  constexpr std::array kSteps{1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  int compared = 0, jumps = 0;
  for (std::uint64_t i = 0; i < kCases; ++i) {
    const ProjectedCase own(i);
    const swept::ConstraintProjection projection(own.checker);
    if (projection.empty()) continue;
    swept::ConstraintProjection::Workspace workspace(projection);
    const std::vector<double> q = own.inGroup(own.made.from);
    Eigen::MatrixXd exact(projection.rows(), projection.degreesOfFreedom());
    projection.jacobian(q, exact, workspace);
    Eigen::VectorXd below(projection.rows()), above(projection.rows());
    for (int degree = 0; degree < projection.degreesOfFreedom(); ++degree) {
      bool fits = false;
      double change = 0.0, changeBefore = 0.0;
      try {
        for (const double step : kSteps) {
          projection.residuals(moved(own.checker, q, degree, -step), below, workspace);
          projection.residuals(moved(own.checker, q, degree, step), above, workspace);
          changeBefore = std::exchange(change, (above - below).cwiseAbs().maxCoeff());
          const Eigen::VectorXd difference = (above - below) / (2.0 * step);
          const double scale = 1.0 + difference.cwiseAbs().maxCoeff();
          fits = fits || (difference - exact.col(degree)).cwiseAbs().maxCoeff() <= 1e-4 * scale;
        }
      } catch (const std::invalid_argument&) {
        continue;  // beyond the limit of a joint that slides
      }
      ++compared;
      if (fits) continue;
      // Angles jump at half a turn: a step of a tenth then changes as much.
      const bool isJump = change > 0.5 * changeBefore;
      jumps += isJump ? 1 : 0;
      EXPECT_TRUE(isJump) << "case " << i << ", degree of freedom " << degree;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_LT(jumps, compared / 200) << "of " << compared;
}

TEST(ConstraintProjection, RefusesWhatItCannotUse) {
  const ProjectedCase own(1);
  const swept::ConstraintProjection projection(own.checker);
  swept::ConstraintProjection::Workspace workspace(projection);
  std::vector<double> q = own.inGroup(own.made.from);
  EXPECT_THROW(projection.project(q, {.share = 1.0}, workspace), std::invalid_argument);
  EXPECT_THROW(projection.project(q, {.share = 0.0}, workspace), std::invalid_argument);
  EXPECT_THROW(projection.project(q, {.maxIterations = -1}, workspace), std::invalid_argument);
  std::vector<double> longer(q.size() + 1, 0.0);
  EXPECT_THROW(projection.project(longer, {}, workspace), std::invalid_argument);
  EXPECT_THROW(projection.usedShare(longer, workspace), std::invalid_argument);
  std::vector<double> broken(q.size(), std::nan(""));
  EXPECT_THROW(projection.project(broken, {}, workspace), std::invalid_argument);
  EXPECT_EQ(projection.usedShare(broken, workspace), std::numeric_limits<double>::infinity());
}

}  // namespace
