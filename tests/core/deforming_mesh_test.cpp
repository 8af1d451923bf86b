// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/continuous/deforming_mesh.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "deforming_samples.hpp"
#include "simd_targets.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using test::Soup;
using test::SoupMotion;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<TrianglePair> discrete(const DeformingMesh& mesh) {
  MeshCollisionResult result;
  DeformingWorkspace workspace;
  selfCollide(mesh, {test::kEveryPair}, result, workspace);
  EXPECT_EQ(result.touching, !result.pairs.empty());
  return result.pairs;
}

TEST(DeformingMesh, FindsThePairsThatSelfCollideMeshFinds) {
  std::size_t touching = 0;
  DeformingMesh mesh =
      DeformingMesh::build(test::bouncing(0.0).vertices, test::bouncing(0.0).triangles);
  for (int frame = 0; frame < 25; ++frame) {
    const Soup soup = test::bouncing(0.13 * frame);
    if (frame % 3 == 0) {
      mesh.place(soup.vertices);
    } else {
      mesh.moveTo(soup.vertices);
    }
    const auto expected = test::touchingPairs(soup.vertices, soup.triangles);
    ASSERT_EQ(discrete(mesh), expected) << "frame " << frame;
    touching += expected.size();
  }
  EXPECT_GT(touching, 1000U);
}

TEST(DeformingMesh, FindsThemAmongTrianglesOfAnyKind) {
  std::mt19937 random(3);
  std::size_t touching = 0, frames = 0;
  for (const int count : {1, 2, 7, 8, 9, 63, 64, 65, 513, 700}) {
    for (const double size : {0.0, 0.02, 0.3}) {
      const SoupMotion motion = test::randomTriangles(random, count, size, 0.5);
      DeformingMesh mesh = motion.mesh();
      for (const auto* vertices : {&motion.end, &motion.soup.vertices}) {
        mesh.moveTo(*vertices);
        const auto expected = test::touchingPairs(*vertices, motion.soup.triangles);
        ASSERT_EQ(discrete(mesh), expected) << count << " of size " << size;
        touching += expected.size();
        ++frames;
      }
    }
  }
  EXPECT_GT(touching, 10 * frames);
}

TEST(DeformingMesh, FindsThemAtAnyScaleAndPlace) {
  for (const double scale : {1e-30, 1e-9, 1e-3, 1e3, 1e20, 1e40}) {
    Soup soup = test::bouncing(0.4, 12);
    for (Vector3d& v : soup.vertices) v *= scale;
    const auto expected = test::touchingPairs(soup.vertices, soup.triangles);
    ASSERT_GT(expected.size(), 10U);
    EXPECT_EQ(discrete(DeformingMesh::build(soup.vertices, soup.triangles)), expected) << scale;
  }
  for (const double offset : {1e3, 1e6, 1e12}) {
    Soup soup = test::bouncing(0.4, 6);
    for (Vector3d& v : soup.vertices) v += Vector3d(offset, -offset, 0.3 * offset);
    const auto expected = test::touchingPairs(soup.vertices, soup.triangles);
    EXPECT_EQ(discrete(DeformingMesh::build(soup.vertices, soup.triangles)), expected) << offset;
  }
}

TEST(DeformingMesh, CollidesWithAnother) {
  DeformingWorkspace workspace;
  MeshCollisionResult result;
  std::size_t touching = 0;
  std::mt19937 random(4);
  const Soup blob = test::blobSoup(random, 14, 20);
  for (const int n : {1, 3, 20}) {
    for (int frame = 0; frame < 6; ++frame) {
      Soup moved = blob;
      for (Vector3d& v : moved.vertices) v += Vector3d(0.1 * frame, 0.0, 0.1 * frame - 0.4);
      const Soup sheet = test::sheetSoup(n, 0.3 * frame, 0.0);
      const DeformingMesh a = DeformingMesh::build(moved.vertices, moved.triangles);
      const DeformingMesh b = DeformingMesh::build(sheet.vertices, sheet.triangles);
      const SoupMotion stillA{moved, moved.vertices}, stillB{sheet, sheet.vertices};
      std::vector<TrianglePair> expected;
      for (int t = 0; t < static_cast<int>(moved.triangles.size()); ++t) {
        for (int u = 0; u < static_cast<int>(sheet.triangles.size()); ++u) {
          if (trianglesTouch(stillA.corners(t, 0.0), stillB.corners(u, 0.0)))
            expected.push_back({t, u});
        }
      }
      collide(a, b, {test::kEveryPair}, result, workspace);
      ASSERT_EQ(result.pairs, expected);
      collide(b, a, {1}, result, workspace);
      EXPECT_EQ(result.pairs.size(), std::min<std::size_t>(1, expected.size()));
      EXPECT_EQ(result.touching, !expected.empty());
      touching += expected.size();
    }
  }
  EXPECT_GT(touching, 200U);
}

TEST(DeformingMesh, StopsAtTheNumberOfPairsAskedFor) {
  const Soup soup = test::bouncing(0.4);
  const DeformingMesh mesh = DeformingMesh::build(soup.vertices, soup.triangles);
  MeshCollisionResult result;
  DeformingWorkspace workspace;
  const std::vector<TrianglePair> all = discrete(mesh);
  ASSERT_GT(all.size(), 20U);
  for (const std::size_t most : {std::size_t{1}, std::size_t{5}, all.size(), all.size() + 1}) {
    selfCollide(mesh, {most}, result, workspace);
    EXPECT_EQ(result.pairs.size(), std::min(most, all.size()));
    EXPECT_TRUE(std::includes(all.begin(), all.end(), result.pairs.begin(), result.pairs.end()));
  }
}

TEST(DeformingMesh, RefusesWhatItCannotHold) {
  const Soup soup = test::bouncing(0.0, 6);
  DeformingMesh mesh = DeformingMesh::build(soup.vertices, soup.triangles);
  const std::vector<TrianglePair> before = discrete(mesh);
  for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    for (const std::size_t at :
         {std::size_t{0}, soup.vertices.size() / 2, soup.vertices.size() - 1}) {
      std::vector<Vector3d> vertices = test::bouncing(0.4, 6).vertices;
      vertices[at].y() = bad;
      EXPECT_THROW(mesh.moveTo(vertices), std::invalid_argument);
      EXPECT_THROW(mesh.place(vertices), std::invalid_argument);
      EXPECT_THROW(DeformingMesh::build(vertices, soup.triangles), std::invalid_argument);
    }
  }
  EXPECT_THROW(mesh.moveTo(std::span(soup.vertices).first(3)), std::invalid_argument);
  EXPECT_EQ(discrete(mesh), before);
  EXPECT_THROW(DeformingMesh::build(soup.vertices, {}), std::invalid_argument);
  const std::vector<Eigen::Vector3i> beyond{{0, 1, static_cast<int>(soup.vertices.size())}};
  const std::vector<Eigen::Vector3i> negative{{0, -1, 2}};
  EXPECT_THROW(DeformingMesh::build(soup.vertices, beyond), std::invalid_argument);
  EXPECT_THROW(DeformingMesh::build(soup.vertices, negative), std::invalid_argument);
}

TEST(DeformingMesh, BuildsAnewWhereTrianglesMixed) {
  const Soup soup = test::sheetSoup(30, 0.0, 0.0);
  DeformingMesh sheet = DeformingMesh::build(soup.vertices, soup.triangles);
  sheet.moveTo(test::sheetSoup(30, 0.5, 0.2).vertices);
  EXPECT_EQ(sheet.rebuilds(), 0U);
  EXPECT_LT(sheet.growth(), 1.2);

  // Triangles that change places: what was side by side is no more.
  std::mt19937 random(9);
  SoupMotion motion = test::randomTriangles(random, 600, 0.1, 0.0);
  std::vector<int> places(600);
  std::iota(places.begin(), places.end(), 0);
  std::shuffle(places.begin(), places.end(), random);
  for (std::size_t v = 0; v < motion.end.size(); ++v)
    motion.end[v] = motion.soup.vertices[static_cast<std::size_t>(places[v / 3]) * 3 + v % 3];
  DeformingMesh mesh = DeformingMesh::build(motion.soup.vertices, motion.soup.triangles);
  mesh.moveTo(motion.end);
  EXPECT_EQ(mesh.rebuilds(), 1U);
  EXPECT_DOUBLE_EQ(mesh.growth(), 1.0);
  const auto expected = test::touchingPairs(motion.end, motion.soup.triangles);
  EXPECT_GT(expected.size(), 50U);
  EXPECT_EQ(discrete(mesh), expected);
  // The start of the step is still known.
  DeformingResult before, after;
  DeformingWorkspace workspace;
  selfCollideContinuous(mesh, {}, after, workspace);
  mesh.rebuild();
  selfCollideContinuous(mesh, {}, before, workspace);
  EXPECT_EQ(before.impacts, after.impacts);
  EXPECT_GT(after.impacts.size(), 2 * expected.size());
}

TEST(DeformingMesh, UnfoldsFromAPoint) {
  const Soup soup = test::bouncing(0.4);
  const std::vector<Vector3d> point(soup.vertices.size(), Vector3d::Ones());
  DeformingMesh mesh = DeformingMesh::build(point, soup.triangles);
  EXPECT_EQ(mesh.growth(), 1.0);
  mesh.moveTo(point);
  EXPECT_EQ(mesh.rebuilds(), 0U);
  mesh.moveTo(soup.vertices);
  EXPECT_EQ(mesh.rebuilds(), 1U);
  EXPECT_EQ(discrete(mesh), test::touchingPairs(soup.vertices, soup.triangles));
  mesh.moveTo(point);
  mesh.moveTo(soup.vertices);
  EXPECT_EQ(discrete(mesh), test::touchingPairs(soup.vertices, soup.triangles));
}

TEST(DeformingMesh, CopiesAreTheirOwn) {
  const Soup soup = test::bouncing(0.4, 8);
  DeformingMesh mesh = DeformingMesh::build(soup.vertices, soup.triangles);
  DeformingMesh copy = mesh;
  const std::vector<TrianglePair> before = discrete(copy);
  mesh.moveTo(test::bouncing(1.1, 8).vertices);
  EXPECT_NE(discrete(mesh), before);
  EXPECT_EQ(discrete(copy), before);
  copy = mesh;
  EXPECT_EQ(discrete(copy), discrete(mesh));
}

class DeformingMeshTargets : public testing::TestWithParam<std::int64_t> {
 private:
  simd_test::OnTarget on_{GetParam()};
};

TEST_P(DeformingMeshTargets, FindTheSame) {
  const SoupMotion motion = test::bouncingStep(0.3, 0.1, 10);
  EXPECT_EQ(discrete(motion.mesh()), test::touchingPairs(motion.end, motion.soup.triangles));
  DeformingResult result;
  DeformingWorkspace workspace;
  selfCollideContinuous(motion.mesh(), {}, result, workspace);
  std::set<TrianglePair> found;
  for (const TriangleImpact& impact : result.impacts) found.insert({impact.first, impact.second});
  std::size_t later = 0;
  for (const TrianglePair& pair : test::sampledPairs(motion, 40)) {
    EXPECT_TRUE(found.contains(pair));
    ++later;
  }
  EXPECT_GT(later, 40U);
}

INSTANTIATE_TEST_SUITE_P(Targets, DeformingMeshTargets, testing::ValuesIn(simd_test::simdTargets()),
                         [](const auto& target) {
                           return std::string(hwy::TargetName(target.param));
                         });

}  // namespace
}  // namespace swept
