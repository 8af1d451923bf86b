// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/axis_frame.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesh_samples.hpp"

namespace swept::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kRounding = 8.0 * std::numeric_limits<double>::epsilon();

void expectFrame(const Vector3d& direction, double length) {
  const Matrix3d frame = axisFrame(length * direction);
  ASSERT_LE((frame.transpose() * frame - Matrix3d::Identity()).cwiseAbs().maxCoeff(), kRounding)
      << direction.transpose() << " times " << length;
  ASSERT_GT(frame.determinant(), 0.0);
  ASSERT_LE((frame.col(2) - direction).cwiseAbs().maxCoeff(), kRounding)
      << direction.transpose() << " times " << length;
}

/// As near to z and -z as doubles come, where frames by quaternions turn into scales.
TEST(AxisFrame, IsARotationThatTakesZToTheAxis) {
  std::mt19937 random(1);
  for (int decade = 0; decade <= 320; ++decade) {
    for (int i = 0; i < 20; ++i) {
      const double tilt = std::pow(10.0, -decade) * uniform(random, 0.1, 1.0);
      const double around = uniform(random, -4.0, 4.0);
      for (const double up : {1.0, -1.0}) {
        expectFrame(
            Vector3d(tilt * std::cos(around), tilt * std::sin(around), up).stableNormalized(), 1.0);
      }
    }
  }
  for (int i = 0; i < 1000; ++i) expectFrame(unitVector(random), 1.0);
}

TEST(AxisFrame, LengthsOfAxesDoNotMatter) {
  std::mt19937 random(2);
  for (int decade = -305; decade <= 307; ++decade)
    expectFrame(unitVector(random), std::pow(10.0, decade));
  const double least = std::numeric_limits<double>::denorm_min();
  expectFrame(-Vector3d::UnitZ(), least);
  expectFrame(Vector3d(1.0, 1.0, -1.0).normalized(), std::sqrt(3.0) * least);
}

/// By the least angle: what lies across both z and the axis stays where it is.
TEST(AxisFrame, TurnsByTheLeastAngle) {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d axis = unitVector(random);
    const Vector3d across = Vector3d(-axis.y(), axis.x(), 0.0).normalized();
    ASSERT_LE((axisFrame(axis) * across - across).cwiseAbs().maxCoeff(), kRounding);
  }
  EXPECT_EQ(axisFrame(Vector3d::UnitZ()), Matrix3d::Identity());
  EXPECT_EQ(axisFrame(-Vector3d::UnitZ()), Matrix3d(Vector3d(1.0, -1.0, -1.0).asDiagonal()));
}

}  // namespace
}  // namespace swept::test
