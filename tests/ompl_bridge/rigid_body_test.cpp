// SPDX-License-Identifier: BSD-3-Clause
// A rigid body in SE(3): an L, as a closed mesh, that has to thread through a square hole in a
// wall, another mesh. The oracle knows nothing of meshes: the L is two boxes and the wall is four.
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "../core/mesh_samples.hpp"
#include "../robot_model/input_files.hpp"
#include "rigid_bodies.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Eigen::Vector3d;

// OMPL seeds by the clock unless told before its first random number; tests repeat.
[[maybe_unused]] const bool kSeeded = (ompl::RNG::setSeed(7), true);

// m; mesh files keep floats, which these are.
constexpr double kReach = 0.3125, kInner = -0.15625, kHalfThick = 0.078125;  // of the L
constexpr double kHole = 0.265625, kHalfWall = 0.0625, kFar = 2.0;
constexpr double kBound = 1.0;  // of the L's position

struct OrientedBox {
  Vector3d centre;
  Vector3d half;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  OrientedBox(const Vector3d& low, const Vector3d& high)
      : centre(0.5 * (low + high)), half(0.5 * (high - low)) {}
  OrientedBox moved(const Eigen::Isometry3d& by) const {
    OrientedBox box = *this;
    box.centre = by * centre;
    box.axes = by.linear() * axes;
    return box;
  }
  Vector3d corner(int i) const {
    const Vector3d signs(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
    return centre + axes * signs.cwiseProduct(half);
  }
  double reachAlong(const Vector3d& direction) const {
    return (axes.transpose() * direction).cwiseAbs().dot(half);
  }
  double distance(const Vector3d& point) const {
    const Vector3d local = axes.transpose() * (point - centre);
    return (local.cwiseAbs() - half).cwiseMax(0.0).norm();
  }
};

/// By the fifteen axes that can separate two boxes.
bool overlap(const OrientedBox& a, const OrientedBox& b) {
  const auto separates = [&](const Vector3d& axis) {
    const double length = axis.norm();
    if (length < 1e-9) return false;  // parallel edges; the faces' axes are enough
    const double apart = std::abs(axis.dot(b.centre - a.centre));
    return apart > a.reachAlong(axis) + b.reachAlong(axis);
  };
  for (int i = 0; i < 3; ++i) {
    if (separates(a.axes.col(i)) || separates(b.axes.col(i))) return false;
    for (int k = 0; k < 3; ++k)
      if (separates(a.axes.col(i).cross(b.axes.col(k)))) return false;
  }
  return true;
}

/// m. By the nearest points of the lines, else by an end of either.
double segmentDistance(const Vector3d& p0, const Vector3d& p1, const Vector3d& q0,
                       const Vector3d& q1) {
  const auto toSegment = [](const Vector3d& x, const Vector3d& a, const Vector3d& b) {
    const double s = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (x - a - s * (b - a)).norm();
  };
  double least = std::min(
      {toSegment(p0, q0, q1), toSegment(p1, q0, q1), toSegment(q0, p0, p1), toSegment(q1, p0, p1)});
  const Vector3d u = p1 - p0, v = q1 - q0, w = q0 - p0, normal = u.cross(v);
  const double square = normal.squaredNorm();
  if (square < 1e-18) return least;
  const double s = w.cross(v).dot(normal) / square, t = w.cross(u).dot(normal) / square;
  if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)
    least = std::min(least, std::abs(w.dot(normal)) / std::sqrt(square));
  return least;
}

/// m. Of two boxes apart, a corner of one or an edge of each is nearest.
double distance(const OrientedBox& a, const OrientedBox& b) {
  if (overlap(a, b)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i)
    least = std::min({least, b.distance(a.corner(i)), a.distance(b.corner(i))});
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 8; ++k) {
      for (const int along : {1, 2, 4}) {
        for (const int across : {1, 2, 4}) {
          if ((i & along) != 0 || (k & across) != 0) continue;
          least = std::min(least, segmentDistance(a.corner(i), a.corner(i | along), b.corner(k),
                                                  b.corner(k | across)));
        }
      }
    }
  }
  return least;
}

std::vector<OrientedBox> legs() {
  return {{{-kReach, -kReach, -kHalfThick}, {kReach, kInner, kHalfThick}},
          {{-kReach, -kReach, -kHalfThick}, {kInner, kReach, kHalfThick}}};
}

std::vector<OrientedBox> wall() {
  return {{{-kHalfWall, -kFar, -kFar}, {kHalfWall, kFar, -kHole}},
          {{-kHalfWall, -kFar, kHole}, {kHalfWall, kFar, kFar}},
          {{-kHalfWall, -kFar, -kHole}, {kHalfWall, -kHole, kHole}},
          {{-kHalfWall, kHole, -kHole}, {kHalfWall, kFar, kHole}}};
}

Soup meshOfL() {
  return blockMesh<Soup>(
      {{{{-kReach, kInner, kReach}, {-kReach, kInner, kReach}, {-kHalfThick, kHalfThick}}},
       {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
}

Soup meshOfWall() {
  BlockGrid grid{
      {{{-kHalfWall, kHalfWall}, {-kFar, -kHole, kHole, kFar}, {-kFar, -kHole, kHole, kFar}}}, {}};
  for (std::size_t y = 0; y < 3; ++y)
    for (std::size_t z = 0; z < 3; ++z)
      if (y != 1 || z != 1) grid.blocks.push_back({0, y, z});
  return blockMesh<Soup>(grid);
}

std::shared_ptr<const Checker> floatingL() {
  const TemporaryFolder folder;
  writeObj(meshOfL(), folder.path() / "l.obj");
  const Soup soup = meshOfWall();
  const TriangleMesh mesh = TriangleMesh::build(soup.vertices, soup.triangles);
  EXPECT_TRUE(mesh.isClosed());
  auto world = std::make_shared<World>();
  world->add("wall", mesh, Eigen::Isometry3d::Identity());
  return std::make_shared<const Checker>(floatingBody(folder.path() / "l.obj"), "all", world);
}

StateSpaceOptions bounds() {
  StateSpaceOptions options;
  for (const char* axis : {"x", "y", "z"})
    options.limits[std::string("place/trans_") + axis] = {-kBound, kBound};
  return options;
}

class RigidBody : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
    sharedChecker = floatingL();
  }
  static void TearDownTestSuite() { sharedChecker.reset(); }

  static Eigen::Isometry3d poseOf(std::span<const double> q) {
    Eigen::Isometry3d pose(Eigen::Translation3d(q[0], q[1], q[2]));
    pose.rotate(Eigen::Quaterniond(q[6], q[3], q[4], q[5]).normalized());
    return pose;
  }
  std::vector<double> configurationOf(const ob::State* state) const {
    std::vector<double> q(7);
    conversion_.toConfiguration(state, q);
    return q;
  }
  static bool touches(std::span<const double> q) {
    const Eigen::Isometry3d pose = poseOf(q);
    for (const OrientedBox& leg : legs())
      for (const OrientedBox& part : wall())
        if (overlap(leg.moved(pose), part)) return true;
    return false;
  }
  static double clearanceAt(std::span<const double> q) {  // m
    const Eigen::Isometry3d pose = poseOf(q);
    double least = std::numeric_limits<double>::infinity();
    for (const OrientedBox& leg : legs())
      for (const OrientedBox& part : wall())
        least = std::min(least, distance(leg.moved(pose), part));
    return least;
  }
  bool touchesAt(const ob::State* from, const ob::State* to, double t) {
    space_->interpolate(from, to, t, at_.get());
    return touches(configurationOf(at_.get()));
  }
  /// Any state, but within `reach` of the wall (m).
  void sampleNear(ob::ScopedState<>& state, double reach) {
    state.random();
    std::vector<double> q = configurationOf(state.get());
    q[0] *= reach / kBound;
    conversion_.toState(q, state.get());
  }

  static inline std::shared_ptr<const Checker> sharedChecker;
  og::SimpleSetupPtr setup_ = makeSimpleSetup(sharedChecker, {.space = bounds()});
  ob::StateSpacePtr space_ = setup_->getStateSpace();
  StateConversion conversion_{sharedChecker->robot(), sharedChecker->group()};
  ob::ScopedState<> from_{space_}, to_{space_}, at_{space_}, last_{space_};
};

TEST_F(RigidBody, IsOneSolidThatFloats) {
  ASSERT_EQ(sharedChecker->dimension(), 7);
  const auto& parts = sharedChecker->robot().links()[0].collision;
  ASSERT_EQ(parts.size(), 1u);
  const auto& mesh = std::get<TriangleMesh>(parts[0].shape);
  EXPECT_TRUE(mesh.isClosed());
  EXPECT_TRUE(mesh.encloses({-0.2, -0.2, 0.0}));
  EXPECT_FALSE(mesh.encloses({0.1, 0.1, 0.0}));  // between the legs
}

TEST_F(RigidBody, StatesAreWhatTheBoxesSay) {
  constexpr int kStates = 2000;
  Workspace workspace(*sharedChecker);
  int free = 0;
  for (int i = 0; i < kStates; ++i) {
    sampleNear(from_, 0.5);
    const std::vector<double> q = configurationOf(from_.get());
    const double truth = clearanceAt(q);
    const bool valid = setup_->getSpaceInformation()->isValid(from_.get());
    free += valid;
    if (truth > 1e-9) {
      ASSERT_TRUE(valid);
      ASSERT_NEAR(sharedChecker->clearance(q, workspace), truth, 1e-8);
    } else {
      ASSERT_FALSE(valid);
    }
  }
  EXPECT_GT(free, kStates / 4);
  EXPECT_LT(free, kStates * 3 / 4);
}

/// Straight from place to place, and about one axis at one rate, by less than half a turn.
Eigen::Isometry3d between(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double t) {
  Eigen::AngleAxisd turn(Eigen::Matrix3d(a.linear().transpose() * b.linear()));
  Eigen::Isometry3d pose(
      Eigen::Translation3d(a.translation() + t * (b.translation() - a.translation())));
  pose.rotate(a.linear() * Eigen::AngleAxisd(t * turn.angle(), turn.axis()).toRotationMatrix());
  return pose;
}

TEST_F(RigidBody, TheSpaceInterpolatesTheCertifiedMotion) {
  std::mt19937 random(3);
  constexpr int kMotions = 2000;
  int opposite = 0;
  for (int i = 0; i < kMotions; ++i) {
    from_.random();
    to_.random();
    const std::vector<double> a = configurationOf(from_.get()), b = configurationOf(to_.get());
    const double t = uniform(random, 0.0, 1.0);
    space_->interpolate(from_.get(), to_.get(), t, at_.get());
    const Eigen::VectorXd ours = sharedChecker->interpolate(a, b, t);
    const Eigen::Isometry3d pose = poseOf({ours.data(), 7});
    ASSERT_LT((poseOf(configurationOf(at_.get())).matrix() - pose.matrix()).norm(), 1e-12);
    ASSERT_LT((between(poseOf(a), poseOf(b), t).matrix() - pose.matrix()).norm(), 1e-9);
    opposite += a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0.0;
  }
  EXPECT_GT(opposite, kMotions / 4);  // of which the quaternions are on different sides
  EXPECT_LT(opposite, kMotions * 3 / 4);
}

TEST_F(RigidBody, LastValidIsWhereTheWallBegins) {
  constexpr int kMotions = 600, kSamples = 100;
  const auto& si = *setup_->getSpaceInformation();
  int free = 0, stopped = 0, within = 0;
  for (int i = 0; i < kMotions;) {
    sampleNear(from_, kBound);
    to_.random();
    if (touches(configurationOf(from_.get()))) continue;
    ++i;
    std::pair<ob::State*, double> last{last_.get(), -1.0};
    const bool valid = si.getMotionValidator()->checkMotion(from_.get(), to_.get(), last);
    const double proven = valid ? 1.0 : last.second;
    ASSERT_TRUE(proven >= 0.0 && proven <= 1.0);
    for (int k = 0; k <= kSamples; ++k)
      ASSERT_FALSE(touchesAt(from_.get(), to_.get(), proven * k / kSamples));
    free += valid;
    if (valid) continue;

    space_->interpolate(from_.get(), to_.get(), proven, at_.get());
    EXPECT_LT(space_->distance(at_.get(), last_.get()), 1e-7);
    EXPECT_LE(clearanceAt(configurationOf(last_.get())), 2.0 * tolerance::kMotion);
    stopped += proven > 0.0;
    bool entered = false;
    for (int k = 1; k <= kSamples && !entered; ++k)
      entered = touchesAt(from_.get(), to_.get(), proven + (1.0 - proven) * k / kSamples);
    within += entered;
  }
  EXPECT_GT(free, kMotions / 5);
  EXPECT_GT(stopped, kMotions / 5);
  // Some only come near, and some touch more briefly than the samples are apart.
  EXPECT_GT(within, stopped * 9 / 10);
}

TEST_F(RigidBody, ThreadsThroughTheHole) {
  const std::vector<double> start{-0.8, 0.4, -0.3, 0.0, 0.0, 0.0, 1.0};
  const std::vector<double> goal{0.8, -0.4, 0.3, 0.0, 0.0, 0.0, 1.0};
  conversion_.toState(start, from_.get());
  conversion_.toState(goal, to_.get());
  setup_->setStartAndGoalStates(from_, to_);
  setup_->setPlanner(std::make_shared<og::RRTConnect>(setup_->getSpaceInformation()));
  ASSERT_TRUE(setup_->solve(120.0) == ob::PlannerStatus::EXACT_SOLUTION);
  const og::PathGeometric& path = setup_->getSolutionPath();
  EXPECT_TRUE(path.check());
  const auto certificates = certifyPath(path, *sharedChecker);
  ASSERT_EQ(certificates.size() + 1, path.getStateCount());
  for (const MotionCertificate& certificate : certificates) {
    EXPECT_EQ(certificate.verdict, Verdict::Free);
    EXPECT_EQ(certificate.freeUntil, 1.0);
  }
  og::PathGeometric fine(path);
  fine.interpolate(20000);
  EXPECT_LT(space_->distance(fine.getStates().front(), from_.get()), 1e-9);
  EXPECT_LT(space_->distance(fine.getStates().back(), to_.get()), 1e-9);
  double least = std::numeric_limits<double>::infinity();
  for (const ob::State* state : fine.getStates()) {
    const std::vector<double> q = configurationOf(state);
    ASSERT_FALSE(touches(q));
    if (std::abs(q[0]) < 0.5) least = std::min(least, clearanceAt(q));
  }
  // It went through the hole, of which no point is farther from the rim.
  EXPECT_LT(least, kHole);
}

}  // namespace
}  // namespace swept::test
