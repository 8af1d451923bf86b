// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "../core/mesh_samples.hpp"
#include "version_arms.hpp"

/// Levers about axes that are almost -z, as CAD exports have them, against formulas.
namespace swept {
namespace {

using Eigen::Vector3d;
using test::uniform;

constexpr double kBall = 0.25;  // m

std::string digits(const Vector3d& v) {
  std::array<char, 96> text;
  (void)std::snprintf(text.data(), text.size(), "%.17g %.17g %.17g", v.x(), v.y(), v.z());
  return text.data();
}

/// A ball at `end` that turns about `axis`, a planar joint's or a revolute one's.
std::shared_ptr<const Robot> lever(const std::string& type, const Vector3d& axis,
                                   const Vector3d& end) {
  const std::string rest = "<axis xyz='" + digits(axis) + "'/>" +
                           "<limit lower='-7' upper='7' effort='1' velocity='1'/>";
  return Robot::parse("<robot name='lever'>" + test::urdfLink("base", {}) +
                          test::urdfLink("arm", {{test::sphere(kBall), end}}) +
                          test::urdfJoint("turn", type, "base", "arm", rest) + "</robot>",
                      "lever.urdf");
}

struct Tally {
  int free = 0;
  int collisions = 0;
};

/// A ball beside the lever's way, somewhere on it, `gap` m away from touching or, less than
/// zero, inside.
void expectRight(const std::string& type, std::mt19937& random, double tilt, double gap,
                 Tally& tally) {
  const double around = uniform(random, -4.0, 4.0);
  const Vector3d axis =
      Vector3d(tilt * std::cos(around), tilt * std::sin(around), -1.0).normalized();
  const Vector3d end(0.125 * std::round(uniform(random, -16, 16)), 4.0, 0.5);
  const Checker empty(lever(type, axis, end), "all", std::make_shared<const World>());
  std::vector<double> from(static_cast<std::size_t>(empty.dimension()), 0.0);
  std::vector<double> to = from;
  from.back() = uniform(random, -1.0, 0.0);
  to.back() = from.back() + uniform(random, 0.2, 2.0);
  const double meeting = from.back() + uniform(random, 0.1, 0.9) * (to.back() - from.back());
  const Vector3d there = Eigen::AngleAxisd(meeting, axis) * end;
  // The way is a circle about the axis: no point of it is nearer to what is beside it outward.
  const double slope = uniform(random, -1.5, 1.5);
  const Vector3d outward = (there - axis.dot(there) * axis).normalized();
  const Vector3d beside = std::cos(slope) * outward + std::sin(slope) * axis;
  World world;
  world.add("ball", makeSphere(kBall),
            Eigen::Isometry3d(Eigen::Translation3d(there + (2.0 * kBall + gap) * beside)));
  const Checker checker = empty.withWorld(std::make_shared<const World>(world));
  Workspace workspace(checker);
  const Verdict verdict = checker.certifyMotion(from, to, workspace).verdict;
  ASSERT_NE(verdict, gap > 0.0 ? Verdict::Collision : Verdict::Free)
      << type << ", axis " << digits(axis) << ", gap " << gap << " m";
  tally.free += verdict == Verdict::Free ? 1 : 0;
  tally.collisions += verdict == Verdict::Collision ? 1 : 0;
}

class TiltedAxes : public testing::TestWithParam<const char*> {};

TEST_P(TiltedAxes, MotionsMeetWhatIsInTheWay) {
  std::mt19937 random(61);
  Tally tally;
  for (double tilt = 1e-3; tilt > 1e-17; tilt *= 0.9)
    for (const double size : {1e-3, 1e-4, 3e-5})
      for (const double sign : {-1.0, 1.0})
        expectRight(GetParam(), random, tilt, sign * size, tally);
  EXPECT_GT(tally.free, 50);
  EXPECT_GT(tally.collisions, 50);
}

INSTANTIATE_TEST_SUITE_P(Joints, TiltedAxes, testing::Values("revolute", "continuous", "planar"));

}  // namespace
}  // namespace swept
