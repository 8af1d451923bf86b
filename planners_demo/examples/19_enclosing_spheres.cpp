// SPDX-License-Identifier: BSD-3-Clause
// Spheres that contain a body, for a planner that checks spheres alone; and spheres made by hand,
// judged.
#include <iostream>
#include <vector>

#include "swept/core/enclosing_spheres.hpp"

namespace {

/// A gripper: a palm and two fingers.
std::vector<swept::PosedShape> gripper() {
  std::vector<swept::PosedShape> body{{swept::Box{{0.02, 0.1, 0.03}}}};
  for (const double side : {-1.0, 1.0}) {
    swept::PosedShape finger{swept::Box{{0.06, 0.01, 0.015}}};
    finger.body_from_shape.translation() = Eigen::Vector3d(0.08, side * 0.08, 0.0);
    body.push_back(finger);
  }
  return body;
}

}  // namespace

int main() {
  const std::vector<swept::PosedShape> body = gripper();

  // Someone's guess: all radii have to grow by `upper` so that the spheres contain the gripper.
  const std::vector<swept::EnclosingSphere> guess{
      {{0.0, -0.05, 0.0}, 0.05}, {{0.0, 0.05, 0.0}, 0.05}, {{0.1, 0.0, 0.0}, 0.1}};
  const swept::OutsideSpheres outside = swept::outsideSpheres(body, guess);
  std::cout << "guessed spheres leave out up to " << outside.upper << " m, at ["
            << outside.point.transpose() << "]\n";

  // Proven: at most 12 spheres that contain it.
  swept::EnclosingSpheresSearch search(body);
  const swept::EnclosingSpheres found = search.atMost(12);
  const swept::SphereExcess excess = swept::sphereExcess(body, found.spheres);
  std::cout << found.spheres.size() << " spheres contain it; they reach " << excess.largest
            << " m beyond it at most, " << excess.mean << " m in the mean\n";
  for (const swept::EnclosingSphere& sphere : found.spheres)
    std::cout << "  [" << sphere.center.transpose() << "] radius " << sphere.radius << " m\n";

  const bool judged = outside.lower > 0.01 && outside.upper < outside.lower + 1e-4;
  return judged && found.spheres.size() <= 12 && excess.largest < 0.03 ? 0 : 1;
}
