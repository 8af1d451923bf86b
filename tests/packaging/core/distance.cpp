// SPDX-License-Identifier: BSD-3-Clause
// Answers of the installed core against known ones. Exit code 1 and a line for each that is wrong.
#include "swept/core/distance.hpp"

#include <cmath>
#include <iostream>
#include <vector>

#include "swept/core/traversal/mesh_distance.hpp"

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
  if (holds) return;
  ++failures;
  std::cout << "wrong: " << what << '\n';
}

/// Compiled in the library.
void testShapes() {
  Eigen::Isometry3d box_from_ball = Eigen::Isometry3d::Identity();
  box_from_ball.translation() << 3.0, 4.0, 0.0;
  const auto box = swept::makeBox({2.0, 2.0, 2.0});
  const auto ball = swept::makeSphere(0.5);
  const swept::DistanceResult d = swept::distance(box, ball, box_from_ball);
  const double exact = std::sqrt(2.0 * 2.0 + 3.0 * 3.0) - 0.5;
  expect(d.lower <= exact && exact <= d.upper + 1e-12, "the distance is in the interval");
  expect(d.upper - d.lower <= 1e-8, "the interval is short");
  expect(swept::collide(box, ball, Eigen::Isometry3d::Identity()) == swept::Contact::Touching,
         "a ball in a box touches it");
  std::cout << "box to ball: " << d.lower << " m\n";
}

swept::BvhModel<swept::Aabb> triangle(double z) {
  swept::BvhModel<swept::Aabb> model;
  model.begin();
  model.addTriangle({0.0, 0.0, z}, {1.0, 0.0, z}, {0.0, 1.0, z});
  model.end();
  return model;
}

/// Compiled here, with the flags of this program.
void testTemplates() {
  const auto low = triangle(0.0);
  const auto high = triangle(2.0);
  const auto d = swept::meshDistance(low, high, Eigen::Isometry3d::Identity());
  expect(d.lower <= 2.0 && d.lower >= 2.0 - 1e-9 && d.upper == 2.0, "two triangles 2 m apart");
}

}  // namespace

int main() {
  testShapes();
  testTemplates();
  return failures == 0 ? 0 : 1;
}
