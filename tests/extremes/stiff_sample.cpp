// SPDX-License-Identifier: BSD-3-Clause
#include "stiff_sample.hpp"

#include <cstdio>

namespace extremes {

namespace {

constexpr double kSlide = 20.0;  // m

/// To the last bit.
std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string triple(const Vector3d& v) {
  return number(v.x()) + " " + number(v.y()) + " " + number(v.z());
}

}  // namespace

std::shared_ptr<const swept::Robot> chainWithBall(const std::vector<ChainJoint>& joints,
                                                  const Vector3d& tip, double radius) {
  std::string text = "<robot name='chain'><link name='link0'/>";
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const ChainJoint& joint = joints[i];
    const std::string child = std::to_string(i + 1);
    // What a slide reaches is part of the bounds on rounding.
    const double limit = joint.type == "prismatic" ? kSlide : joint.limit;
    text += "<link name='link" + child + "'>";
    if (i + 1 == joints.size()) {
      text += "<collision><origin xyz='" + triple(tip) + "'/><geometry><sphere radius='" +
              number(radius) + "'/></geometry></collision>";
    }
    text += "</link><joint name='joint" + child + "' type='" + joint.type + "'><parent link='link" +
            std::to_string(i) + "'/><child link='link" + child + "'/><origin xyz='" +
            triple(joint.origin) + "'/><axis xyz='" + triple(joint.axis) + "'/><limit lower='" +
            number(-limit) + "' upper='" + number(limit) + "' effort='1' velocity='1'/></joint>";
  }
  return swept::Robot::parse(text + "</robot>", "chain.urdf");
}

std::shared_ptr<const swept::Checker> checkerOf(std::shared_ptr<const swept::Robot> robot,
                                                swept::World world, double tolerance) {
  swept::CheckerOptions options;
  options.tolerance = tolerance;
  return std::make_shared<swept::Checker>(
      std::move(robot), "all", std::make_shared<const swept::World>(std::move(world)), options);
}

}  // namespace extremes
