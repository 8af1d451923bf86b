// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "shape_input.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"
#include "swept/core/tolerances.hpp"

/// Answers about two shapes against each other, and against points of the shapes.
namespace swept::fuzz {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

double leastOfPoints(const Sampled& a, const Sampled& b, const Isometry3d& a_from_b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : a.points)
    for (const Vector3d& q : b.points) least = std::min(least, (p - a_from_b * q).norm());
  return least;
}

/// Whether libccd, whose steps end by absolute sizes, is to be believed of the shape: it is solid,
/// not flat and neither tiny nor huge.
bool suitsLibccd(const Shape& shape) {
  const auto thick = [](double least, double most) {
    return least >= 1e-2 && most <= 1e2 && least >= 0.05 * most;
  };
  if (const auto* ball = std::get_if<Sphere>(&shape)) return thick(ball->radius, ball->radius);
  if (const auto* box = std::get_if<Box>(&shape))
    return thick(box->halfExtents.minCoeff(), box->halfExtents.maxCoeff());
  if (const auto* capsule = std::get_if<Capsule>(&shape))
    return thick(capsule->radius, capsule->radius + capsule->halfLength);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return thick(std::min(cylinder->radius, cylinder->halfLength),
                 std::max(cylinder->radius, cylinder->halfLength));
  if (const auto* cone = std::get_if<Cone>(&shape))
    return thick(std::min(cone->radius, cone->halfLength),
                 std::max(cone->radius, cone->halfLength));
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape))
    return thick(ellipsoid->semiAxes.minCoeff(), ellipsoid->semiAxes.maxCoeff());
  return false;
}

/// Of two shapes that suit it, libccd says the same.
void compareWithLibccd(const Shape& a, const Shape& b, const Isometry3d& a_from_b,
                       const SignedDistanceResult& ours) {
  const double slack = 2.0 * tolerance::kLibccdDistance +
                       1e-5 * std::max(boundingSphere(a).radius, boundingSphere(b).radius);
  const Contact contact = collide(a, b, a_from_b, Backend::Libccd);
  if (contact == Contact::Touching && ours.lower > slack) fail("libccd says touching, not apart");
  if (contact == Contact::Separate && ours.upper < -slack) fail("libccd says apart, not touching");
  const DistanceOptions options{.backend = Backend::Libccd};
  const double estimate = distance(a, b, a_from_b, options).upper;
  if (estimate < ours.lower - slack) fail("libccd finds a smaller distance");
  if (estimate > std::max(0.0, ours.upper) + slack) fail("libccd finds a larger distance");
}

void examine(const Sampled& a, const Sampled& b, const Isometry3d& a_from_b) {
  const double scale = boundingSphere(a.shape).radius + boundingSphere(b.shape).radius +
                       boundingSphere(a.shape).center.norm() +
                       boundingSphere(b.shape).center.norm() + a_from_b.translation().norm();
  const double slack = 1e-12 * scale;
  const DistanceResult apart = distance(a.shape, b.shape, a_from_b);
  if (!(apart.lower >= 0.0 && apart.lower <= apart.upper)) fail("no interval");
  if (apart.lower > leastOfPoints(a, b, a_from_b) + slack) fail("points are nearer than proven");
  const DistanceResult mirrored = distance(b.shape, a.shape, a_from_b.inverse());
  if (apart.lower > mirrored.upper + slack || mirrored.lower > apart.upper + slack)
    fail("b from a is another distance than a from b");
  const SignedDistanceResult both = signedDistance(a.shape, b.shape, a_from_b);
  if (!(both.lower <= both.upper)) fail("no interval of the signed distance");
  if (both.lower > apart.upper + slack || apart.lower > std::max(0.0, both.upper) + slack)
    fail("the signed distance is another one");
  const Contact contact = collide(a.shape, b.shape, a_from_b);
  if (contact == Contact::Touching && apart.lower > slack) fail("touching, and apart");
  if (contact == Contact::Separate && both.upper < -slack) fail("separate, and deep");
  if (suitsLibccd(a.shape) && suitsLibccd(b.shape) && a_from_b.translation().norm() < 1e3)
    compareWithLibccd(a.shape, b.shape, a_from_b, both);
}

}  // namespace
}  // namespace swept::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swept::fuzz;
  Numbers numbers(data, size);
  const double scale = numbers.size();
  const Sampled a = shape(numbers, scale);
  const Sampled b = shape(numbers, scale * (numbers.byte() % 4 == 0 ? numbers.size() : 1.0));
  examine(a, b, pose(numbers, 2.0 * scale));
  return 0;
}
