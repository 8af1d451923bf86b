// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

namespace extremes {

namespace {

using namespace error_table;

/// The same bodies and direction, with another turn.
Touch turnedTo(const Matrix3d& linear, Touch touch, const Body& a, const Body& b, Random& random) {
  touch.linear = linear;
  const ExactTurn turn(linear);
  const Support pointA = supportOf(a, touch.n, 0.0, random);
  Body core = b;
  core.radius = 0.0;
  const Support pointB = supportOf(core, unit(turn.transposed(touch.n) * Real(-1)), 0.0, random);
  touch.shift = pointA.point - turn * pointB.point + touch.n * Real(b.radius);
  touch.featureA = pointA.feature;
  touch.featureB = pointB.feature;
  return touch;
}

/// A turn that is no longer quite one: the truth is that of the doubles as they are.
PairCase turned(const std::string& name, double workLimit,
                const std::function<Matrix3d(const Matrix3d&, Random&)>& change) {
  return {name, "ordinary", workLimit, [change](Random& random, int i) {
            Wanted wanted;
            wanted.shapes = {Form::Sphere, Form::Box, Form::Capsule, Form::Hull, Form::Triangle};
            Wanted round;
            round.shapes = {Form::Sphere, Form::Capsule};
            const bool apart = i % 2 == 0;
            Solid a = drawOne(random, apart ? wanted : round, 1.0);
            Solid b = drawOne(random, wanted, 1.0);
            const Touch drawn = drawTouch(a.body, b.body, random);
            const Touch touch =
                turnedTo(change(drawn.linear, random), drawn, a.body, b.body, random);
            const Real gap = random.decades(-9.0, 0.0);
            if (apart) return apartAt(std::move(a), std::move(b), touch, gap);
            // Of b the ball that rolls inside may be a little dented: that of a is not.
            const Real rolling = 0.95 * a.body.rolling;
            return overlapAt(std::move(a), std::move(b), touch, gap * rolling);
          }};
}

/// What a chain of a thousand joints ends with, if nobody normalises.
Matrix3d multiplied(const Matrix3d& linear, Random& random) {
  Matrix3d product = linear;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d axis = random.direction();
    const Eigen::AngleAxisd step(random.uniform(-1.0, 1.0), axis);
    product = product * step.toRotationMatrix();
  }
  return product;
}

}  // namespace

std::vector<PairCase> rotationCases() {
  return {turned("turns multiplied 1 000 times", 4.0, multiplied)};
}

}  // namespace extremes
