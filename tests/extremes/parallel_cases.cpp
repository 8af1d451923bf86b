// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

namespace extremes {

namespace {

using namespace error_table;

/// A direction in which an edge or a face touches.
Wish drawFlatWish(const Body& body, Random& random) {
  for (;;) {
    Wish wish = drawWish(body, random);
    if (wish.tie != Wish::Tie::None) return wish;
  }
}

/// Turns a direction of b against one of a, all but for an angle, and edges along each other, all
/// but for another.
Matrix3d almostAgainst(const Wish& a, const Wish& b, double angle, Random& random) {
  const auto edge = [&](const Wish& wish) {
    return wish.tie == Wish::Tie::Across ? rounded(unit(wish.exact)) : random.across(wish.normal);
  };
  const Vector3d tilt = angle * random.direction();
  const Matrix3d to = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
  const Vector3d u = edge(a);
  const Vector3d v = edge(b);
  Matrix3d frameA, frameB;
  frameA << a.normal, u, a.normal.cross(u);
  frameB << -b.normal, v, -b.normal.cross(v);
  const Matrix3d turn = to * frameA * frameB.transpose();
  return Eigen::Quaterniond(turn).normalized().toRotationMatrix();
}

/// As drawTouch(), for edges and faces alone.
Touch drawAlmostParallel(const Body& a, const Body& b, double angle, Random& random) {
  const Wish wishA = drawFlatWish(a, random);
  const Wish wishB = drawFlatWish(b, random);
  Touch touch;
  touch.linear = angle > 0.0 ? almostAgainst(wishA, wishB, angle, random) : random.permutation();
  const ExactTurn turn(touch.linear);
  touch.n = direction(wishA, wishB, turn, random.chance(0.5));
  const Support pointA = supportOf(a, touch.n, 0.0, random);
  Body core = b;
  core.radius = 0.0;
  const Support pointB = supportOf(core, unit(turn.transposed(touch.n) * Real(-1)), 0.0, random);
  touch.featureA = pointA.feature;
  touch.featureB = pointB.feature;
  touch.shift = pointA.point - turn * pointB.point + touch.n * Real(b.radius);
  return touch;
}

/// angle: rad; 0: to the last bit, as axes are turned onto axes.
std::optional<Sample> drawParallel(Random& random, double angle, bool apart) {
  Wanted wanted;
  wanted.shapes = {Form::Box, Form::Box, Form::Hull, Form::Mesh, Form::Capsule};
  if (apart) {
    wanted.shapes.push_back(Form::Cylinder);
    wanted.shapes.push_back(Form::Triangle);
  }
  Solid a = drawOne(random, wanted, wanted.sizeA);
  Solid b = drawOne(random, wanted, wanted.sizeB);
  const Touch touch = drawAlmostParallel(a.body, b.body, angle, random);
  const double gap = random.decades(-9.0, 0.0);
  if (apart) return apartAt(std::move(a), std::move(b), touch, gap);
  const double rolling = a.body.rolling + b.body.rolling;
  if (!a.body.convex || !b.body.convex) return std::nullopt;
  if (rolling > 0.0) return overlapAt(std::move(a), std::move(b), touch, gap * 0.95 * rolling);
  const Isometry3d pose = placedAlong(touch, Real(-0.1 * gap)).a_from_b;
  return overlappingAt(std::move(a), std::move(b), pose);
}

PairCase parallel(const std::string& name, double angle) {
  return {name, "ordinary", 4.0, [angle](Random& random, int i) {
            for (;;) {
              if (auto sample = drawParallel(random, angle, i % 2 == 0)) return *std::move(sample);
            }
          }};
}

}  // namespace

std::vector<PairCase> parallelCases() {
  return {parallel("edges and faces parallel", 0.0),
          parallel("edges and faces at 1e-3 rad", 1e-3),
          parallel("edges and faces at 1e-6 rad", 1e-6),
          parallel("edges and faces at 1e-9 rad", 1e-9),
          parallel("edges and faces at 1e-12 rad", 1e-12),
          parallel("edges and faces at 1e-15 rad", 1e-15)};
}

}  // namespace extremes
