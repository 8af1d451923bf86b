// SPDX-License-Identifier: BSD-3-Clause
// What no motion can be made of.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "swept/core/continuous/motions.hpp"

namespace {

using namespace swept;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

TEST(MotionPart, RefusesWhatIsNoPart) {
  const UniformMotion whole = UniformMotion::still(Isometry3d::Identity());
  const double nan = std::nan("");
  for (const auto& [from, to] : {std::pair(-0.1, 0.5), std::pair(0.5, 1.1), std::pair(0.6, 0.5),
                                 std::pair(nan, 0.5), std::pair(0.5, nan)}) {
    EXPECT_THROW(MotionPart(whole, from, to), std::invalid_argument) << from << ' ' << to;
  }
  EXPECT_NO_THROW(MotionPart(whole, 0.5, 0.5));
}

TEST(Motions, RefuseWhatIsNotFiniteOrNoRotation) {
  const Isometry3d good = Isometry3d::Identity();
  const Vector3d zero = Vector3d::Zero();
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Isometry3d moved = good;
    moved.translation().y() = bad;
    Isometry3d turned = good;
    turned.linear()(1, 2) = bad;
    const Vector3d vector(0.0, bad, 0.0);
    for (const Isometry3d& pose : {moved, turned}) {
      EXPECT_THROW(UniformMotion::still(pose), std::invalid_argument);
      EXPECT_THROW(UniformMotion::translation(pose, zero), std::invalid_argument);
      EXPECT_THROW(UniformMotion::interpolation(pose, good), std::invalid_argument);
      EXPECT_THROW(UniformMotion::interpolation(good, pose), std::invalid_argument);
      EXPECT_THROW(UniformMotion::screw(pose, good), std::invalid_argument);
      EXPECT_THROW(UniformMotion::screw(good, pose), std::invalid_argument);
      EXPECT_THROW(UniformMotion::turning(pose, zero, zero), std::invalid_argument);
    }
    EXPECT_THROW(UniformMotion::translation(good, vector), std::invalid_argument);
    EXPECT_THROW(UniformMotion::interpolation(good, good, vector), std::invalid_argument);
    EXPECT_THROW(UniformMotion::turning(good, vector, zero), std::invalid_argument);
    EXPECT_THROW(UniformMotion::turning(good, zero, vector), std::invalid_argument);
    EXPECT_THROW(UniformMotion::turning(good, zero, zero, vector), std::invalid_argument);
    const std::vector<ControlPose> control{
        {zero, zero}, {vector, zero}, {zero, zero}, {zero, zero}};
    const std::vector<ControlPose> spun{{zero, zero}, {zero, vector}, {zero, zero}, {zero, zero}};
    for (const auto& c : {control, spun}) {
      EXPECT_THROW(SplineMotion::bezier(Matrix3d::Identity(), c), std::invalid_argument);
      EXPECT_THROW(SplineMotion::uniformCubic(Matrix3d::Identity(), c), std::invalid_argument);
    }
  }
  for (const Matrix3d& bad :
       {Matrix3d(1.1 * Matrix3d::Identity()), Matrix3d(Vector3d(1.0, 1.0, -1.0).asDiagonal()),
        Matrix3d(Matrix3d::Zero())}) {
    Isometry3d pose = good;
    pose.linear() = bad;
    EXPECT_THROW(UniformMotion::still(pose), std::invalid_argument);
    EXPECT_THROW(UniformMotion::interpolation(good, pose), std::invalid_argument);
    const std::vector<ControlPose> control(4, ControlPose{zero, zero});
    EXPECT_THROW(SplineMotion::bezier(bad, control), std::invalid_argument);
    EXPECT_THROW(SplineMotion::uniformCubic(bad, control), std::invalid_argument);
  }
}

TEST(Motions, SayWhatIsWrong) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() *= 1.1;
  try {
    UniformMotion::still(pose);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("rotation"), std::string::npos) << error.what();
  }
  const std::vector<ControlPose> one(1, ControlPose{Vector3d::Zero(), Vector3d::Zero()});
  try {
    SplineMotion::bezier(Matrix3d::Identity(), one);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find('1'), std::string::npos) << error.what();
  }
}

TEST(Motions, TakeAsManyControlPosesAsTheySay) {
  const auto control = [](std::size_t count) {
    return std::vector<ControlPose>(count, ControlPose{Vector3d::Zero(), Vector3d::Zero()});
  };
  const Matrix3d turn = Matrix3d::Identity();
  for (const std::size_t bad : {0, 1, 9, 20}) {
    EXPECT_THROW(SplineMotion::bezier(turn, control(bad)), std::invalid_argument) << bad;
  }
  for (const std::size_t good : {2, 8}) EXPECT_NO_THROW(SplineMotion::bezier(turn, control(good)));
  for (const std::size_t bad : {0, 3}) {
    EXPECT_THROW(SplineMotion::uniformCubic(turn, control(bad)), std::invalid_argument) << bad;
  }
  for (const std::size_t good : {4, 5, 40}) {
    EXPECT_NO_THROW(SplineMotion::uniformCubic(turn, control(good)));
  }
}

}  // namespace
