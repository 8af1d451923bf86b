// SPDX-License-Identifier: BSD-3-Clause
// SWEPT_IMPACT_QUERIES sets how many queries there are: ten million take some minutes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <limits>

#include "impact_oracle.hpp"
#include "impact_samples.hpp"

namespace swept::test {
namespace {

using Eigen::Vector3d;

bool isCampaign() {
  return std::getenv("SWEPT_IMPACT_QUERIES") != nullptr;
}

int queriesInAll() {
  const char* queries = std::getenv("SWEPT_IMPACT_QUERIES");
  return queries == nullptr ? 200'000 : std::atoi(queries);
}

unsigned seed() {
  const char* seed = std::getenv("SWEPT_IMPACT_SEED");
  return seed == nullptr ? 1U : static_cast<unsigned>(std::atoi(seed));
}

struct Tally {
  std::array<int, ImpactTraits{}.size()> traits{};
  int free = 0;
  int collisions = 0;
  int degenerate = 0;

  void count(const KnownImpact& known, const Impact& impact) {
    for (std::size_t i = 0; i < traits.size(); ++i) traits[i] += known.traits[i] ? 1 : 0;
    (impact.verdict == Verdict::Free ? free : collisions) += 1;
    ImpactTraits ordinary;
    for (const ImpactTrait trait :
         {ImpactTrait::Edges, ImpactTrait::Apart, ImpactTrait::Huge, ImpactTrait::Tiny,
          ImpactTrait::FarAway, ImpactTrait::MixedSizes, ImpactTrait::NoTolerance}) {
      ordinary.set(static_cast<std::size_t>(trait));
    }
    degenerate += (known.traits & ~ordinary).any() ? 1 : 0;
  }
  int of(ImpactTrait trait) const { return traits[static_cast<std::size_t>(trait)]; }
  void print(const char* name) const {
    if (!isCampaign()) return;
    std::cout << name << ": " << free << " free, " << collisions << " collisions, " << degenerate
              << " degenerate or grazing; by trait";
    for (const int n : traits) std::cout << ' ' << n;
    std::cout << '\n';
  }
};

/// Every query that touches is found, no later than the contact that it was made with.
TEST(Impact, NoContactIsMissed) {
  const int queries = queriesInAll() / 2;
  ImpactSampler sampler(seed());
  Tally tally;
  for (int i = 0; i < queries; ++i) {
    const KnownImpact known = sampler.inContact();
    const Impact impact = ask(known.query);
    ASSERT_EQ(impact.verdict, Verdict::Collision) << oracle::reproducer(known.query);
    ASSERT_LE(impact.freeUntil, *known.contact) << oracle::reproducer(known.query);
    ASSERT_EQ(oracle::complaint(known.query, impact), "") << oracle::reproducer(known.query);
    tally.count(known, impact);
  }
  tally.print("in contact");
  for (std::size_t i = 0; i < tally.traits.size(); ++i) {
    EXPECT_GT(tally.traits[i], queries / 50) << "trait " << i;
  }
  EXPECT_GT(tally.degenerate, queries / 2);
}

/// Every query that keeps more than separation and tolerance is free.
TEST(Impact, FeaturesOnBothSidesOfAGapAreFree) {
  const int queries = queriesInAll() / 4;
  ImpactSampler sampler(seed() + 1);
  Tally tally;
  for (int i = 0; i < queries; ++i) {
    const KnownImpact known = sampler.apart();
    const Impact impact = ask(known.query);
    ASSERT_EQ(impact.verdict, Verdict::Free) << oracle::reproducer(known.query);
    ASSERT_EQ(oracle::complaint(known.query, impact), "") << oracle::reproducer(known.query);
    tally.count(known, impact);
  }
  tally.print("apart");
  for (const ImpactTrait trait :
       {ImpactTrait::Edges, ImpactTrait::Flat, ImpactTrait::Point, ImpactTrait::Still,
        ImpactTrait::Apart, ImpactTrait::Huge, ImpactTrait::Tiny, ImpactTrait::FarAway,
        ImpactTrait::MixedSizes, ImpactTrait::NoTolerance}) {
    EXPECT_GT(tally.of(trait), queries / 50);
  }
}

/// Doubles of all kinds, in motions that turn the features.
class RandomImpacts {
 public:
  explicit RandomImpacts(unsigned seed) : random_(seed) {}

  double number(double reach) { return reach * (2.0 * unit_(random_) - 1.0); }
  Vector3d vector(double reach) { return {number(reach), number(reach), number(reach)}; }

  ImpactQuery draw() {
    ImpactQuery q;
    q.edges = number(1.0) < 0.0;
    const double drift = std::abs(number(2.0));
    const double turn = std::abs(number(2.0));
    const Vector3d both = vector(drift);
    for (int i = 0; i < 4; ++i) {
      q.points[i].start = vector(1.0);
      q.points[i].end = q.points[i].start + vector(turn);
      if (i < (q.edges ? 2 : 1)) q.points[i].end += both;
    }
    return q;
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

/// m, at some t: where a search finds the features nearest.
std::pair<double, double> nearest(const ImpactQuery& q) {
  const auto at = [&](double t) { return oracle::distanceAt<long double>(q, t); };
  constexpr int kSamples = 32;
  int least = 0;
  for (int i = 1; i <= kSamples; ++i) {
    if (at(i / double{kSamples}) < at(least / double{kSamples})) least = i;
  }
  double from = std::max(0, least - 1) / double{kSamples};
  double to = std::min(kSamples, least + 1) / double{kSamples};
  for (int i = 0; i < 60; ++i) {
    const double a = from + 0.382 * (to - from);
    const double b = from + 0.618 * (to - from);
    (at(a) < at(b) ? to : from) = at(a) < at(b) ? b : a;
  }
  return {static_cast<double>(at(from)), from};
}

/// The separation is set about the least distance: the hardest queries to decide, and a miss of a
/// few roundings shows.
TEST(Impact, SeparationsAboutTheLeastDistance) {
  const int queries = queriesInAll() / 20;
  RandomImpacts random(seed() + 2);
  int turning = 0;
  int collisions = 0;
  for (int i = 0; i < queries; ++i) {
    ImpactQuery q = random.draw();
    const auto [distance, t] = nearest(q);
    if (distance < 1e-3) continue;
    turning += t > 0.0 && t < 0.999 ? 1 : 0;
    // Contact, proven by that distance.
    q.options.separation = distance * (1.0 + 1e-15);
    q.options.tolerance = std::pow(10.0, -6.0 - std::abs(random.number(6.0)));
    const Impact touching = ask(q);
    ASSERT_EQ(touching.verdict, Verdict::Collision) << oracle::reproducer(q);
    ASSERT_EQ(oracle::complaint(q, touching), "") << oracle::reproducer(q);
    ASSERT_LE(touching.freeUntil, t) << oracle::reproducer(q);
    // Free, or else within the tolerance.
    const double slack = static_cast<double>(oracle::slack(q));
    q.options.separation = distance - slack * (0.9 + std::abs(random.number(1.0)));
    if (q.options.separation < 0.0) continue;
    const Impact passing = ask(q);
    ASSERT_EQ(oracle::complaint(q, passing), "") << oracle::reproducer(q);
    collisions += passing.verdict == Verdict::Collision ? 1 : 0;
  }
  EXPECT_GT(turning, queries / 4);
  EXPECT_GT(collisions, queries / 100);
  EXPECT_LT(collisions, queries / 2);
}

/// Against the division of time and parameters, down to 1e-9 m: of queries of this size none is
/// nearer than that and yet apart, but for one in a billion. What takes the division too long is
/// rarer than one in ten thousand.
TEST(Impact, AgreesWithSubdivision) {
  const int queries = queriesInAll() / 100;
  RandomImpacts random(seed() + 3);
  int collisions = 0;
  int unknown = 0;
  for (int i = 0; i < queries; ++i) {
    ImpactQuery q = random.draw();
    if (i % 2 == 1) q.options.separation = 0.125;
    if (i % 3 == 2) q.options.before = 0.5;
    const Impact impact = ask(q);
    const auto truth = oracle::Subdivision(q, 1e-9).answer();
    ASSERT_EQ(oracle::complaint(q, impact), "") << oracle::reproducer(q);
    if (!truth.known) {
      ++unknown;
    } else if (impact.verdict == Verdict::Free) {
      ASSERT_TRUE(truth.free) << oracle::reproducer(q);
    } else {
      ++collisions;
      ASSERT_LE(impact.freeUntil, truth.contactBy + 1e-9) << oracle::reproducer(q);
    }
  }
  EXPECT_GT(collisions, queries / 10);
  EXPECT_LT(collisions, queries * 7 / 10);
  EXPECT_LE(unknown, queries / 10000);
}

/// Coordinates of all magnitudes side by side, whose products underflow: a point of one feature
/// ends where one of the other does.
TEST(Impact, MagnitudesMayDiffer) {
  RandomImpacts random(seed() + 7);
  const int queries = queriesInAll() / 10;
  for (int i = 0; i < queries; ++i) {
    ImpactQuery q = random.draw();
    for (LinearPath& path : q.points) {
      for (Vector3d* point : {&path.start, &path.end}) {
        for (int axis = 0; axis < 3; ++axis) {
          (*point)[axis] *= std::exp2(std::min(0.0, random.number(300.0)));
        }
      }
    }
    q.options.tolerance = std::exp2(random.number(200.0) - 200.0);
    EXPECT_EQ(oracle::complaint(q, ask(q)), "") << oracle::reproducer(q);
    q.points[0].end = q.points[3].end;
    const Impact impact = ask(q);
    ASSERT_EQ(impact.verdict, Verdict::Collision) << oracle::reproducer(q);
    ASSERT_EQ(oracle::complaint(q, impact), "") << oracle::reproducer(q);
  }
}

/// Two edges that slide past each other for most of the motion, 2.5e-12 of their size apart, which
/// is where coefficients in doubles tell nothing: found at random among ten million.
TEST(Impact, SlidesWithinRoundingAreDecided) {
  const ImpactQuery q{true,
                      {{{{-0x1.62682d63a91d2p-39, -0x1.e8522764d9394p-277, 0x1.2b2cc1c64b614p-67},
                         {-0x1.822f191c43c82p-1, 0x1.1237e609897aep-3, -0x1.15b80efa4c9ep-6}},
                        {{-0x1.a9e9b83b67ccp-66, -0x1.8d9728f3ae9d5p-1, 0x1.e5391ab6979p-6},
                         {-0x1.0c18da1f0dd28p-1, -0x1.01b3eb3b91a96p-81, 0x1.1f5cfe19d1baap+0}},
                        {{-0x1.33143612a36b1p-236, -0x1.b4dc47cf5867p-4, -0x1.6f4d376450f15p-31},
                         {-0x1.7b2645673836ep-1, -0x1.6b5e84739b27dp-178, -0x1.e3b45cf5baaep-22}},
                        {{-0x1.924c93aca17a5p-183, 0x1.cb30b708237bcp-107, -0x1.90306b23496fp-111},
                         {-0x1.822f191c43c82p-1, 0x1.1237e609897aep-3, -0x1.15b80efa4c9ep-6}}}},
                      {.separation = 0.0, .tolerance = 0.0, .before = 1.0}};
  const Impact impact = ask(q);
  EXPECT_EQ(impact.verdict, Verdict::Collision);
  EXPECT_GT(impact.freeUntil, 0.75);
  EXPECT_EQ(oracle::complaint(q, impact), "") << oracle::reproducer(q);
}

/// Scaled by powers of two, with separation and tolerance, answers do not change in any bit.
TEST(Impact, SizeDoesNotMatter) {
  RandomImpacts random(seed() + 4);
  for (int i = 0; i < 2000; ++i) {
    ImpactQuery q = random.draw();
    q.options.separation = std::max(0.0, random.number(0.1));
    const Impact once = ask(q);
    for (const int power : {-900, -30, 30, 900}) {
      ImpactQuery scaled = q;
      for (LinearPath& path : scaled.points) {
        path.start *= std::ldexp(1.0, power);
        path.end *= std::ldexp(1.0, power);
      }
      scaled.options.separation = std::ldexp(q.options.separation, power);
      scaled.options.tolerance = std::ldexp(q.options.tolerance, power);
      const Impact again = ask(scaled);
      ASSERT_EQ(again.verdict, once.verdict);
      ASSERT_EQ(again.freeUntil, once.freeUntil);
      ASSERT_EQ(again.contactBy, once.contactBy);
    }
  }
}

/// Whichever way the corners are named, a verdict differs only where both are right: one says that
/// the features come nearer than separation + tolerance, the other that they keep the separation.
TEST(Impact, NamesOfCornersDoNotMatter) {
  RandomImpacts random(seed() + 5);
  for (int i = 0; i < 5000; ++i) {
    ImpactQuery q = random.draw();
    q.options.separation = std::max(0.0, random.number(0.1));
    const Impact once = ask(q);
    ImpactQuery renamed = q;
    if (q.edges) {
      std::swap(renamed.points[0], renamed.points[3]);
      std::swap(renamed.points[1], renamed.points[2]);
    } else {
      std::rotate(renamed.points.begin() + 1, renamed.points.begin() + 2, renamed.points.end());
    }
    const Impact again = ask(renamed);
    ASSERT_EQ(oracle::complaint(q, once), "");
    ASSERT_EQ(oracle::complaint(q, again), "");
    if (once.verdict == again.verdict) continue;
    const double t = std::min(once.contactBy, again.contactBy);
    ASSERT_GT(oracle::distanceAt<long double>(q, t), q.options.separation);
  }
}

TEST(Impact, WhatIsNotFiniteIsUndecided) {
  RandomImpacts random(seed() + 6);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  for (const bool edges : {false, true}) {
    ImpactQuery q = random.draw();
    q.edges = edges;
    for (const double bad : {kInfinity, -kInfinity, kNaN}) {
      for (int i = 0; i < 24; ++i) {
        ImpactQuery wrong = q;
        LinearPath& path = wrong.points[i / 6];
        (i % 2 == 0 ? path.start : path.end)[i / 2 % 3] = bad;
        EXPECT_EQ(ask(wrong).verdict, Verdict::Undecided) << i;
      }
      for (double ImpactOptions::*option :
           {&ImpactOptions::separation, &ImpactOptions::tolerance, &ImpactOptions::before}) {
        ImpactQuery wrong = q;
        wrong.options.*option = bad;
        EXPECT_EQ(ask(wrong).verdict, Verdict::Undecided);
        EXPECT_EQ(ask(wrong).freeUntil, 0.0);
      }
    }
  }
}

/// The greatest doubles that there are, whose differences overflow, and separations beyond them.
TEST(Impact, GreatestNumbersAreDecided) {
  constexpr double kMost = std::numeric_limits<double>::max();
  ImpactQuery q;
  q.points = {{{{0.0, 0.0, kMost}, {0.0, 0.0, -kMost}},
               {{-kMost, -kMost, 0.0}, {-kMost, -kMost, 0.0}},
               {{kMost, -kMost, 0.0}, {kMost, -kMost, 0.0}},
               {{0.0, kMost, 0.0}, {0.0, kMost, 0.0}}}};
  const Impact through = ask(q);
  EXPECT_EQ(through.verdict, Verdict::Collision);
  EXPECT_NEAR(through.contactBy, 0.5, 1e-12);
  q.points[0].end.z() = 0.5 * kMost;
  EXPECT_EQ(ask(q).verdict, Verdict::Free);
  q.options.separation = kMost;
  EXPECT_EQ(ask(q).verdict, Verdict::Collision);
}

/// The time found is that of a vertex falling onto a face, and of crossing edges.
TEST(Impact, KnownTimes) {
  ImpactQuery q;
  q.points = {{{{0.25, 0.25, 3.0}, {0.25, 0.25, -1.0}},
               {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}},
               {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}},
               {{0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}}};
  EXPECT_NEAR(ask(q).contactBy, 0.75, 1e-6);
  q.options.before = 0.7;
  EXPECT_EQ(ask(q).verdict, Verdict::Free);
  EXPECT_EQ(ask(q).freeUntil, 0.7);
  q.options.before = 1.0;
  q.options.separation = 1.0;
  EXPECT_NEAR(ask(q).contactBy, 0.5, 1e-6);

  q.edges = true;
  q.options.separation = 0.0;
  q.points = {{{{-1.0, 0.0, 1.0}, {-1.0, 0.0, -1.0}},
               {{1.0, 0.0, 1.0}, {1.0, 0.0, -1.0}},
               {{0.0, -1.0, 0.0}, {0.0, -1.0, 0.0}},
               {{0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}}};
  EXPECT_NEAR(ask(q).contactBy, 0.5, 1e-6);
}

}  // namespace
}  // namespace swept::test
