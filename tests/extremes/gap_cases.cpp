// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

namespace extremes {

namespace {

PairCase gapOf(int exponent) {
  return {"gap or depth 1e" + std::to_string(exponent) + " m", "ordinary", 4.0,
          [exponent](Random& random, int i) {
            Wanted wanted;
            wanted.gap = std::pow(10.0, exponent);
            return drawEither(random, wanted, i);
          }};
}

double eighths(Random& random) {
  return 0.125 * (1 + random.below(16));
}

/// Boxes whose sizes are eighths, or meshes of them, side by side: where they touch is a double.
Sample touchingBoxes(Random& random, int i) {
  const auto draw = [&] { return Vector3d(eighths(random), eighths(random), eighths(random)); };
  const Vector3d halfA = draw();
  const Vector3d halfB = draw();
  const Matrix3d turn = random.permutation();
  const Vector3d reach = halfA + turn.cwiseAbs() * halfB;
  Vector3d translation;
  for (int k = 0; k < 3; ++k) translation[k] = 0.125 * random.below(16) * reach[k] / 16.0;
  const int axis = random.below(3);
  // A double on, a double back, or neither.
  const double to = (i % 3 - 1) * std::numeric_limits<double>::infinity();
  translation[axis] = i % 3 == 1 ? reach[axis] : std::nextafter(reach[axis], to);
  translation[axis] *= random.sign();
  const auto solid = [&](const Vector3d& half) {
    return random.chance(0.5) ? boxOf(half) : boxMeshOf(half);
  };
  Solid a = solid(halfA);
  Solid b = solid(halfB);
  return alignedBoxes(std::move(a), halfA, std::move(b), halfB, turn, translation);
}

/// Balls whose centres are as far apart as the hypotenuse of 3, 4 and 5 eighths.
Sample touchingBalls(Random& random, int i) {
  const double scale = 0.125 * (1 + random.below(8));
  const double radiusA = scale * (1 + random.below(4));
  const double radiusB = 5.0 * scale - radiusA;
  Vector3d translation = random.permutation() * Vector3d(3.0 * scale, 4.0 * scale, 0.0);
  const double to = (i % 3 - 1) * std::numeric_limits<double>::infinity();
  const double radius = i % 3 == 1 ? radiusB : std::nextafter(radiusB, to);
  Sample sample{sphereOf(radiusA), sphereOf(radius)};
  sample.pose.translation() = translation;
  const Real gap = Real(5) * scale - radiusA - radius;
  sample.truth = {gap, gap};
  return sample;
}

}  // namespace

std::vector<PairCase> gapCases() {
  std::vector<PairCase> cases;
  for (const int exponent : {-3, -6, -9, -12, -15}) cases.push_back(gapOf(exponent));
  cases.push_back({"touch to the last bit", "ordinary", 4.0, [](Random& random, int i) {
                     return random.chance(0.7) ? touchingBoxes(random, i)
                                               : touchingBalls(random, i);
                   }});
  return cases;
}

}  // namespace extremes
