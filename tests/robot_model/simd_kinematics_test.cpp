// SPDX-License-Identifier: BSD-3-Clause
#include "simd/kernels/simd_kinematics.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "simd/kernels/simd_motion.hpp"
#include "simd_robots.hpp"
#include "simd_targets.hpp"

namespace swept::simd_test {
namespace {

using detail::CheckerModel;
using detail::kLanes;
using detail::SimdModel;
using detail::SimdScratch;
using enum JointType;

std::vector<JointType> typesOf(Random& random, int round) {
  switch (round % 8) {
    case 0:
      return {Revolute};
    case 1:
      return std::vector(7, Revolute);
    case 2:
      return std::vector(50, Revolute);
    case 3:
      return {Planar, Revolute, Continuous, Prismatic, Revolute};
    case 4:
      return {Floating, Revolute, Revolute, Prismatic};
    case 5:
      return {Floating};
    case 6:
      return {Prismatic, Planar, Prismatic, Continuous, Prismatic};
    default: {
      std::vector<JointType> types(1 + random.below(20));
      for (JointType& type : types)
        type = std::array{Revolute, Continuous, Prismatic}[random.below(3)];
      return types;
    }
  }
}

ChainOptions optionsOf(Random& random, int round) {
  ChainOptions options;
  options.types = typesOf(random, round);
  options.link = random.scale(1e-3, 1e2);
  options.branches = random.chance(0.3) ? 0.3 : 0.0;
  options.straight = random.chance(0.3);
  return options;
}

/// The parts of the error of one ball centre in one lane.
struct Errors {
  double position = 0.0;  ///< m
  double half = 0.0;      ///< m, of half the way
};

class Robots {
 public:
  explicit Robots(unsigned seed) : random_(seed) {}

  /// A robot with a motion that the tier takes; false if it does not.
  bool make(int round) {
    model_ = robotOf(random_, optionsOf(random_, round));
    lanes_ = simdModelOf(model_);
    EXPECT_TRUE(lanes_.usable);
    scratch_.emplace(lanes_);
    const double turn = random_.scale(0.01, 60.0);
    const double slide = random_.scale(1e-3, 1e3);
    from_ = configuration(random_, model_.kinematics, turn, slide);
    to_ = configuration(random_, model_.kinematics, turn, slide);
    if (!StraightSimdMotion(lanes_, model_.kinematics, from_, to_, *scratch_).compile())
      return false;
    for (int lane = 0; lane < kLanes; ++lane) {
      // The first and the last lane are at the ends of the motion.
      const double time = lane == 0 ? 0.0 : lane == kLanes - 1 ? 1.0 : random_.uniform(0.0, 1.0);
      scratch_->block.time.lane[lane] = static_cast<float>(time);
      scratch_->block.half.lane[lane] = static_cast<float>(random_.scale(1e-4, 0.5));
    }
    return true;
  }

  void place() {
    scratch_->block.mode = detail::SimdMode::Motion;
    detail::placeBodies(lanes_, scratch_->motion, lanes_.allBodies, scratch_->block);
  }

  int bodies() const { return static_cast<int>(lanes_.bodies.size()); }
  double bound() const { return static_cast<double>(scratch_->rounding); }

  Errors errorsOf(int body, int lane) const {
    const auto& block = scratch_->block;
    const Vector center = centerOf(lanes_, body, lanes_.nodes[lanes_.rootOfBody[body]]);
    const auto t = static_cast<Real>(block.time.lane[lane]);
    const auto half = static_cast<Real>(block.half.lane[lane]);
    const auto at = [&](Real time) {
      return exactPoint(model_.kinematics, from_, to_, time, body, 0, center);
    };
    Real spins = 1;
    for (const auto& motion : scratch_->motion) spins += static_cast<Real>(motion.spin);
    const Real step = 1e-5L / spins;
    const Vector way = half * (at(t + step) - at(t - step)) / (2 * step);
    const Vector exact = at(t);
    Vector position;
    Vector moved;
    for (int i = 0; i < 3; ++i) {
      position[i] = static_cast<Real>(block.roots[body].at[i].lane[lane]);
      moved[i] = static_cast<Real>(block.roots[body].by[i].lane[lane]);
    }
    return {static_cast<double>((position - exact).norm()),
            static_cast<double>((moved - way).norm())};
  }

 private:
  Random random_;
  CheckerModel model_;
  SimdModel lanes_;
  std::optional<SimdScratch> scratch_;
  std::vector<double> from_, to_;
};

/// The errors of where a ball's centre is and of the half way that it moves are together within the
/// motion's rounding, for the longest sub-intervals and at the ends of motions.
TEST(SimdKinematics, PositionsAndVelocitiesAreWithinTheRoundingBound) {
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    Robots robots(11);
    double worst = 0.0;
    double worstPosition = 0.0;
    int taken = 0;
    constexpr int kRounds = 240;
    for (int round = 0; round < kRounds; ++round) {
      if (!robots.make(round)) continue;
      ++taken;
      robots.place();
      for (int body = 1; body < robots.bodies(); ++body) {
        for (int lane = 0; lane < kLanes; ++lane) {
          const Errors errors = robots.errorsOf(body, lane);
          const double ratio = (errors.position + errors.half) / robots.bound();
          ASSERT_LE(ratio, 1.0) << "round " << round << ", body " << body << ", lane " << lane;
          worst = std::max(worst, ratio);
          worstPosition = std::max(worstPosition, errors.position / robots.bound());
        }
      }
    }
    const std::string name = hwy::TargetName(target);
    RecordProperty("error_over_bound_" + name, std::to_string(worst));
    RecordProperty("position_over_bound_" + name, std::to_string(worstPosition));
    EXPECT_GT(worst, 1e-3) << "the bound is idle";
    EXPECT_GT(taken, kRounds * 6 / 10) << "too many motions are refused to tell anything";
  }
}

/// One joint about z at the origin with a ball at (1, 0, 0): its place is the cosine and the sine.
class Turntable {
 public:
  Turntable() {
    model_.kinematics.bodies.resize(2);
    detail::MovingBody& body = model_.kinematics.bodies[1];
    body.parent = 0;
    body.type = Revolute;
    body.variable = 0;
    body.lower = -1e3;
    body.upper = 1e3;
    model_.kinematics.dimension = 1;
    model_.kinematics.cyclic.push_back(0);
    auto cover = std::make_shared<SphereCover>();
    SphereCover::Node node{};
    node.ball = {Eigen::Vector3f::UnitX(), 0.1F};
    cover->nodes.push_back(node);
    detail::RobotGeometry geometry;
    geometry.body = 1;
    geometry.shape = Sphere{0.1};
    geometry.body_from_shape.setIdentity();
    geometry.cover = cover;
    geometry.levers = detail::leverArms(model_.kinematics, 1, Eigen::Vector3d::UnitX(), 0.1);
    model_.robotGeometry = detail::SharedArray(std::vector<detail::RobotGeometry>{geometry});
    lanes_ = simdModelOf(model_);
    scratch_.emplace(lanes_);
  }

  /// The larger of the errors of both, over the lanes.
  double errorAt(const std::array<float, kLanes>& angles) {
    auto& block = scratch_->block;
    block.mode = detail::SimdMode::States;
    block.given = true;
    std::ranges::copy(angles, block.angle[1].lane);
    detail::placeBodies(lanes_, scratch_->motion, lanes_.allBodies, block);
    Real worst = 0;
    for (int lane = 0; lane < kLanes; ++lane) {
      const auto angle = static_cast<Real>(angles[lane]);
      const auto& at = block.roots[1].at;
      worst = std::max(worst, std::abs(static_cast<Real>(at[0].lane[lane]) - std::cos(angle)));
      worst = std::max(worst, std::abs(static_cast<Real>(at[1].lane[lane]) - std::sin(angle)));
    }
    return static_cast<double>(worst);
  }

 private:
  CheckerModel model_;
  SimdModel lanes_;
  std::optional<SimdScratch> scratch_;
};

TEST(SimdKinematics, SinesAndCosinesAreWithinTheirBound) {
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    Turntable table;
    Random random(12);
    double worst = 0.0;
    for (int i = 0; i < 40000; ++i) {
      std::array<float, kLanes> angles{};
      for (float& angle : angles) {
        // Anywhere; at where the quarter changes; and tiny ones.
        const double quarter = std::numbers::pi / 4 * (random.below(327) - 163);
        const double near = quarter + random.uniform(-1.0, 1.0) * random.scale(1e-7, 1e-2);
        const double tiny = random.uniform(-1.0, 1.0) * random.scale(1e-30, 1.0);
        angle = static_cast<float>(std::array{random.uniform(-128.0, 128.0),
                                              std::clamp(near, -128.0, 128.0), tiny}[i % 3]);
      }
      worst = std::max(worst, table.errorAt(angles));
    }
    RecordProperty("sine_error_over_bound_" + std::string(hwy::TargetName(target)),
                   std::to_string(worst / 0x1p-22));
    EXPECT_LE(worst, 0x1p-22);
    EXPECT_GT(worst, 0x1p-26) << "no rounding was met";
  }
}

/// What single precision cannot bound is left to the exact tier.
TEST(SimdKinematics, FarTurnsAndWhatIsNoNumberAreRefused) {
  Random random(13);
  ChainOptions options;
  options.types = {Planar, Revolute, Prismatic};
  options.mimics = 0.0;
  const CheckerModel model = robotOf(random, options);
  const SimdModel lanes = simdModelOf(model);
  SimdScratch scratch(lanes);
  const auto takes = [&](const std::vector<double>& from, const std::vector<double>& to) {
    return StraightSimdMotion(lanes, model.kinematics, from, to, scratch).compile();
  };
  const std::vector<double> good{0.1, 0.2, 0.3, 0.4, 0.1};
  EXPECT_TRUE(takes(good, good));
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
      std::vector<double> bad = good;
      bad[i] = value;
      // An angle modulo whole turns is as good as any.
      if ((i == 2 || i == 3) && value == 1e300) continue;
      EXPECT_FALSE(takes(good, bad)) << i << " " << value;
      EXPECT_FALSE(takes(bad, good)) << i << " " << value;
      EXPECT_FALSE(takes(bad, bad)) << i << " " << value;
    }
  }
  std::vector<double> far = good;
  far[3] = 150.0;
  EXPECT_FALSE(takes(good, far));
  EXPECT_TRUE(takes(far, far));
}

}  // namespace
}  // namespace swept::simd_test
