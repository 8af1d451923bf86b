// SPDX-License-Identifier: BSD-3-Clause
#include "core/error_table_shapes.hpp"
#include "sample.hpp"

namespace extremes {

namespace {

using namespace error_table;

/// A solid, and how long the shortest way to its surface is from its centre.
struct Centred {
  Solid solid;
  Real reach;  ///< m, of the shortest half width
};

/// Symmetric about its centre: the way out of another such one is the least sum of half widths.
Centred drawCentred(Random& random, double size) {
  switch (random.below(5)) {
    case 0: {
      const double radius = size * random.uniform(0.2, 1.0);
      return {sphereOf(radius), radius};
    }
    case 1: {
      Solid solid = drawCapsule(random, size);
      return {solid, solid.body.radius};
    }
    case 2: {
      Solid solid = drawEllipsoid(random, size);
      return {solid, solid.body.size.minCoeff()};
    }
    case 3: {
      const Vector3d half = boxSizes(random, size);
      return {boxOf(half), half.minCoeff()};
    }
    default: {
      const Vector3d half = boxSizes(random, size);
      return {boxMeshOf(half), half.minCoeff()};
    }
  }
}

/// The same shape twice, in the same place, or turned about: the difference of a symmetric body
/// with itself is the body, twice as large.
Sample identical(Random& random, int) {
  const Centred one = drawCentred(random, random.decades(-3.0, 3.0));
  Sample sample{one.solid, one.solid};
  sample.truth = {-2 * one.reach, -2 * one.reach};
  return sample;
}

/// A ball about the centre of another body, far inside it or far around it.
Sample concentric(Random& random, int) {
  const Centred one = drawCentred(random, 1.0);
  const double radius = random.decades(-6.0, 6.0);
  Sample sample{one.solid, sphereOf(radius)};
  if (random.chance(0.5)) std::swap(sample.a, sample.b);
  const Real depth = one.reach + Real(radius);
  sample.truth = {-depth, -depth};
  return sample;
}

/// A small box or ball inside a box, or as far outside: the nearest wall tells.
Sample contained(Random& random, int i) {
  const Vector3d half = boxSizes(random, 1.0) + Vector3d::Constant(0.1);
  const bool mesh = random.chance(0.5);
  Vector3d place;
  for (int k = 0; k < 3; ++k) place[k] = 0.9 * random.uniform(-half[k], half[k]);
  const int axis = random.below(3);
  if (i % 2 == 0) place[axis] = random.sign() * half[axis] * random.uniform(1.1, 3.0);
  const double small = 0.01 * random.decades(-6.0, 0.0);
  Solid outer = mesh ? boxMeshOf(half) : boxOf(half);
  if (random.chance(0.5)) {
    const Vector3d inner = small * Vector3d(1.0, 0.5, 0.25);
    const Matrix3d turned = random.permutation();
    Solid innerBox = random.chance(0.5) ? boxMeshOf(inner) : boxOf(inner);
    return alignedBoxes(std::move(outer), half, std::move(innerBox), inner, turned, place);
  }
  Real gap = abs(Real(place[0])) - half[0];
  for (int k = 1; k < 3; ++k) gap = std::max(gap, Real(abs(Real(place[k])) - half[k]));
  Sample sample{std::move(outer), sphereOf(small)};
  sample.pose.translation() = place;
  sample.truth = {gap - small, gap - small};
  return sample;
}

/// Radii, sizes and gaps below what doubles hold in full.
Sample denormal(Random& random, int i) {
  const double tiny = random.decades(-322.0, -308.0);
  const Vector3d half(tiny, 2.0 * tiny, 4.0 * tiny);
  const bool apart = i % 2 == 0;
  const double reach = apart ? random.decades(-3.0, 1.0) : -0.5 * random.decades(-3.0, 0.0);
  const Vector3d box(1.0, 2.0, 3.0);
  if (random.chance(0.5)) {
    return alignedBoxes(boxOf(box), box, random.chance(0.5) ? boxOf(half) : boxMeshOf(half), half,
                        Matrix3d::Identity(), Vector3d(1.0 + reach, 0.0, 0.0));
  }
  Sample sample{boxOf(box), sphereOf(tiny)};
  sample.pose.translation().x() = 1.0 + reach;
  const Real gap = Real(sample.pose.translation().x()) - 1 - tiny;
  sample.truth = {gap, gap};
  return sample;
}

}  // namespace

std::vector<PairCase> nestedCases() {
  return {{"the same body twice", "ordinary", 4.0, identical, false},
          {"one centre", "ordinary", 4.0, concentric, false},
          {"deep inside", "ordinary", 4.0, contained, true, 120, 30.0},
          {"sizes 1e-308 m and less", "ordinary", 4.0, denormal}};
}

}  // namespace extremes
