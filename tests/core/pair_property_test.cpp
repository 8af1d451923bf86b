// SPDX-License-Identifier: BSD-3-Clause
// What must hold for any two shapes: certificates that definitions confirm, the same answers seen
// from either body, from elsewhere and after a small motion, and answers of the three queries that
// do not contradict each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "narrowphase/convex_pair.hpp"
#include "pair_samples_all.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using samples::kNames;
using samples::Pair;
using samples::Sampler;

/// Every alternative is convex or made of pieces that are, which is all that the queries know: a
/// shape that is neither does not compile here, nor in the queries.
template <std::size_t... i>
constexpr bool allKnown(std::index_sequence<i...>) {
  return ((detail::ConvexShape<std::variant_alternative_t<i, Shape>> ||
           std::is_same_v<std::variant_alternative_t<i, Shape>, TriangleMesh> ||
           std::is_same_v<std::variant_alternative_t<i, Shape>, PointCloud>)&&...);
}
static_assert(allKnown(std::make_index_sequence<std::variant_size_v<Shape>>{}));

/// Of the magnitude. What the oracle itself rounds, and the placement.
constexpr double kOracle = 4e-15;
/// Of the magnitude. How far witnesses may be from where they should: twice the lemma's rounding.
constexpr double kWitness = 4e-14;

class EveryPair : public testing::TestWithParam<std::tuple<std::size_t, std::size_t>> {
 protected:
  std::size_t kindA() const { return std::get<0>(GetParam()); }
  std::size_t kindB() const { return std::get<1>(GetParam()); }
  Sampler sampler(unsigned seed) const {
    return Sampler(seed + static_cast<unsigned>(97 * kindA() + kindB()));
  }
  /// A mesh or a cloud.
  bool hasPieces() const { return kindB() >= 10; }
  bool areFlat() const { return (kindA() == 8 || kindA() == 9) && (kindB() == 8 || kindB() == 9); }
};

void expectFinite(const DistanceResult& r) {
  EXPECT_TRUE(r.pointA.allFinite() && r.pointB.allFinite() && r.normal.allFinite());
  EXPECT_GE(r.lower, 0.0);
  EXPECT_LE(r.lower, r.upper);
}

/// Along directions of all kinds no slab is wider than `upper`: neither the distance is, nor is the
/// depth less than minus that.
void expectNoWiderSlab(const Pair& p, double upper, const Vector3d& normal, double allowance,
                       Sampler& sampler) {
  for (int k = 0; k < 24; ++k) {
    Vector3d n = sampler.random.direction();
    if (k % 3 == 0) n = (normal + std::pow(10.0, -k) * n).normalized();
    if (k % 3 == 1) n = (k % 2 ? -1.0 : 1.0) * Vector3d::Unit(k / 3 % 3);
    ASSERT_LE(oracle::slab(p.a, p.b, p.a_from_b, n), upper + allowance);
  }
}

/// The oracle itself can tell: a flat hull has no faces, and a mesh is asked nothing.
TEST(ShapeOracle, MeasuresFlatHullsAndMeshes) {
  const std::vector<Vector3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.4, 0.5, 0}};
  const ConvexHull flat = ConvexHull::of(square);
  ASSERT_TRUE(flat.faces().empty());
  EXPECT_EQ(oracle::outside(flat, {0.3, 0.6, 0.0}), 0.0);
  EXPECT_NEAR(oracle::outside(flat, {0.3, 0.6, -0.2}), 0.2, 1e-15);
  EXPECT_NEAR(oracle::outside(flat, {2.0, 0.5, 0.0}), 1.0, 1e-15);
  const test::Soup ring = test::torusSoup(16, 8, 0.5, 0.2);
  const auto solid = TriangleMesh::build(ring.vertices, ring.triangles);
  const auto surface = TriangleMesh::build(ring.vertices, ring.triangles, MeshInterior::Surface);
  const Vector3d within(0.5, 0.01, 0.02);
  EXPECT_EQ(oracle::outside(solid, within), 0.0);
  EXPECT_GT(oracle::outside(surface, within), 0.1);
  EXPECT_GT(oracle::outside(solid, Vector3d::Zero()), 0.29);
  const auto open =
      TriangleMesh::build(ring.vertices, {ring.triangles.begin() + 1, ring.triangles.end()});
  EXPECT_GT(oracle::outside(open, within), 0.1);
}

TEST_P(EveryPair, DistancesAreProvenAndWitnessed) {
  Sampler sampler = this->sampler(11);
  int apart = 0;
  int wide = 0;
  const int cases = hasPieces() ? 60 : 400;
  for (int i = 0; i < cases; ++i) {
    const Pair p = sampler.pair(kindA(), kindB(), i);
    SCOPED_TRACE(i);
    const double size = oracle::magnitude(p.a, p.b, p.a_from_b);
    const DistanceResult r = distance(p.a, p.b, p.a_from_b);
    expectFinite(r);
    // Rims that nearly lie in a face are where rounding keeps the interval open.
    EXPECT_LE(r.upper - r.lower, 1e-7);
    wide += r.upper - r.lower > 1e-9 + kWitness * size;
    // Pushed far enough, a flat body comes out on the other side.
    if (p.gap >= 0.0 && p.parallel) {
      EXPECT_LE(r.lower, p.gap + kOracle * size);
      EXPECT_GE(r.upper, p.gap - kWitness * size);
    }
    EXPECT_NEAR((r.pointB - r.pointA).norm(), r.upper, kWitness * size);
    EXPECT_LE(oracle::outside(p.a, r.pointA), kWitness * size);
    EXPECT_LE(oracle::outside(p.b, p.a_from_b.inverse() * r.pointB), kWitness * size);
    if (!r.normal.isZero()) {
      EXPECT_NEAR(r.normal.norm(), 1.0, 1e-14);
      // Planes within 1e-12 of parallel are taken to be.
      EXPECT_TRUE(areFlat() ||
                  oracle::slab(p.a, p.b, p.a_from_b, r.normal) >= r.lower - kOracle * size);
    } else if (!hasPieces()) {
      EXPECT_EQ(r.lower, 0.0);
    }
    apart += r.lower > 0.0;
    if (HasFailure()) FAIL() << "gap " << p.gap;
  }
  EXPECT_LE(wide, cases / 30);
  EXPECT_GT(apart, cases / 4);
  EXPECT_LT(apart, 3 * cases / 4);
}

TEST_P(EveryPair, SignedDistancesAreProvenAndWitnessed) {
  Sampler sampler = this->sampler(12);
  int deep = 0;
  int wide = 0;
  const int cases = hasPieces() ? 60 : 400;
  for (int i = 0; i < cases; ++i) {
    const Pair p = sampler.pair(kindA(), kindB(), i);
    SCOPED_TRACE(i);
    const double size = oracle::magnitude(p.a, p.b, p.a_from_b);
    const SignedDistanceResult r = signedDistance(p.a, p.b, p.a_from_b);
    EXPECT_TRUE(r.pointA.allFinite() && r.pointB.allFinite() && r.normal.allFinite());
    EXPECT_LE(r.lower, r.upper);
    if (!p.parallel || std::isinf(r.lower)) {
      EXPECT_TRUE(areFlat());
      continue;
    }
    if (p.gap >= 0.0) {
      EXPECT_LE(r.lower, p.gap + kOracle * size);
    }
    EXPECT_GE(r.upper, p.gap - kWitness * size);
    if (!hasPieces()) {
      EXPECT_NEAR(r.normal.norm(), 1.0, 1e-14);
      EXPECT_TRUE(areFlat() ||
                  oracle::slab(p.a, p.b, p.a_from_b, r.normal) >= r.lower - kOracle * size)
          << "normal " << r.normal.transpose() << ", " << r.lower << " to " << r.upper;
    }
    expectNoWiderSlab(p, r.upper, r.normal, kWitness * size, sampler);
    EXPECT_LE(oracle::outside(p.a, r.pointA), kWitness * size);
    EXPECT_LE(oracle::outside(p.b, p.a_from_b.inverse() * r.pointB), kWitness * size);
    wide += !(r.upper - r.lower <= 1.1e-9 + 2.0 * kWitness * size);
    deep += r.upper < -1e-3;
    if (HasFailure()) FAIL() << "gap " << p.gap;
  }
  // Nothing is proven of how deep a plane cuts a mesh.
  EXPECT_TRUE(kindA() == 8 || areFlat() || deep > cases / 50) << deep;
  EXPECT_LT(deep, cases / 2);
  EXPECT_TRUE(hasPieces() || wide <= cases / 20) << wide;
}

TEST_P(EveryPair, QueriesAgreeWithEachOther) {
  Sampler sampler = this->sampler(13);
  std::map<Contact, int> seen;
  const int cases = hasPieces() ? 60 : 400;
  for (int i = 0; i < cases; ++i) {
    const Pair p = sampler.pair(kindA(), kindB(), i);
    SCOPED_TRACE(i);
    const double size = oracle::magnitude(p.a, p.b, p.a_from_b);
    const DistanceResult d = distance(p.a, p.b, p.a_from_b);
    const SignedDistanceResult s = signedDistance(p.a, p.b, p.a_from_b);
    const Contact c = collide(p.a, p.b, p.a_from_b);
    ++seen[c];
    EXPECT_LE(d.lower, std::max(0.0, s.upper) + kWitness * size);
    EXPECT_LE(s.lower, d.upper + kWitness * size);
    if (c == Contact::Separate) {
      EXPECT_GT(d.upper, 0.0);
      EXPECT_GT(s.upper, 0.0);
    } else {
      EXPECT_LE(d.lower, kWitness * size);
      EXPECT_LE(s.lower, kWitness * size);
    }
    if (c == Contact::Unknown) {
      EXPECT_EQ(d.lower, 0.0);
      EXPECT_TRUE(p.gap == 0.0 || d.upper <= kWitness * size) << d.upper;
    }
    if (HasFailure()) FAIL() << "gap " << p.gap << " contact " << static_cast<int>(c);
  }
  EXPECT_GT(seen[Contact::Separate], cases / 4);
  EXPECT_GT(seen[Contact::Touching], cases / 4);
  EXPECT_LT(seen[Contact::Unknown], cases / 4);  // at most those placed to touch
}

TEST_P(EveryPair, AnswersDoNotDependOnTheOrderOrThePlace) {
  Sampler sampler = this->sampler(14);
  const int cases = hasPieces() ? 40 : 200;
  for (int i = 0; i < cases; ++i) {
    const Pair p = sampler.pair(kindA(), kindB(), i);
    SCOPED_TRACE(i);
    // Both moved to another place: the pose between them is the same but for rounding.
    const Isometry3d world_from_a = sampler.random.pose(3.0);
    const Isometry3d world_from_b = world_from_a * p.a_from_b;
    const Isometry3d again = world_from_a.inverse() * world_from_b;
    const double size = oracle::magnitude(p.a, p.b, p.a_from_b) + 10.0;
    if (!p.parallel) continue;
    const DistanceResult d = distance(p.a, p.b, p.a_from_b);
    const SignedDistanceResult s = signedDistance(p.a, p.b, p.a_from_b);
    if (std::isinf(s.lower)) continue;
    const auto meets = [&](const auto& one, const auto& other) {
      EXPECT_LE(one.lower, other.upper + kWitness * size);
      EXPECT_LE(other.lower, one.upper + kWitness * size);
    };
    meets(d, distance(p.b, p.a, p.a_from_b.inverse()));
    meets(s, signedDistance(p.b, p.a, p.a_from_b.inverse()));
    // Planes that were parallel cross after any rounding.
    if (!areFlat()) {
      meets(d, distance(p.a, p.b, again));
      meets(s, signedDistance(p.a, p.b, again));
    }
    // The points of the swapped query are as good.
    const DistanceResult swapped = distance(p.b, p.a, p.a_from_b.inverse());
    EXPECT_LE(oracle::outside(p.a, p.a_from_b * swapped.pointB), kWitness * size);
    EXPECT_LE(oracle::outside(p.b, swapped.pointA), kWitness * size);
    if (HasFailure()) FAIL() << "gap " << p.gap;
  }
}

/// No query may change by more than the motion.
TEST_P(EveryPair, SignedDistancesAreOneLipschitz) {
  Sampler sampler = this->sampler(15);
  const int cases = hasPieces() ? 40 : 200;
  for (int i = 0; i < cases; ++i) {
    const Pair p = sampler.pair(kindA(), kindB(), i);
    SCOPED_TRACE(i);
    const double step = std::pow(10.0, sampler.random.uniform(-12.0, -1.0));
    Pair moved = p;
    moved.a_from_b.translation() += step * sampler.random.direction();
    const double allowance = step + kWitness * oracle::magnitude(p.a, p.b, p.a_from_b);
    const SignedDistanceResult s = signedDistance(p.a, p.b, p.a_from_b);
    const SignedDistanceResult t = signedDistance(p.a, p.b, moved.a_from_b);
    if (std::isinf(s.lower)) continue;
    EXPECT_LE(s.lower, t.upper + allowance);
    EXPECT_LE(t.lower, s.upper + allowance);
    if (HasFailure()) FAIL() << "gap " << p.gap << " step " << step;
  }
}

/// libccd decides contact by a portal around a point inside the difference of the bodies, and its
/// distance by bisection on that. It is wrong where
///  * a body has no thickness (triangles, and flat or slender shapes): the point inside is on the
///    boundary, or so near that the portal collapses;
///  * the bodies overlap by less than the portal's tolerance.
/// Elsewhere it agrees always.
TEST_P(EveryPair, LibccdAgreesWhereItIsRight) {
  const auto isFlat = [](std::size_t kind) { return kind == 8 || kind == 9; };
  if (isFlat(kindA()) || isFlat(kindB())) return;  // closed forms whatever the backend
  Sampler sampler = this->sampler(17);
  DistanceOptions libccd;
  libccd.backend = Backend::Libccd;
  int wrong = 0;
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const Pair p = sampler.pair(kindA(), kindB(), i);
    SCOPED_TRACE(i);
    const DistanceResult own = distance(p.a, p.b, p.a_from_b);
    const double other = distance(p.a, p.b, p.a_from_b, libccd).upper;
    constexpr double kStep = 1.2 * tolerance::kLibccdDistance;
    const bool agree = own.lower <= other + kStep && other <= own.upper + kStep;
    if (p.ordinary && kindA() != 7 && kindB() != 7) {
      ++compared;
      EXPECT_TRUE(agree) << "gap " << p.gap << " libccd " << other << " own " << own.upper;
    } else {
      wrong += !agree;
    }
  }
  EXPECT_LE(wrong, 60 / 5);
  EXPECT_TRUE(compared >= 30 || kindA() == 7 || kindB() == 7);
}

struct Scaled {
  double by;

  Shape operator()(const Sphere& s) const { return Sphere{by * s.radius}; }
  Shape operator()(const Box& s) const { return Box{by * s.halfExtents}; }
  Shape operator()(const Cylinder& s) const { return Cylinder{by * s.radius, by * s.halfLength}; }
  Shape operator()(const Capsule& s) const { return Capsule{by * s.radius, by * s.halfLength}; }
  Shape operator()(const Cone& s) const { return Cone{by * s.radius, by * s.halfLength}; }
  Shape operator()(const Ellipsoid& s) const { return Ellipsoid{by * s.semiAxes}; }
  Shape operator()(const Triangle& s) const {
    return Triangle{{by * s.corners[0], by * s.corners[1], by * s.corners[2]}};
  }
  Shape operator()(const Plane& s) const { return Plane{s.normal, by * s.offset}; }
  Shape operator()(const HalfSpace& s) const { return HalfSpace{s.normal, by * s.offset}; }
  template <typename Vertices>
  Shape operator()(const Vertices& s) const {
    return s;
  }
};

/// At any scale that doubles have, of one shape or both, answers are intervals without
/// contradictions, if wide ones.
TEST_P(EveryPair, ExtremeScalesGiveIntervals) {
  Sampler sampler = this->sampler(16);
  for (const double scale : {1e-300, 1e-150, 1e-40, 1e-20, 1e20, 1e40, 1e150, 1e300}) {
    for (int i = 0; i < 12; ++i) {
      Pair p = sampler.pair(kindA(), kindB(), i);
      SCOPED_TRACE(scale);
      p.a_from_b.translation() *= scale;
      p.b = std::visit(Scaled{scale}, p.b);
      if (i % 3 != 0) p.a = std::visit(Scaled{scale}, p.a);
      const DistanceResult d = distance(p.a, p.b, p.a_from_b);
      expectFinite(d);
      const SignedDistanceResult s = signedDistance(p.a, p.b, p.a_from_b);
      EXPECT_LE(s.lower, s.upper);
      EXPECT_TRUE(s.pointA.allFinite() && s.pointB.allFinite() && s.normal.allFinite());
      EXPECT_LE(s.lower, d.upper);
      EXPECT_LE(d.lower, std::max(0.0, s.upper));
      const Contact c = collide(p.a, p.b, p.a_from_b);
      EXPECT_TRUE(c != Contact::Separate || d.upper > 0.0);
      EXPECT_TRUE(c != Contact::Touching || d.lower == 0.0);
      if (HasFailure()) FAIL() << "sample " << i;
    }
  }
}

std::vector<std::tuple<std::size_t, std::size_t>> everyPair() {
  std::vector<std::tuple<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < kNames.size(); ++a) {
    for (std::size_t b = a; b < kNames.size(); ++b) pairs.emplace_back(a, b);
  }
  return pairs;
}

INSTANTIATE_TEST_SUITE_P(Pairs, EveryPair, testing::ValuesIn(everyPair()), [](const auto& pair) {
  return std::string(kNames[std::get<0>(pair.param)]) + kNames[std::get<1>(pair.param)];
});

}  // namespace
}  // namespace swept
