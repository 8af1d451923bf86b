// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/box_bounds.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <cmath>

#include "reference_distance.hpp"
#include "simd_targets.hpp"

namespace swept::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d vectorOf(const std::array<float, 3>& v) {
  return {v[0], v[1], v[2]};
}

struct Placed {
  Isometry3d pose;
  Vector3d half;
};

bool anyCornerInside(const Placed& a, const Placed& b) {
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner((i & 1 ? 1 : -1) * a.half.x(), (i & 2 ? 1 : -1) * a.half.y(),
                          (i & 4 ? 1 : -1) * a.half.z());
    if (reference::pointBox(b.pose.inverse() * (a.pose * corner), b.half) == 0.0) return true;
  }
  return false;
}

double boxDistance(const Placed& a, const Placed& b) {
  if (anyCornerInside(a, b) || anyCornerInside(b, a)) return 0.0;
  return reference::surfaces(reference::boxTriangles(a.half, a.pose),
                             reference::boxTriangles(b.half, b.pose));
}

OrientedBox randomBox(reference::Random& random, double size, double spread) {
  OrientedBox box;
  // Along the axes of the frame, too, where edges are parallel to those of others.
  const Isometry3d pose =
      random.uniform(0.0, 1.0) < 0.2 ? Isometry3d::Identity() : random.pose(0.0);
  for (int i = 0; i < 3; ++i) {
    box.center[i] = static_cast<float>(random.uniform(-spread, spread));
    // Thin ones too: edges matter then.
    box.half[i] = static_cast<float>(size * std::pow(10.0, random.uniform(-1.5, 0.0)));
    for (int j = 0; j < 3; ++j) box.axes[j][i] = static_cast<float>(pose.linear()(i, j));
  }
  return box;
}

Placed placed(const OrientedBox& box, const Isometry3d& frame) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() = box.center;
  for (int j = 0; j < 3; ++j) pose.linear().col(j) = vectorOf(box.axes[j]);
  return {frame * pose, vectorOf(box.half)};
}

double reachOf(const OrientedBox& box) {
  return box.center.cwiseAbs().sum() + std::sqrt(3.0) * vectorOf(box.half).sum();
}

WideNode emptyNode(const Vector3d& origin) {
  WideNode node{};
  node.origin = origin;
  return node;
}

/// Every instruction set that is compiled and that this machine has, one after the other.
class BoxBounds : public testing::TestWithParam<std::int64_t> {
 private:
  simd_test::OnTarget on_{GetParam()};
};

/// The squares of gaps below 1e-22 m are no normal numbers in single precision, and rounded up the
/// bounds were above the distance by a tenth: a ball was proven to be farther from a point of a
/// cloud than it was, where their bodies are larger and the two happen to be so near.
TEST_P(BoxBounds, AreNoneWhereSquaresUnderflow) {
  reference::Random random(12);
  WideNode node = emptyNode(Vector3d::Zero());
  node.count = WideNode::kLanes;
  for (int lane = 0; lane < node.count; ++lane) node.set(lane, OrientedBox{});
  const BoxFrames frames(Isometry3d::Identity(), 1e-11);
  ASSERT_TRUE(frames.usable());
  int positive = 0;
  for (int i = 0; i < 20000; ++i) {
    OrientedBox other;
    const Vector3d away = std::pow(10.0, random.uniform(-23.5, -19.0)) * random.direction();
    other.center = away.cast<float>().cast<double>();
    std::array<float, WideNode::kLanes> lower{};
    boxLowerBounds(node, frames, other, std::numeric_limits<float>::infinity(), lower);
    ASSERT_LE(lower[0], other.center.norm());
    positive += lower[0] > 0.0F ? 1 : 0;
  }
  EXPECT_GT(positive, 5000);
}

TEST_P(BoxBounds, AreNeverAboveTheDistanceAndSeldomFarBelow) {
  reference::Random random(11);
  int apart = 0, positive = 0, close = 0, total = 0;
  for (int round = 0; round < 400; ++round) {
    const double scale = std::pow(10.0, random.uniform(-6.0, 6.0));
    Isometry3d first_from_second = random.pose(0.6 * scale);
    WideNode node = emptyNode(random.vector(0.5 * scale).cast<float>().cast<double>());
    node.count = 1 + round % WideNode::kLanes;
    double reach = 0.0;
    std::array<OrientedBox, WideNode::kLanes> boxes;
    for (int lane = 0; lane < node.count; ++lane) {
      node.set(lane, randomBox(random, 0.7 * scale, 0.5 * scale));
      boxes[lane] = node.box(lane);
      reach = std::max(reach, reachOf(boxes[lane]));
    }
    const OrientedBox other = randomBox(random, 0.7 * scale, 0.5 * scale);
    const BoxFrames frames(first_from_second, reach + reachOf(other));
    ASSERT_TRUE(frames.usable());
    std::array<float, WideNode::kLanes> lower{};
    boxLowerBounds(node, frames, other, std::numeric_limits<float>::infinity(), lower);
    for (int lane = 0; lane < node.count; ++lane) {
      const Placed a = placed(boxes[lane], Isometry3d::Identity());
      const Placed b = placed(other, first_from_second);
      const double distance = boxDistance(a, b);
      EXPECT_LE(lower[lane], distance * (1.0 + 1e-12));
      const BoxGap gap = boxGap(boxes[lane], frames, other);
      EXPECT_LE(gap.value, distance * (1.0 + 1e-12));
      if (gap.value > 0.0) {
        // The direction proves it: check over all corners.
        double least = std::numeric_limits<double>::infinity();
        for (const auto& s : reference::boxTriangles(b.half, b.pose)) {
          for (const auto& t : reference::boxTriangles(a.half, a.pose)) {
            for (int k = 0; k < 9; ++k) {
              least = std::min(least, gap.direction.dot(s[k / 3] - t[k % 3]));
            }
          }
        }
        EXPECT_GE(least, gap.value);
        EXPECT_NEAR(gap.direction.norm(), 1.0, 1e-12);
      }
      ++total;
      apart += distance > 0.0 ? 1 : 0;
      positive += distance > 0.0 && lower[lane] > 0.0F && gap.value > 0.0 ? 1 : 0;
      close += distance > 0.0 && lower[lane] > 0.8 * distance ? 1 : 0;
    }
  }
  EXPECT_GT(apart, total * 3 / 10);
  EXPECT_LT(apart, total * 9 / 10);
  EXPECT_GT(positive, apart * 99 / 100);
  EXPECT_GT(close, apart * 85 / 100);
}

TEST_P(BoxBounds, MayStopEarlyOnlyBeyondEnough) {
  reference::Random random(12);
  int stopped = 0;
  for (int round = 0; round < 500; ++round) {
    WideNode node = emptyNode(Vector3d::Zero());
    node.count = WideNode::kLanes;
    for (int lane = 0; lane < WideNode::kLanes; ++lane) {
      node.set(lane, randomBox(random, 0.3, 1.0));
    }
    const OrientedBox other = randomBox(random, 0.3, 1.0);
    const BoxFrames frames(random.pose(4.0), 12.0);
    std::array<float, WideNode::kLanes> full{};
    std::array<float, WideNode::kLanes> early{};
    boxLowerBounds(node, frames, other, std::numeric_limits<float>::infinity(), full);
    const float enough = static_cast<float>(random.uniform(0.0, 1.0));
    boxLowerBounds(node, frames, other, enough, early);
    for (int lane = 0; lane < WideNode::kLanes; ++lane) {
      EXPECT_LE(early[lane], full[lane]);
      if (early[lane] < full[lane]) {
        ++stopped;
        EXPECT_GT(early[lane], enough * (1.0F - 2e-6F));
      }
    }
  }
  EXPECT_GT(stopped, 20);
}

using Vector3l = Eigen::Matrix<long double, 3, 1>;

/// Times the length of `along`: how far the box reaches at most, its axes being what they are.
long double extentAlong(const OrientedBox& box, const Vector3l& along) {
  const long double size =
      static_cast<long double>(box.half[0]) + box.half[1] + static_cast<long double>(box.half[2]);
  long double extent = 0.0L;
  for (int j = 0; j < 3; ++j) {
    const Vector3l axis = vectorOf(box.axes[j]).cast<long double>();
    extent += (static_cast<long double>(box.half[j]) + 4.0L * 0x1p-24L * size) *
              std::abs(along.dot(axis));
  }
  return extent;
}

/// m. What the boxes are apart along a direction of any length, from the first to the second.
long double separationAlong(const OrientedBox& box, const Isometry3d& first_from_second,
                            const OrientedBox& other, const Vector3d& direction) {
  const Eigen::Matrix<long double, 3, 3> linear = first_from_second.linear().cast<long double>();
  const Vector3l along = direction.cast<long double>();
  const Vector3l center = linear * other.center.cast<long double>() +
                          first_from_second.translation().cast<long double>() -
                          box.center.cast<long double>();
  const long double extents =
      extentAlong(box, along) + extentAlong(other, linear.transpose() * along);
  return (along.dot(center) - extents) / std::sqrt(along.squaredNorm());
}

/// Boxes of all kinds around a box: in general position, flat ones, needles, points, the box itself
/// and boxes that touch a face of it.
OrientedBox partnerOf(const OrientedBox& box, int kind, double scale, reference::Random& random) {
  OrientedBox other = randomBox(random, 0.7 * scale, 0.5 * scale);
  if (kind % 8 == 1) other.half[0] = 0.0F;
  if (kind % 8 == 2) other.half[0] = other.half[1] = 0.0F;
  if (kind % 8 == 3) other.half = {};
  if (kind % 8 == 4) other = box;
  if (kind % 8 == 5) {
    other = box;
    other.center += 2.0 * static_cast<double>(box.half[1]) * vectorOf(box.axes[1]);
  }
  return other;
}

struct Neighbors {
  double scale;
  Isometry3d first_from_second;
  WideNode node;
  OrientedBox other;
  BoxFrames frames;

  /// m. What a gap may be below the separation: what rounding is allowed, and the axes.
  double slack(int lane) const {
    const OrientedBox box = node.box(lane);
    const Vector3d center = first_from_second * other.center - box.center;
    const double size =
        center.cwiseAbs().sum() + vectorOf(box.half).sum() + vectorOf(other.half).sum();
    return 1.01 * (frames.rounding + frames.perMetre * size);
  }
};

Neighbors neighbors(int round, reference::Random& random) {
  Neighbors all;
  all.scale = std::pow(10.0, random.uniform(-6.0, 6.0));
  const bool still = round % 8 == 4 || round % 8 == 5;
  all.first_from_second = still ? Isometry3d::Identity() : random.pose(0.6 * all.scale);
  all.node = emptyNode(random.vector(0.5 * all.scale).cast<float>().cast<double>());
  all.node.count = WideNode::kLanes;
  double reach = 0.0;
  for (int lane = 0; lane < WideNode::kLanes; ++lane) {
    all.node.set(lane, randomBox(random, 0.7 * all.scale, 0.5 * all.scale));
    reach = std::max(reach, reachOf(all.node.box(lane)));
  }
  all.other = partnerOf(all.node.box(round % WideNode::kLanes), round, all.scale, random);
  all.frames = BoxFrames(all.first_from_second, reach + reachOf(all.other));
  return all;
}

TEST_P(BoxBounds, AlongTheirDirectionsTheBoxesAreAsFarApart) {
  reference::Random random(14);
  int apart = 0, total = 0, best = 0;
  for (int round = 0; round < 1600; ++round) {
    const Neighbors all = neighbors(round, random);
    ASSERT_TRUE(all.frames.usable());
    std::array<float, WideNode::kLanes> lower{}, directed{};
    BoxDirections directions;
    const float enough = round % 2 == 0 ? static_cast<float>(random.uniform(0.0, all.scale))
                                        : std::numeric_limits<float>::infinity();
    boxLowerBounds(all.node, all.frames, all.other, enough, lower);
    boxLowerBounds(all.node, all.frames, all.other, enough, directed, directions);
    EXPECT_EQ(lower, directed);
    for (int lane = 0; lane < WideNode::kLanes; ++lane) {
      ++total;
      if (!(lower[lane] > 0.0F)) continue;
      ++apart;
      const OrientedBox box = all.node.box(lane);
      const BoxGap gap = boxGap(box, all.frames, all.other, directions.of(lane));
      EXPECT_NEAR(gap.direction.norm(), 1.0, 1e-12);
      const long double separation =
          separationAlong(box, all.first_from_second, all.other, gap.direction);
      EXPECT_LE(gap.value, separation);
      EXPECT_GE(gap.value, separation - all.slack(lane));
      // Of edges at a small angle, single precision knows the direction less well.
      const double wanted = (1.0 - 1e-5) * lower[lane] - all.slack(lane);
      best += gap.value >= wanted ? 1 : 0;
    }
  }
  EXPECT_GT(apart, total * 3 / 10);
  EXPECT_LT(apart, total * 9 / 10);
  EXPECT_GT(best, apart * 999 / 1000);
}

TEST_P(BoxBounds, ProveNothingOfTheBoxItselfAndOfOneThatTouches) {
  reference::Random random(15);
  for (int round = 0; round < 800; ++round) {
    const Neighbors all = neighbors(round % 2 == 0 ? 8 * round + 4 : 8 * round + 5, random);
    std::array<float, WideNode::kLanes> lower{};
    BoxDirections directions;
    boxLowerBounds(all.node, all.frames, all.other, std::numeric_limits<float>::infinity(), lower,
                   directions);
    const int lane = (round % 2 == 0 ? 4 : 5) % WideNode::kLanes;
    EXPECT_LE(lower[lane], 0.0F);
    const OrientedBox box = all.node.box(lane);
    for (int j = 0; j < 3; ++j) {
      EXPECT_LE(boxGap(box, all.frames, all.other, vectorOf(box.axes[j])).value, 0.0);
    }
    EXPECT_LE(boxGap(box, all.frames, all.other, directions.of(lane)).value, 0.0);
  }
}

TEST(BoxGapAlong, IsProvenInAnyDirectionOfAnyLength) {
  reference::Random random(16);
  int apart = 0, total = 0;
  for (int round = 0; round < 4000; ++round) {
    const Neighbors all = neighbors(round, random);
    for (int lane = 0; lane < WideNode::kLanes; ++lane) {
      const OrientedBox box = all.node.box(lane);
      const Vector3d center = all.first_from_second * all.other.center - box.center;
      const Vector3d turned = lane % 2 == 0 ? center : random.vector(all.scale);
      const Vector3d along = std::pow(10.0, random.uniform(-30.0, 30.0)) * turned;
      if (along.isZero(0.0)) continue;
      const BoxGap gap = boxGap(box, all.frames, all.other, along);
      const long double separation =
          separationAlong(box, all.first_from_second, all.other, gap.direction);
      EXPECT_NEAR(gap.direction.norm(), 1.0, 1e-12);
      EXPECT_GE(gap.direction.dot(center), 0.0);
      EXPECT_LE(gap.value, separation);
      EXPECT_GE(gap.value, separation - all.slack(lane));
      ++total;
      apart += gap.value > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(apart, total * 3 / 10);
  EXPECT_LT(apart, total * 7 / 10);
}

TEST(BoxGapAlong, IsNoneWithoutADirection) {
  OrientedBox other;
  other.center.x() = 10.0;
  const BoxFrames frames(Isometry3d::Identity(), 20.0);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_GT(boxGap({}, frames, other, Vector3d::UnitX()).value, 9.9);
  for (const double length : {0.0, 1e-200, kInfinity, std::nan("")}) {
    const Vector3d along(length, 0.0, 0.0);
    EXPECT_FALSE(boxGap({}, frames, other, along).value > 0.0);
  }
}

/// Enters through the slab of each axis; negative: misses by as much.
double passesInside(const Placed& box, const Vector3d& origin, const Vector3d& direction) {
  const Vector3d from = box.pose.inverse() * origin;
  const Vector3d along = box.pose.linear().transpose() * direction;
  double enter = 0.0, leave = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double first = (-box.half[i] - from[i]) / along[i];
    const double second = (box.half[i] - from[i]) / along[i];
    enter = std::max(enter, std::min(first, second));
    leave = std::min(leave, std::max(first, second));
  }
  return leave - enter;
}

TEST_P(BoxBounds, ARayMissesOnlyWhatItPassesBy) {
  reference::Random random(13);
  int hit = 0, missed = 0, wasted = 0;
  for (int round = 0; round < 3000; ++round) {
    const double scale = std::pow(10.0, random.uniform(-6.0, 6.0));
    WideNode node = emptyNode(random.vector(scale));
    node.count = 1 + round % WideNode::kLanes;
    for (int lane = 0; lane < node.count; ++lane) {
      node.set(lane, randomBox(random, 0.7 * scale, 1.5 * scale));
    }
    const Vector3d origin = random.vector(2.0 * scale);
    // Often at a box, else few would be hit.
    Vector3d direction = (node.box(0).center - origin).normalized();
    if (round % 4 == 0) direction = Vector3d::Unit(round / 4 % 3);
    const std::uint32_t hits = boxesHit(node, origin, direction);
    EXPECT_EQ(hits >> node.count, 0u);
    for (int lane = 0; lane < node.count; ++lane) {
      const double inside =
          passesInside(placed(node.box(lane), Isometry3d::Identity()), origin, direction);
      const bool reported = (hits >> lane & 1u) != 0;
      EXPECT_TRUE(reported || !(inside >= 0.0));
      (inside >= 0.0 ? hit : missed) += 1;
      wasted += reported && inside < -1e-4 * scale ? 1 : 0;
    }
  }
  EXPECT_GT(hit, 1000);
  EXPECT_GT(missed, 3000);
  EXPECT_LT(wasted, missed / 1000);
}

TEST_P(BoxBounds, ARayOfNoNumbersHits) {
  WideNode node = emptyNode(Vector3d::Zero());
  node.count = 3;
  for (int lane = 0; lane < 3; ++lane) node.set(lane, OrientedBox{});
  const Vector3d nowhere = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(boxesHit(node, nowhere, Vector3d::UnitX()), 7u);
  EXPECT_EQ(boxesHit(node, Vector3d::Ones(), nowhere), 7u);
}

INSTANTIATE_TEST_SUITE_P(Targets, BoxBounds, testing::ValuesIn(simd_test::simdTargets()),
                         [](const auto& target) {
                           return std::string(hwy::TargetName(target.param));
                         });

TEST(BoxFrames, AreNotUsableWhereSinglePrecisionCannotTell) {
  Isometry3d pose = Isometry3d::Identity();
  EXPECT_FALSE(BoxFrames(pose, 1e13).usable());
  EXPECT_FALSE(BoxFrames(pose, 1e-13).usable());
  pose.translation().x() = 1e13;
  EXPECT_FALSE(BoxFrames(pose, 1.0).usable());
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(BoxFrames(pose, 1.0).usable());
  pose = Isometry3d::Identity();
  pose.linear()(0, 0) = 1.01;
  EXPECT_FALSE(BoxFrames(pose, 1.0).usable());
  pose.linear()(0, 0) = 1.0 + 1e-9;
  EXPECT_TRUE(BoxFrames(pose, 1.0).usable());
}

}  // namespace
}  // namespace swept::detail
