// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/traversal/front_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "all_volumes.hpp"
#include "bvh_models.hpp"
#include "mesh_samples.hpp"
#include "swept/core/traversal/mesh_collision.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::modelOf;

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// A slow tumble past and through the other body and back: frame `i` of `frames`.
Isometry3d tumble(int i, int frames) {
  const double t = 2.0 * std::numbers::pi * i / frames;
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = (Eigen::AngleAxisd(t, Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(0.7 * std::sin(t), Vector3d::UnitX()))
                      .toRotationMatrix();
  pose.translation() =
      Vector3d(1.75 - 0.6 * std::sin(2.0 * t), 0.3 * std::cos(t), 0.2 * std::sin(t));
  return pose;
}

struct Effort {
  std::int64_t scratch = 0;
  std::int64_t front = 0;
  int touching = 0;
};

/// Asks from scratch and from the front, and compares.
template <typename BV, typename PoseOf>
Effort runBoth(const BvhModel<BV>& a, const BvhModel<BV>& b, int frames, std::size_t maxPairs,
               const PoseOf& poseOf) {
  FrontList front;
  MeshCollisionResult scratch;
  MeshCollisionResult warm;
  Effort effort;
  for (int i = 0; i < frames; ++i) {
    const Isometry3d pose = poseOf(i);
    collideMeshes(a, b, pose, {maxPairs}, scratch);
    collideMeshes(a, b, pose, {maxPairs}, warm, &front);
    EXPECT_EQ(warm.touching, scratch.touching) << i;
    if (maxPairs == kAll) {
      std::sort(scratch.pairs.begin(), scratch.pairs.end());
      std::sort(warm.pairs.begin(), warm.pairs.end());
      EXPECT_EQ(warm.pairs, scratch.pairs) << i;
    }
    effort.scratch += scratch.effort.bvTests;
    effort.front += warm.effort.bvTests;
    effort.touching += scratch.touching;
  }
  return effort;
}

template <typename BV>
class FrontLists : public testing::Test {};
TYPED_TEST_SUITE(FrontLists, test::AllVolumes);

TYPED_TEST(FrontLists, CoherentMotionTakesThirtyPercentFewerTests) {
  std::mt19937 random(51);
  const auto a = modelOf<TypeParam>(test::blobSoup(random, 16, 24));
  const auto b = modelOf<TypeParam>(test::blobSoup(random, 14, 20));
  constexpr int kFrames = 300;
  const Effort effort = runBoth(a, b, kFrames, kAll, [](int i) { return tumble(i, kFrames * 2); });
  EXPECT_LT(static_cast<double>(effort.front), 0.7 * static_cast<double>(effort.scratch));
  EXPECT_GT(effort.touching, 0.3 * kFrames);
  EXPECT_LT(effort.touching, 0.9 * kFrames);
  this->RecordProperty("bv_tests_from_scratch", std::to_string(effort.scratch));
  this->RecordProperty("bv_tests_from_front", std::to_string(effort.front));
}

TYPED_TEST(FrontLists, AnyMotionGivesTheSameAnswers) {
  std::mt19937 random(52);
  const auto a = modelOf<TypeParam>(test::blobSoup(random, 8, 12));
  const auto b = modelOf<TypeParam>(test::blobSoup(random, 8, 12));
  for (const std::size_t maxPairs : {kAll, std::size_t{1}, std::size_t{4}}) {
    const Effort effort =
        runBoth(a, b, 200, maxPairs, [&random](int) { return test::randomPose(random, 1.6); });
    EXPECT_GT(effort.touching, 0.3 * 200);
    EXPECT_LT(effort.touching, 0.7 * 200);
  }
}

TEST(FrontList, StaysBoundedOverAThousandFrames) {
  std::mt19937 random(53);
  const auto a = modelOf<Obb>(test::blobSoup(random, 12, 18));
  const auto b = modelOf<Obb>(test::blobSoup(random, 12, 18));
  FrontList front;
  MeshCollisionResult result;
  constexpr int kFrames = 1000;
  std::vector<std::size_t> sizes;
  for (int i = 0; i < kFrames; ++i) {
    collideMeshes(a, b, tumble(5 * i, kFrames), {kAll}, result, &front);  // five rounds
    sizes.push_back(front.size());
  }
  const auto firstRound = sizes.begin() + kFrames / 5;
  const std::size_t largest = *std::max_element(sizes.begin(), firstRound);
  EXPECT_LE(*std::max_element(firstRound, sizes.end()), largest + largest / 5);
  // Not all pairs of leaves either.
  EXPECT_LT(largest, a.tree().order().size() * b.tree().order().size() / 20);
}

TEST(FrontList, MovesUpAgainWhenTheBodiesPart) {
  std::mt19937 random(54);
  const auto a = modelOf<Obb>(test::blobSoup(random, 12, 18));
  FrontList front;
  MeshCollisionResult result;
  Isometry3d pose = Isometry3d::Identity();
  pose.translation().x() = 0.5;
  collideMeshes(a, a, pose, {kAll}, result, &front);
  ASSERT_TRUE(result.touching);
  const std::size_t deep = front.size();
  ASSERT_GT(deep, 500U);
  pose.translation().x() = 10.0;
  for (int i = 0; i < 400; ++i) collideMeshes(a, a, pose, {kAll}, result, &front);
  EXPECT_FALSE(result.touching);
  EXPECT_EQ(front.size(), 1U);
  EXPECT_EQ(result.effort.bvTests, 1);
  // And down once more, with the memory it has.
  pose.translation().x() = 0.5;
  collideMeshes(a, a, pose, {kAll}, result, &front);
  EXPECT_EQ(front.size(), deep);
  front.clear();
  EXPECT_EQ(front.size(), 0U);
}

TEST(FrontList, FollowsRefittedModels) {
  std::mt19937 random(55);
  test::Soup soup = test::blobSoup(random, 8, 12);
  auto a = modelOf<Obb>(soup);
  const auto b = modelOf<Obb>(test::blobSoup(random, 8, 12));
  Isometry3d pose = Isometry3d::Identity();
  pose.translation().x() = 1.83;
  FrontList front;
  MeshCollisionResult scratch;
  MeshCollisionResult warm;
  int touching = 0;
  for (int i = 0; i < 60; ++i) {
    for (Vector3d& v : soup.vertices) v *= i % 20 < 10 ? 1.03 : 1.0 / 1.03;
    a.beginReplace();
    a.replaceVertices(0, soup.vertices);
    a.endReplace();
    collideMeshes(a, b, pose, {kAll}, scratch);
    collideMeshes(a, b, pose, {kAll}, warm, &front);
    std::sort(scratch.pairs.begin(), scratch.pairs.end());
    std::sort(warm.pairs.begin(), warm.pairs.end());
    EXPECT_EQ(warm.pairs, scratch.pairs) << i;
    touching += scratch.touching;
  }
  EXPECT_GT(touching, 18);
  EXPECT_LT(touching, 42);
}

/// Pairs of nodes of trees that are gone: touching triangles were missed.
TEST(FrontList, NoticesTreesThatAreNotItsOwn) {
  std::mt19937 random(56);
  test::Soup soup = test::blobSoup(random, 8, 12);
  auto a = modelOf<Obb>(soup);
  const auto b = modelOf<Obb>(test::blobSoup(random, 8, 12));
  const auto small = modelOf<Obb>(test::blobSoup(random, 3, 4));
  FrontList front;
  MeshCollisionResult scratch;
  MeshCollisionResult warm;
  const auto compare = [&](const BvhModel<Obb>& first, const BvhModel<Obb>& second) {
    Isometry3d pose = Isometry3d::Identity();
    pose.translation().x() = 0.7;
    collideMeshes(first, second, pose, {kAll}, scratch);
    collideMeshes(first, second, pose, {kAll}, warm, &front);
    std::sort(scratch.pairs.begin(), scratch.pairs.end());
    std::sort(warm.pairs.begin(), warm.pairs.end());
    EXPECT_EQ(warm.pairs, scratch.pairs);
    EXPECT_FALSE(warm.pairs.empty());
  };
  for (int i = 0; i < 10; ++i) {
    std::rotate(soup.vertices.begin(), soup.vertices.begin() + 7, soup.vertices.end());
    a.beginReplace();
    a.replaceVertices(0, soup.vertices);
    a.endReplace(i % 3 == 0 ? Refresh::Refit : Refresh::Rebuild);
    compare(a, b);
    if (i % 4 == 1) compare(b, a);
    if (i % 4 == 2) compare(small, b);
    if (i % 4 == 3) compare(a, small);
  }
  // Those of a copy are: the front stays, and spares tests.
  compare(a, b);
  compare(a, b);
  compare(a, BvhModel<Obb>(b));
  EXPECT_LT(warm.effort.bvTests, scratch.effort.bvTests);
}

}  // namespace
}  // namespace swept
