// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "model_robots.hpp"
#include "random_trajectories.hpp"
#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "verify/check.hpp"
#include "verify/proof.hpp"

/// What the checker of proofs computes of curves and tubes, against the library's curves and
/// kinematics, with which it has nothing in common.
namespace swept::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct Subject {
  const char* robot;
  const char* group;
  std::vector<double> state;
};

/// Revolute, prismatic, mimicking, planar and floating joints.
const Subject kSubjects[] = {
    {"rook7", "arm_with_gripper", {0.0, -0.3, 0.0, 1.9, 0.0, 1.54, 0.0, 0.0}},
    {"rook6_cart", "whole_body", {-1.5, 0, 0, 0, -0.6, 1.2, -0.6, 0, 0}},
    {"drifter", "body", {0.0, 0.0, 1.5, 0.0, 0.0, 0.0, 1.0}},
};

TrackingTolerance tube() {
  TrackingTolerance tracking;
  tracking.rotation = 0.02;
  tracking.translation = 0.01;
  return tracking;
}

class CurveBounds : public testing::TestWithParam<Subject> {
 protected:
  CurveBounds()
      : robot_(modelRobot(GetParam().robot)),
        checker_(robot_, GetParam().group, world(), optionsOf(tube())),
        random_(checker_, 3),
        model_(modelOf(checker_)),
        exact_(modelOf(Checker(robot_, GetParam().group, world()))) {}

  static CheckerOptions optionsOf(const TrackingTolerance& tracking) {
    CheckerOptions options;
    options.tracking = tracking;
    return options;
  }
  static std::shared_ptr<const World> world() {
    auto world = std::make_shared<World>();
    world->add(WorldBody{
        .name = "post",
        .parts = {{makeBox({0.1, 0.2, 0.3}), Isometry3d(Eigen::Translation3d(40.0, 0.0, 0.0))}}});
    return world;
  }
  /// The model in a file of the checker's.
  static verify::Model modelOf(const Checker& checker) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "path.json";
    const std::vector<std::vector<double>> states{GetParam().state};
    EXPECT_TRUE(writeProof(file, checker, states, certifyPath(checker, states)).isWritten());
    std::ifstream stream(file);
    return verify::readModel(verify::Json::parse(stream)["model"]);
  }

  /// Two points, and the piece of a curve between them.
  struct Piece {
    verify::Point from, to;
    PiecewisePolynomial curve;
    double duration() const { return to.time - from.time; }
    double timeAt(double u) const { return from.time + u * duration(); }
  };
  Piece piece(double step) {
    const auto spline = static_cast<Spline>(random_.uniform(0.0, 3.0));
    JointTrajectory trajectory = random_.make(state(), 2, step, spline);
    if (spline != Spline::Linear) keepOrientations(trajectory);
    slideLittle(trajectory);
    const auto pointOf = [](const TrajectoryPoint& point) {
      return verify::Point{point.time, point.positions, point.velocities, point.accelerations};
    };
    return {pointOf(trajectory.points[0]), pointOf(trajectory.points[1]),
            controllerCurve(trajectory)};
  }
  std::vector<double> state() {
    std::vector<double> q = GetParam().state;
    for (double& value : q) value += random_.uniform(-0.5, 0.5);
    return q;
  }
  /// The gripper stays within its limits, and is often near one.
  void slideLittle(JointTrajectory& trajectory) {
    for (std::size_t i = 0; i < trajectory.variables.size(); ++i) {
      if (!isSlide(i)) continue;
      const double begin = random_.uniform(0.003, 0.037);
      for (TrajectoryPoint& point : trajectory.points) {
        point.positions[i] = begin + random_.uniform(-0.001, 0.001);
        if (!point.velocities.empty()) point.velocities[i] *= 0.002;
        if (!point.accelerations.empty()) point.accelerations[i] *= 0.002;
      }
    }
  }
  bool isSlide(std::size_t i) const {
    const int variable = checker_.group().variables[i];
    return robot_->joints()[jointOf(variable)].type == JointType::Prismatic;
  }
  std::size_t jointOf(int variable) const {
    return static_cast<std::size_t>(robot_->variables()[static_cast<std::size_t>(variable)].joint);
  }
  bool isOrientation(std::size_t i) const {
    const Joint& joint = robot_->joints()[jointOf(checker_.group().variables[i])];
    return joint.type == JointType::Floating &&
           checker_.group().variables[i] - joint.firstVariable >= 3;
  }
  void keepOrientations(JointTrajectory& trajectory) const {
    for (std::size_t i = 0; i < trajectory.variables.size(); ++i) {
      if (!isOrientation(i)) continue;
      for (TrajectoryPoint& point : trajectory.points) {
        point.positions[i] = trajectory.points[0].positions[i];
        point.velocities[i] = 0.0;
        if (!point.accelerations.empty()) point.accelerations[i] = 0.0;
      }
    }
  }

  /// Along a straight piece an orientation is slerp's.
  std::vector<double> configuration(const Piece& own, double u) const {
    const Eigen::VectorXd q = own.curve.position(own.timeAt(u));
    if (verify::isCurved(own.from, own.to)) return {q.begin(), q.end()};
    const Eigen::VectorXd straight = checker_.interpolate(own.from.positions, own.to.positions, u);
    return {straight.begin(), straight.end()};
  }
  Isometry3d poseOf(int link, const std::vector<double>& q) const {
    if (link < 0) return Isometry3d::Identity();
    return LinkMotion(*robot_, GetParam().group, model_.links[static_cast<std::size_t>(link)], q, q)
        .at(0.0);
  }

  /// Within the tube around q: every joint off by all it may, or by something.
  std::vector<double> off(std::vector<double> q) {
    for (const int index : checker_.group().joints) {
      const Joint& joint = robot_->joints()[static_cast<std::size_t>(index)];
      const auto first = static_cast<std::size_t>(
          std::ranges::find(checker_.group().variables, joint.firstVariable) -
          checker_.group().variables.begin());
      const double turn = error(0.02), angle = random_.uniform(-4.0, 4.0);
      const double slide = error(0.01);
      switch (joint.type) {
        case JointType::Revolute:
        case JointType::Continuous:
          q[first] += turn;
          break;
        case JointType::Prismatic: {
          const Variable& variable =
              robot_->variables()[static_cast<std::size_t>(joint.firstVariable)];
          q[first] = std::clamp(q[first] + slide, std::min(q[first], variable.lower),
                                std::max(q[first], variable.upper));
          break;
        }
        case JointType::Planar:
          q[first] += slide * std::cos(angle);
          q[first + 1] += slide * std::sin(angle);
          q[first + 2] += turn;
          break;
        case JointType::Floating: {
          const Vector3d way = direction(), axis = direction();
          for (std::size_t k = 0; k < 3; ++k)
            q[first + k] += slide * way[static_cast<Eigen::Index>(k)];
          Eigen::Quaterniond own(q[first + 6], q[first + 3], q[first + 4], q[first + 5]);
          own = Eigen::Quaterniond(Eigen::AngleAxisd(turn, axis)) * own.normalized();
          const Eigen::Vector4d xyzw = own.coeffs();
          for (std::size_t k = 0; k < 4; ++k) q[first + 3 + k] = xyzw[static_cast<Eigen::Index>(k)];
          break;
        }
        case JointType::Fixed:
          break;
      }
    }
    return q;
  }
  double error(double most) {
    const double share = random_.uniform(-1.5, 1.5);
    return most * std::clamp(share, -1.0, 1.0);
  }
  Vector3d direction() {
    Vector3d way = Vector3d::Zero();
    while (!(way.norm() > 0.1))
      way = {random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0)};
    return way.normalized();
  }

  std::shared_ptr<const Robot> robot_;
  Checker checker_;
  RandomTrajectories random_;
  verify::Model model_;  ///< with the tube
  verify::Model exact_;  ///< without
};

TEST_P(CurveBounds, LinksMoveAsTheLibraryHasThem) {
  for (int i = 0; i < 60; ++i) {
    const Piece own = piece(0.5);
    const verify::Motion motion(model_, own.from, own.to);
    const double u = random_.uniform(0.0, 1.0);
    const std::vector<double> q = configuration(own, u);
    // For a moment as fast as the curve.
    constexpr double kMoment = 1e-3;
    const Eigen::VectorXd rate = own.curve.velocity(own.timeAt(u)) * own.duration();
    std::vector<double> next = q;
    const bool straight = !verify::isCurved(own.from, own.to);
    if (straight)
      next = configuration(own, std::min(u + kMoment, 1.0));
    else
      for (std::size_t k = 0; k < q.size(); ++k) next[k] += kMoment * rate[static_cast<long>(k)];
    const double share = straight ? std::min(u + kMoment, 1.0) - u : kMoment;
    if (share == 0.0) continue;
    for (std::size_t link = 0; link < model_.links.size(); ++link) {
      const verify::Placed placed = motion.at(static_cast<int>(link), -1, u);
      EXPECT_LE(
          (placed.reference_from_link.matrix() - poseOf(static_cast<int>(link), q).matrix()).norm(),
          1e-12);
      const LinkMotion moment(*robot_, GetParam().group, model_.links[link], q, next);
      const Twist twist = moment.velocity(0.0);
      const Vector3d origin = placed.reference_from_link.translation();
      EXPECT_LE((placed.angular - twist.angular / share).norm(), 1e-9);
      EXPECT_LE((placed.linear + placed.angular.cross(origin) - twist.linear / share).norm(), 1e-9);
    }
  }
}

/// Over shorter intervals bounds are smaller, and still none is exceeded.
TEST_P(CurveBounds, NoPointAcceleratesMore) {
  double largestShare = 0.0, atAll = 0.0, atSome = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Piece own = piece(0.5);
    const verify::Motion motion(exact_, own.from, own.to);
    const double half = 0.5 * std::pow(random_.uniform(0.2, 1.0), 2.0);
    const double middle = random_.uniform(half, 1.0 - half);
    for (std::size_t k = 0; k < exact_.bodies.size(); ++k) {
      const int link = exact_.linkOf[k];
      if (link < 0) continue;
      const double reach = exact_.bodies[k].reach();
      const double most = motion.bounds(link, -1, reach, middle, half).acceleration / (half * half);
      atSome += most;
      atAll += 4.0 * motion.bounds(link, -1, reach, 0.5, 0.5).acceleration;
      const double step = 1e-3 * half;
      const double u = middle + (half - step) * random_.uniform(-1.0, 1.0);
      for (const verify::Element& element : exact_.bodies[k].elements()) {
        if (element.points.empty()) continue;
        const Vector3d point = element.points.front();
        const auto placeAt = [&](double t) -> Vector3d {
          return motion.at(link, -1, t).reference_from_link * point;
        };
        const double change =
            (placeAt(u + step) - 2.0 * placeAt(u) + placeAt(u - step)).norm() / (step * step);
        EXPECT_LE(change, most * (1.0 + 1e-6) + 1e-2);
        largestShare = std::max(largestShare, most > 0.1 ? change / most : 0.0);
      }
    }
  }
  EXPECT_GE(largestShare, 0.3) << "a bound that is never near says little";
  EXPECT_LT(atSome, 0.9 * atAll);
}

/// m. How far the points of what two nodes hold are apart along n; those of a wall have none.
double apart(const verify::Body& a, int nodeA, const Isometry3d& poseA, const verify::Body& b,
             int nodeB, const Isometry3d& poseB, const Vector3d& n) {
  const auto most = [](const verify::Body& body, int node, const Isometry3d& pose,
                       const Vector3d& way) {
    return body.support(node, pose.linear().transpose() * way) + way.dot(pose.translation());
  };
  return -most(b, nodeB, poseB, -n) - most(a, nodeA, poseA, n);
}

/// At sampled times of an interval, and wherever joints may be then, two nodes are not nearer along
/// n than the gap.
TEST_P(CurveBounds, NothingInTheTubeIsNearerThanAGap) {
  const std::vector<verify::PairToProve> pairs = verify::pairsToProve(model_);
  int cases = 0, tight = 0, taken = 0;
  for (int i = 0; i < 400; ++i) {
    const Piece own = piece(0.3);
    const verify::Motion motion(model_, own.from, own.to), exact(exact_, own.from, own.to);
    const auto index =
        static_cast<std::size_t>(random_.uniform(0.0, static_cast<double>(pairs.size()) - 1e-9));
    const verify::PairToProve pair = pairs[index];
    const verify::Body& a = model_.bodies[static_cast<std::size_t>(pair.a)];
    const verify::Body& b = model_.bodies[static_cast<std::size_t>(pair.b)];
    const int linkA = model_.linkOf[static_cast<std::size_t>(pair.a)];
    const int linkB = model_.linkOf[static_cast<std::size_t>(pair.b)];
    const int reference = linkB < 0 ? -1 : verify::commonAncestor(model_, linkA, linkB);
    const double begin = random_.uniform(0.0, 0.9);
    const double end = begin + 0.1 * std::pow(random_.uniform(0.0, 1.0), 2.0);
    const verify::PairMotion between(model_, motion, pair, begin, end);
    const Vector3d n = direction();
    const double gap = between.gap(0, 0, n);
    double sampled = INFINITY, alone = INFINITY;
    const auto look = [&](const std::vector<double>& q, double& least) {
      const Isometry3d reference_from_model = poseOf(reference, q).inverse();
      least = std::min(least, apart(a, 0, reference_from_model * poseOf(linkA, q), b, 0,
                                    reference_from_model * poseOf(linkB, q), n));
    };
    for (const double share : {0.0, 1.0, random_.uniform(0.0, 1.0)}) {
      const std::vector<double> q = configuration(own, begin + share * (end - begin));
      look(q, alone);
      for (int k = 0; k < 12; ++k) look(off(q), sampled);
    }
    ++cases;
    ASSERT_LE(gap, sampled) << a.name() << " - " << b.name() << ", " << begin << " to " << end;
    tight += alone - gap < 3.0 * (alone - sampled) ? 1 : 0;
    taken += sampled < verify::PairMotion(exact_, exact, pair, begin, end).gap(0, 0, n) ? 1 : 0;
  }
  EXPECT_GE(tight, cases / 2) << "bounds take more than three times what samples do";
  EXPECT_GE(taken, cases * 4 / 5) << "without the tolerances bounds would be too large";
}

INSTANTIATE_TEST_SUITE_P(Robots, CurveBounds, testing::ValuesIn(kSubjects));

/// A finger at its limit opens, and does not close.
TEST(CurveBoundsOfSlides, NoToleranceIsBeyondALimit) {
  const auto robot = modelRobot("rook7");
  CheckerOptions options;
  options.tracking = tube();
  const Checker checker(robot, "gripper", std::make_shared<const World>(), options);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "path.json";
  const std::vector<std::vector<double>> states{{0.0}, {0.015}, {0.04}};
  ASSERT_TRUE(writeProof(file, checker, states, certifyPath(checker, states)).isWritten());
  std::ifstream stream(file);
  const verify::Model model = verify::readModel(verify::Json::parse(stream)["model"]);
  const auto finger = [&](const char* name) {
    return static_cast<int>(std::ranges::find(model.links, name) - model.links.begin());
  };
  const auto playAt = [&](double value, double half, const char* link) {
    const std::vector<double> from{value - 2.0 * half}, to{value + 2.0 * half};
    return verify::Motion(model, from, to).at(finger(link), finger("hand"), 0.5, 0.25).plays.at(0);
  };
  for (const char* link : {"finger_left", "finger_right"}) {
    EXPECT_EQ(playAt(0.0, 0.0, link).backward, 0.0);
    EXPECT_EQ(playAt(0.0, 0.0, link).forward, 0.01);
    EXPECT_NEAR(playAt(0.004, 0.001, link).backward, 0.005, 1e-15);
    EXPECT_EQ(playAt(0.02, 0.001, link).backward, 0.01);
    EXPECT_EQ(playAt(0.02, 0.001, link).forward, 0.01);
    EXPECT_NEAR(playAt(0.036, 0.001, link).forward, 0.005, 1e-15);
    EXPECT_EQ(playAt(-5e-6, 0.0, link).backward, 0.0) << "a little beyond the limit";
  }
}

}  // namespace
}  // namespace swept::test
