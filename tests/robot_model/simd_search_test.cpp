// SPDX-License-Identifier: BSD-3-Clause
#include "simd/search/simd_search.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "simd/kernels/simd_motion.hpp"
#include "simd_robots.hpp"
#include "simd_targets.hpp"

namespace swept::simd_test {
namespace {

using detail::CheckerModel;
using detail::RobotGeometry;
using enum JointType;

/// Knows nothing.
class Silent final : public detail::ExactOracle {
 public:
  bool isContact(const detail::SimdContact&, double) override { return false; }
  bool isInside(std::uint32_t, std::int32_t, double) override { return false; }
  detail::ExactAnswer look(std::uint32_t, double, double) override { return {}; }
  bool staysApart(std::uint32_t, double, double, const detail::MovingPoint&, double) override {
    return false;
  }
};

/// A random robot, a motion, and two balls of which the nearest approach is known: of two bodies,
/// or of one and the world. The radii are chosen after it.
class Approach {
 public:
  Approach(Random& random, int round, bool self) : self_(self) {
    ChainOptions options;
    options.types = typesOf(random, round);
    options.link = random.scale(1e-2, 1e1);
    options.branches = random.chance(0.5) ? 0.5 : 0.0;
    model_ = robotOf(random, options);
    const double turn = random.scale(0.05, 4.0);
    from_ = configuration(random, model_.kinematics, turn, options.link);
    to_ = configuration(random, model_.kinematics, turn, options.link);
    addPair(random, options.link);
    if (!model_.pairs.empty()) findNearest();
  }

  /// m, between the centres, at `nearestAt`.
  Real nearest() const { return nearest_; }
  Real nearestAt() const { return nearestAt_; }
  Real farthest() const { return farthest_; }
  bool paired() const { return !model_.pairs.empty(); }

  /// Whether the search proves the motion with radii that add up to `sum` (m). Nothing where it
  /// says nothing.
  std::optional<bool> isProven(double sum) {
    const detail::GeometryPair& pair = model_.pairs.front();
    changeGeometry(model_, [&](std::vector<RobotGeometry>& geometry) {
      setRadius(geometry[pair.a], 0.5 * sum);
      if (self_) setRadius(geometry[pair.b], 0.5 * sum);
    });
    if (!self_) model_.worldGeometry = {worldGeometry(Sphere{0.5 * sum}, obstacle_)};
    const detail::SimdModel lanes = simdModelOf(model_);
    detail::SimdScratch scratch(lanes);
    StraightSimdMotion motion(lanes, model_.kinematics, from_, to_, scratch);
    Silent silent;
    const detail::ConfirmedContacts contacts(MotionQuery::FirstContact);
    Effort effort;
    detail::ProofWork work;
    detail::SimdTier(motion.get(), silent, contacts, std::numeric_limits<int>::max(), scratch,
                     effort)
        .prove(work);
    if (work.everything) return std::nullopt;
    return work.isProven();
  }

 private:
  static std::vector<JointType> typesOf(Random& random, int round) {
    if (round % 5 == 0) return {Floating, Revolute, Prismatic, Revolute};
    if (round % 5 == 1) return {Planar, Revolute, Prismatic, Revolute};
    std::vector<JointType> types(2 + random.below(9));
    for (JointType& type : types) type = std::array{Revolute, Revolute, Prismatic}[random.below(3)];
    return types;
  }

  void addPair(Random& random, double size) {
    const int count = static_cast<int>(model_.robotGeometry.size());
    detail::GeometryPair pair;
    pair.self = self_;
    pair.a = random.below(count);
    if (self_) {
      pair.b = random.below(count);
      if (pair.a > pair.b) std::swap(pair.a, pair.b);
      const int bodyA = bodyOf(pair.a);
      const int bodyB = bodyOf(pair.b);
      if (bodyA == bodyB) return;
      pair.reference = commonAncestor(model_.kinematics, bodyA, bodyB);
    } else {
      obstacle_ = random.pose(3.0 * size);
    }
    model_.pairs.push_back(pair);
  }

  int bodyOf(int geometry) const { return model_.robotGeometry[geometry].body; }

  Vector placed(int geometry, int reference, Real t) const {
    const RobotGeometry& piece = model_.robotGeometry[geometry];
    const Vector center =
        (piece.body_from_shape.cast<Real>() * piece.cover->nodes.front().ball.center.cast<Real>());
    return exactPoint(model_.kinematics, from_, to_, t, piece.body, reference, center);
  }

  Real distanceAt(Real t) const {
    const detail::GeometryPair& pair = model_.pairs.front();
    const int reference = self_ ? pair.reference : 0;
    const Vector other =
        self_ ? placed(pair.b, reference, t) : Vector(obstacle_.translation().cast<Real>());
    return (placed(pair.a, reference, t) - other).norm();
  }

  void findNearest() {
    constexpr int kSamples = 400;
    for (int i = 0; i <= kSamples; ++i) {
      const Real t = static_cast<Real>(i) / kSamples;
      const Real distance = distanceAt(t);
      farthest_ = std::max(farthest_, distance);
      if (!(distance < nearest_)) continue;
      nearest_ = distance;
      nearestAt_ = t;
    }
    for (Real step = 0.5L / kSamples; step > 1e-9L; step *= 0.7L) {
      for (const Real t : {nearestAt_ - step, nearestAt_ + step}) {
        if (t < 0 || t > 1 || !(distanceAt(t) < nearest_)) continue;
        nearest_ = distanceAt(t);
        nearestAt_ = t;
      }
    }
  }

  static void setRadius(RobotGeometry& geometry, double radius) {
    auto cover = std::make_shared<SphereCover>(*geometry.cover);
    cover->nodes.front().ball.radius = static_cast<float>(radius);
    geometry.cover = cover;
    geometry.radius = radius;
  }

  bool self_;
  CheckerModel model_;
  Eigen::Isometry3d obstacle_ = Eigen::Isometry3d::Identity();
  std::vector<double> from_, to_;
  Real nearest_ = std::numeric_limits<Real>::infinity();
  Real nearestAt_ = 0;
  Real farthest_ = 0;
};

struct Tally {
  int asked = 0;
  int inside = 0;   ///< nearest away from both ends of the motion
  int gapFree = 0;  ///< proven where there is room
  int tightFree = 0;

  std::string text() const {
    return std::to_string(asked) + " asked, " + std::to_string(gapFree) +
           " free of half the distance, " + std::to_string(tightFree) + " of nearly all";
  }
};

void tryBoth(bool self, Tally& tally) {
  Random random(self ? 71 : 72);
  constexpr int kRounds = 800;
  for (int round = 0; round < kRounds; ++round) {
    Approach approach(random, round, self);
    if (!approach.paired() || !(approach.farthest() > 1.01L * approach.nearest())) continue;
    const auto nearest = static_cast<double>(approach.nearest());
    const double depth = nearest * random.scale(1e-6, 1e-3);
    const auto touching = approach.isProven(nearest + depth);
    if (!touching) continue;
    ASSERT_FALSE(*touching) << "round " << round << ": at "
                            << static_cast<double>(approach.nearestAt()) << " by " << depth;
    ++tally.asked;
    tally.inside += approach.nearestAt() > 0 && approach.nearestAt() < 1 ? 1 : 0;
    tally.gapFree += *approach.isProven(0.5 * nearest) ? 1 : 0;
    tally.tightFree += *approach.isProven(0.95 * nearest) ? 1 : 0;
  }
  EXPECT_GT(tally.asked, kRounds / 3);
  EXPECT_GT(tally.inside, tally.asked / 5);
  EXPECT_GT(tally.gapFree, tally.asked * 3 / 4);
  EXPECT_GT(tally.tightFree, tally.asked / 3);
}

/// Two balls of a robot that touch only where they are nearest are never proven apart.
TEST(SimdSearch, LinksThatTouchAreNotProvenApart) {
  tallyOnAllTargets<Tally>([](Tally& tally) { tryBoth(true, tally); });
}

TEST(SimdSearch, ALinkThatTouchesAnObstacleIsNotProvenApart) {
  tallyOnAllTargets<Tally>([](Tally& tally) { tryBoth(false, tally); });
}

}  // namespace
}  // namespace swept::simd_test
