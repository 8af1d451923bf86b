// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "continuous/surface_features.hpp"
#include "deforming_samples.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using test::Soup;
using test::SoupMotion;

constexpr double kTolerance = 1e-6;  ///< m

DeformingResult continuous(const DeformingMesh& mesh, const DeformingOptions& options = {}) {
  DeformingResult result;
  DeformingWorkspace workspace;
  selfCollideContinuous(mesh, options, result, workspace);
  return result;
}

DeformingResult continuous(const DeformingMesh& a, const DeformingMesh& b,
                           const DeformingOptions& options = {}) {
  DeformingResult result;
  DeformingWorkspace workspace;
  collideContinuous(a, b, options, result, workspace);
  return result;
}

/// What holds of every result.
void expectConsistent(const DeformingResult& result) {
  double freeUntil = 1.0, contactBy = 1.0;
  for (const TriangleImpact& impact : result.impacts) {
    EXPECT_EQ(impact.verdict, Verdict::Collision);
    EXPECT_LE(impact.freeUntil, impact.contactBy);
    freeUntil = std::min(freeUntil, impact.freeUntil);
    contactBy = std::min(contactBy, impact.contactBy);
  }
  EXPECT_EQ(result.verdict, result.impacts.empty() ? Verdict::Free : Verdict::Collision);
  EXPECT_EQ(result.freeUntil, freeUntil);
  EXPECT_EQ(result.contactBy, contactBy);
  EXPECT_TRUE(std::is_sorted(result.impacts.begin(), result.impacts.end()));
}

struct Count {
  std::size_t atStart = 0, later = 0, reported = 0;
};

/// Everything that sampling sees is there, and nothing that provably stays apart.
Count compare(const SoupMotion& motion, int samples) {
  const DeformingResult result = continuous(motion.mesh());
  expectConsistent(result);
  Count count;
  count.reported = result.impacts.size();
  std::set<TrianglePair> found;
  for (const TriangleImpact& impact : result.impacts) found.insert({impact.first, impact.second});
  EXPECT_EQ(found.size(), result.impacts.size());

  const auto atStart = test::touchingPairs(motion.soup.vertices, motion.soup.triangles);
  const std::set<TrianglePair> seen = test::sampledPairs(motion, samples);
  for (const TrianglePair& pair : seen)
    EXPECT_TRUE(found.contains(pair)) << pair.first << " and " << pair.second;
  count.atStart = atStart.size();
  count.later = seen.size() - atStart.size();

  for (const TriangleImpact& impact : result.impacts) {
    const int t = impact.first, u = impact.second;
    if (std::binary_search(atStart.begin(), atStart.end(), TrianglePair{t, u})) {
      EXPECT_EQ(impact.contactBy, 0.0);
      continue;
    }
    EXPECT_FALSE(test::keepApart(motion, t, motion, u, 1.01 * kTolerance)) << t << " and " << u;
    // Neighbours touch always: what is reported of them are features.
    if (test::shareVertex(motion.soup, t, u)) continue;
    const double at = impact.contactBy;
    EXPECT_LE(triangleDistance(motion.corners(t, at), motion.corners(u, at)).lower,
              1.01 * kTolerance);
    for (const double part : {0.0, 0.5, 0.9, 0.999}) {
      const double before = part * impact.freeUntil;
      if (before < impact.freeUntil) {
        EXPECT_GT(triangleDistance(motion.corners(t, before), motion.corners(u, before)).upper,
                  0.0);
      }
    }
  }
  return count;
}

TEST(DeformingImpacts, MissNothingThatSamplingSees) {
  Count all;
  for (int step = 0; step < 8; ++step) {
    const Count count = compare(test::bouncingStep(0.37 * step, 0.2, 12), 60);
    all.atStart += count.atStart;
    all.later += count.later;
    all.reported += count.reported;
  }
  EXPECT_GT(all.atStart, 200U);
  EXPECT_GT(all.later, 1000U);
  // Sampling misses short contacts, but not many.
  EXPECT_LT(all.reported, 1.2 * static_cast<double>(all.atStart + all.later));
}

TEST(DeformingImpacts, MissNothingAmongTrianglesOfAnyKind) {
  std::mt19937 random(6);
  Count all;
  for (int round = 0; round < 12; ++round) {
    const Count count =
        compare(test::randomTriangles(random, 120, 0.15, round % 2 == 0 ? 0.05 : 0.6), 100);
    all.atStart += count.atStart;
    all.later += count.later;
  }
  EXPECT_GT(all.atStart, 100U);
  EXPECT_GT(all.later, 1000U);
}

TEST(DeformingImpacts, NothingTunnels) {
  // A sheet and a triangle, 1 m apart, that change sides within the step; both may be fast.
  const Soup sheet = test::sheetSoup(6, 0.0, 0.0);
  const Soup dart{{{0.1, 0.2, 1.0}, {0.15, 0.2, 1.0}, {0.1, 0.25, 1.0}}, {{0, 1, 2}}};
  for (const double common : {0.0, 1.0, 1e6}) {
    for (const double speed : {2.0, 100.0, 1e7}) {
      SoupMotion a{dart, dart.vertices}, b{sheet, sheet.vertices};
      for (Vector3d& v : a.end) v += Vector3d(common, 0.0, -speed);
      for (Vector3d& v : b.end) v += Vector3d(common, 0.0, 0.0);
      const DeformingResult result = continuous(a.mesh(), b.mesh());
      ASSERT_EQ(result.verdict, Verdict::Collision) << speed << " and " << common;
      expectConsistent(result);
      const double height = 0.1 * std::sin(0.4) * std::cos(0.6);
      EXPECT_NEAR(result.contactBy, (1.0 - height) / speed, 0.02 / speed + 1e-12);
      // Past the edge of the sheet it is Free.
      for (Vector3d& v : a.soup.vertices) v.x() += 1.5;
      for (Vector3d& v : a.end) v.x() += 1.5;
      EXPECT_EQ(continuous(a.mesh(), b.mesh()).verdict, Verdict::Free);
    }
  }
}

TEST(DeformingImpacts, OfTwoMeshesAreThoseOfTheirUnion) {
  std::mt19937 random(8);
  const SoupMotion sheet{test::sheetSoup(11, 0.0, 0.0), test::sheetSoup(11, 0.4, 0.1).vertices};
  Soup blob = test::blobSoup(random, 8, 9);
  for (Vector3d& v : blob.vertices) v = 0.5 * v + Vector3d(0.0, 0.0, 0.75);
  SoupMotion fall{blob, blob.vertices};
  for (Vector3d& v : fall.end) v += Vector3d(0.1, 0.0, -0.7);
  SoupMotion both = sheet;
  both.soup.append(blob);
  both.end.insert(both.end.end(), fall.end.begin(), fall.end.end());

  const auto offset = static_cast<int>(sheet.soup.triangles.size());
  std::vector<TriangleImpact> expected;
  for (const TriangleImpact& impact : continuous(both.mesh()).impacts) {
    if (impact.first < offset && impact.second >= offset) {
      expected.push_back(impact);
      expected.back().second -= offset;
    }
  }
  const DeformingResult result = continuous(sheet.mesh(), fall.mesh());
  expectConsistent(result);
  EXPECT_GT(result.impacts.size(), 50U);
  ASSERT_EQ(result.impacts.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(result.impacts[i].first, expected[i].first);
    EXPECT_EQ(result.impacts[i].second, expected[i].second);
    // The edges of a pair may come in another order.
    EXPECT_NEAR(result.impacts[i].contactBy, expected[i].contactBy, 1e-5);
  }
  const DeformingResult turned = continuous(fall.mesh(), sheet.mesh());
  EXPECT_EQ(turned.impacts.size(), result.impacts.size());
  EXPECT_NEAR(turned.contactBy, result.contactBy, 1e-5);
}

TEST(DeformingImpacts, AgainstAMeshThatStandsStill) {
  const Soup ground = test::sheetSoup(10, 0.0, 0.0);
  const DeformingMesh still = DeformingMesh::build(ground.vertices, ground.triangles);
  std::mt19937 random(2);
  const Soup blob = test::blobSoup(random, 8, 9);
  DeformingMesh moving = DeformingMesh::build(blob.vertices, blob.triangles);
  std::vector<Vector3d> vertices = blob.vertices;
  for (Vector3d& v : vertices) v.z() += 3.0;
  moving.place(vertices);
  EXPECT_EQ(continuous(moving, still).verdict, Verdict::Free);
  EXPECT_EQ(continuous(moving, still).freeUntil, 1.0);
  for (Vector3d& v : vertices) v.z() -= 1.5;
  moving.moveTo(vertices);
  EXPECT_EQ(continuous(moving, still).verdict, Verdict::Free);
  for (Vector3d& v : vertices) v.z() -= 1.5;
  moving.moveTo(vertices);
  const DeformingResult result = continuous(moving, still);
  EXPECT_EQ(result.verdict, Verdict::Collision);
  EXPECT_GT(result.freeUntil, 0.2);
}

TEST(DeformingImpacts, WithoutMotionAreThePairsThatTouch) {
  const Soup soup = test::bouncing(0.4, 20);
  const SoupMotion still{soup, soup.vertices};
  DeformingMesh mesh = DeformingMesh::build(soup.vertices, soup.triangles);
  const auto expected = test::touchingPairs(soup.vertices, soup.triangles);
  ASSERT_GT(expected.size(), 50U);
  for (int way = 0; way < 3; ++way) {
    if (way == 1) mesh.place(soup.vertices);
    if (way == 2) mesh.moveTo(soup.vertices);
    const DeformingResult result = continuous(mesh);
    expectConsistent(result);
    std::set<TrianglePair> found;
    for (const TriangleImpact& impact : result.impacts) {
      found.insert({impact.first, impact.second});
      EXPECT_EQ(impact.freeUntil, 0.0);
      EXPECT_EQ(impact.contactBy, 0.0);
      EXPECT_LE(
          triangleDistance(still.corners(impact.first, 0.0), still.corners(impact.second, 0.0))
              .lower,
          1.01 * kTolerance);
    }
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
  }
}

TEST(DeformingImpacts, FirstOnlyIsTheEarliest) {
  int later = 0;
  for (int step = 0; step < 12; ++step) {
    // A body that comes down on a sheet.
    std::mt19937 random(static_cast<unsigned>(step));
    SoupMotion motion{test::sheetSoup(8, step, 0.0), test::sheetSoup(8, step + 0.2, 0.0).vertices};
    Soup blob = test::blobSoup(random, 7, 8);
    for (Vector3d& v : blob.vertices) v = 0.4 * v + Vector3d(0.0, 0.0, 0.6 - 0.02 * step);
    motion.soup.append(blob);
    for (const Vector3d& v : blob.vertices) motion.end.emplace_back(v - Vector3d(0.0, 0.2, 0.5));
    const DeformingResult all = continuous(motion.mesh());
    const DeformingResult first = continuous(motion.mesh(), {.firstOnly = true});
    expectConsistent(all);
    EXPECT_EQ(first.verdict, all.verdict);
    ASSERT_EQ(first.impacts.size(), all.impacts.empty() ? 0U : 1U);
    if (all.impacts.empty()) continue;
    later += all.contactBy > 0.0 ? 1 : 0;
    EXPECT_EQ(first.impacts[0].contactBy, first.contactBy);
    EXPECT_NEAR(first.contactBy, all.contactBy, 1e-5);
    EXPECT_LE(first.freeUntil, first.contactBy);
    EXPECT_NEAR(first.freeUntil, all.freeUntil, 1e-5);
    EXPECT_LE(first.effort.features, all.effort.features);
  }
  EXPECT_GT(later, 8);
}

TEST(DeformingImpacts, KeepASeparation) {
  // Two flat sheets that approach from 1 m to 0.3 m.
  Soup lower{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  SoupMotion a{lower, lower.vertices}, b = a;
  for (Vector3d& v : b.soup.vertices) v += Vector3d(0.2, 0.1, 1.0);
  for (Vector3d& v : b.end) v += Vector3d(0.2, 0.1, 0.3);
  for (const double separation : {0.0, 0.1, 0.29, 0.2999}) {
    EXPECT_EQ(continuous(a.mesh(), b.mesh(), {.separation = separation}).verdict, Verdict::Free);
  }
  for (const double separation : {0.3001, 0.5, 0.9}) {
    const DeformingResult result = continuous(a.mesh(), b.mesh(), {.separation = separation});
    EXPECT_EQ(result.verdict, Verdict::Collision);
    EXPECT_GE(result.impacts.size(), 3U);
    EXPECT_NEAR(result.contactBy, (1.0 - separation) / 0.7, 1e-5);
    EXPECT_LE(result.freeUntil, (1.0 - separation) / 0.7);
  }
  EXPECT_EQ(continuous(a.mesh(), b.mesh(), {.separation = 1.5}).contactBy, 0.0);
}

TEST(DeformingImpacts, OptionsThatAreNoNumbersDecideNothing) {
  const DeformingMesh mesh = test::bouncingStep(0.3, 0.1, 6).mesh();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const DeformingOptions& options :
       {DeformingOptions{.separation = nan}, DeformingOptions{.tolerance = nan}}) {
    const DeformingResult result = continuous(mesh, options);
    EXPECT_EQ(result.verdict, Verdict::Undecided);
    EXPECT_EQ(result.freeUntil, 0.0);
  }
}

TEST(DeformingImpacts, FeaturesOfNeighboursCountWhereNoOtherPairHasThem) {
  // A strip of two triangles folds along its diagonal until one corner passes through the other
  // triangle.
  const Soup strip{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}}, {{0, 1, 2}, {1, 3, 2}}};
  SoupMotion fold{strip, strip.vertices};
  fold.end[3] = {0.2, 0.2, -0.5};
  fold.soup.vertices[3] = {0.2, 0.2, 0.5};
  DeformingResult result = continuous(fold.mesh());
  ASSERT_EQ(result.impacts.size(), 1U);
  EXPECT_EQ(result.impacts[0].first, 0);
  EXPECT_EQ(result.impacts[0].second, 1);
  EXPECT_NEAR(result.contactBy, 0.5, 1e-5);
  // Beyond the other triangle nothing meets.
  for (Vector3d* v : {&fold.soup.vertices[3], &fold.end[3]}) *v += Vector3d(-0.5, -0.5, 0.0);
  fold.end[3].z() = 0.1;
  EXPECT_EQ(continuous(fold.mesh()).verdict, Verdict::Free);

  // A fan of so many triangles around one vertex that they are not looked at one by one.
  for (const int blades : {20, 300}) {
    Soup fan{{{0, 0, 0}}, {}};
    for (int i = 0; i <= blades; ++i) {
      const double angle = 5.0 * i / blades;
      fan.vertices.emplace_back(std::cos(angle), std::sin(angle), 0.0);
      if (i > 0) fan.triangles.emplace_back(0, i, i + 1);
    }
    SoupMotion flap{fan, fan.vertices};
    // The last rim vertex through the blade at the start.
    const double angle = 7.5 / blades;
    flap.soup.vertices.back() = Vector3d(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.5);
    flap.end.back() = Vector3d(0.5 * std::cos(angle), 0.5 * std::sin(angle), -0.5);
    result = continuous(flap.mesh());
    bool found = false;
    for (const TriangleImpact& impact : result.impacts)
      found |= impact.first == 1 && impact.second == blades - 1;
    EXPECT_TRUE(found) << blades;
  }
}

TEST(SurfaceFeatures, MarkAllThatHaveOrphans) {
  std::mt19937 random(11);
  int orphans = 0, marked = 0, triangles = 0;
  for (int round = 0; round < 60; ++round) {
    // Few vertices: connected in every odd way.
    const int vertices = 4 + round % 12;
    std::uniform_int_distribution<int> any(0, vertices - 1);
    std::vector<Eigen::Vector3i> soup(static_cast<std::size_t>(3 + round % 9));
    for (Eigen::Vector3i& t : soup) t = {any(random), any(random), any(random)};
    const detail::SurfaceFeatures surface(static_cast<std::size_t>(vertices), soup);
    const auto share = [&](int t, int u) {
      return shareVertex(surface.triangle(t), surface.triangle(u));
    };
    const auto has = [&](int t, int v) { return (surface.triangle(t).array() == v).any(); };
    const auto count = static_cast<int>(soup.size());
    for (int t = 0; t < count; ++t) {
      for (int u = 0; u < count; ++u) {
        for (int i = 0; i < 3; ++i) {
          const int v = surface.triangle(t)[i], w = surface.triangle(t)[(i + 1) % 3];
          bool covered = has(u, v);
          for (int s = 0; s < count; ++s) covered |= has(s, v) && !share(s, u);
          const auto bothMarked = [&] {
            return surface.marks()[static_cast<std::size_t>(t)] != 0 &&
                   surface.marks()[static_cast<std::size_t>(u)] != 0;
          };
          if (!covered) {
            EXPECT_TRUE(bothMarked());
          }
          orphans += covered ? 0 : 1;
          for (int j = 0; j < 3; ++j) {
            const int x = surface.triangle(u)[j], y = surface.triangle(u)[(j + 1) % 3];
            if (v == x || v == y || w == x || w == y || v == w || x == y) continue;
            EXPECT_EQ(surface.edge(t, i) == surface.edge(u, j), false);
            if (surface.areOrphans(surface.edge(t, i), surface.edge(u, j))) {
              EXPECT_TRUE(bothMarked());
            }
          }
        }
      }
      marked += surface.marks()[static_cast<std::size_t>(t)];
      ++triangles;
    }
  }
  EXPECT_GT(orphans, 100);
  EXPECT_GT(marked, triangles / 10);

  const Soup torus = test::torusSoup(12, 9, 1.0, 0.3);
  const detail::SurfaceFeatures closed(torus.vertices.size(), torus.triangles);
  EXPECT_EQ(std::count(closed.marks().begin(), closed.marks().end(), 1), 0);
}

TEST(DeformingImpacts, DependOnNothingBefore) {
  const SoupMotion motion = test::bouncingStep(0.3, 0.1);
  const DeformingMesh mesh = motion.mesh();
  const DeformingResult expected = continuous(mesh);
  ASSERT_GT(expected.impacts.size(), 100U);
  DeformingWorkspace workspace;
  DeformingResult result;
  for (int round = 0; round < 3; ++round) {
    selfCollideContinuous(test::bouncingStep(1.0 + round, 0.2, 8).mesh(), {.firstOnly = round == 1},
                          result, workspace);
    selfCollideContinuous(mesh, {}, result, workspace);
    EXPECT_EQ(result.impacts, expected.impacts);
    EXPECT_EQ(result.freeUntil, expected.freeUntil);
    EXPECT_EQ(result.effort.features, expected.effort.features);
  }
}

}  // namespace
}  // namespace swept
