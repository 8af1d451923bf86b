// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "deforming_samples.hpp"
#include "heap_counter.hpp"

namespace swept {
namespace {

TEST(DeformingMesh, AllocatesNothingOnceItWentThroughItsMotion) {
  constexpr int kFrames = 10;
  std::vector<std::vector<Eigen::Vector3d>> frames;
  for (int f = 0; f < kFrames; ++f) frames.push_back(test::bouncing(0.1 * f, 8).vertices);
  const test::Soup soup = test::bouncing(0.0, 8);
  const test::Soup sheet = test::sheetSoup(9, 0.0, 0.2);
  DeformingMesh mesh = DeformingMesh::build(soup.vertices, soup.triangles);
  const DeformingMesh still = DeformingMesh::build(sheet.vertices, sheet.triangles);
  DeformingWorkspace workspace;
  MeshCollisionResult touching;
  DeformingResult impacts;
  std::size_t found = 0;
  long before = 0;
  for (int round = 0; round < 3; ++round) {
    if (round == 1) before = test::allocations;
    mesh.place(frames[0]);
    for (int f = 1; f < kFrames; ++f) {
      mesh.moveTo(frames[static_cast<std::size_t>(f)]);
      selfCollide(mesh, {test::kEveryPair}, touching, workspace);
      found += touching.pairs.size();
      collide(mesh, still, {test::kEveryPair}, touching, workspace);
      found += touching.pairs.size();
      for (const bool firstOnly : {false, true}) {
        selfCollideContinuous(mesh, {.firstOnly = firstOnly}, impacts, workspace);
        found += impacts.impacts.size();
        collideContinuous(mesh, still, {.firstOnly = firstOnly}, impacts, workspace);
        found += impacts.impacts.size();
      }
    }
  }
  EXPECT_EQ(test::allocations, before);
  EXPECT_EQ(mesh.rebuilds(), 0U);
  EXPECT_GT(found, 1000U);
}

/// Of a closed surface, both ends of a step.
TEST(DeformingMesh, TakesLessThan200BytesPerTriangle) {
  const test::Soup soup = test::bouncing(0.0, 40);
  const long before = test::heldBytes;
  const DeformingMesh mesh = DeformingMesh::build(soup.vertices, soup.triangles);
  const double each =
      static_cast<double>(test::heldBytes - before) / static_cast<double>(soup.triangles.size());
  EXPECT_GT(mesh.triangleCount(), 5000U);
  EXPECT_LT(each, 200.0);
  EXPECT_GT(each, 100.0);
}

}  // namespace
}  // namespace swept
