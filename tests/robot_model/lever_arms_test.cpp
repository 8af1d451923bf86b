// SPDX-License-Identifier: BSD-3-Clause
// Of axes at an angle of 1e-8 the cosine is 1 in doubles. With the sine taken from it a point 1 m
// beside the one axis kept its height along the other, and arms were short by up to 7e-9 m.
#include "kinematics/lever_arms.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "kinematics/motion_model.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using swept::detail::KinematicModel;
using swept::detail::LeverArms;
using swept::detail::MovingBody;

void append(KinematicModel& model, const Vector3d& axis, const Isometry3d& parent_from_joint) {
  MovingBody body;
  body.parent = static_cast<int>(model.bodies.size()) - 1;
  body.type = swept::JointType::Continuous;
  body.parent_from_joint = parent_from_joint;
  body.axis = axis;
  body.variable = model.dimension++;
  model.cyclic.push_back(true);
  model.bodies.push_back(body);
}

/// About x, then about z, then `height` above that about an axis turned by `tilt` about x.
KinematicModel tilted(double height, double tilt) {
  KinematicModel model;
  model.bodies.emplace_back();
  append(model, Vector3d::UnitX(), Isometry3d::Identity());
  append(model, Vector3d::UnitZ(), Isometry3d::Identity());
  const Eigen::AngleAxisd turn(tilt, Vector3d::UnitX());
  append(model, Vector3d::UnitZ(), Eigen::Translation3d(0.0, 0.0, height) * turn);
  return model;
}

TEST(LeverArms, OfNearlyParallelAxesReachWhereTheTiltLifts) {
  for (const double height : {1.0, 3.0}) {
    for (const double beside : {0.5, 1.0}) {
      for (const double tilt : {1e-9, 3e-9, 1e-8, 1e-7, 1e-5}) {
        const KinematicModel model = tilted(height, tilt);
        const LeverArms levers = swept::detail::leverArms(model, 3, {0.0, beside, 0.0}, 0.0);
        // Where all joints are at zero.
        const long double y = beside * std::cos(static_cast<long double>(tilt));
        const long double z = height + beside * std::sin(static_cast<long double>(tilt));
        const long double fromFirst = std::hypot(y, z);
        ASSERT_EQ(levers.arms.size(), 3u);
        EXPECT_GE(levers.arms[0], fromFirst)
            << "tilt " << tilt << ", short by " << fromFirst - levers.arms[0] << " m";
        EXPECT_GE(levers.span, fromFirst) << "tilt " << tilt;
        EXPECT_LE(levers.arms[0], fromFirst * (1.0L + 1e-9L)) << "tilt " << tilt;
      }
    }
  }
}

}  // namespace
