// SPDX-License-Identifier: BSD-3-Clause
#include "simd/box_bounds.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>
#include <hwy/targets.h>

#include <cmath>

#include "reference_distance.hpp"

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

Isometry3d translated(Isometry3d pose, const Vector3d& center) {
  pose.translation() = pose * center;
  return pose;
}

BoxF randomBox(reference::Random& random, double size, double spread) {
  BoxF box;
  for (int i = 0; i < 3; ++i) {
    box.center[i] = static_cast<float>(random.uniform(-spread, spread));
    // Thin ones too: edges matter then.
    box.half[i] = static_cast<float>(size * std::pow(10.0, random.uniform(-1.5, 0.0)));
  }
  return box;
}

double reachOf(const BoxF& box) {
  return (vectorOf(box.center).cwiseAbs() + vectorOf(box.half)).sum();
}

/// Every instruction set that this machine has, one after the other.
class BoxBounds : public testing::TestWithParam<std::int64_t> {
 protected:
  void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

TEST_P(BoxBounds, AreNeverAboveTheDistanceAndSeldomFarBelow) {
  reference::Random random(11);
  int apart = 0, positive = 0, close = 0, total = 0;
  for (int round = 0; round < 400; ++round) {
    const double scale = std::pow(10.0, random.uniform(-6.0, 6.0));
    Isometry3d first_from_second = random.pose(0.6 * scale);
    WideNode node{};
    node.count = 1 + round % WideNode::kLanes;
    double reach = 0.0;
    std::array<BoxF, WideNode::kLanes> boxes;
    for (int lane = 0; lane < node.count; ++lane) {
      boxes[lane] = randomBox(random, 0.7 * scale, 0.5 * scale);
      reach = std::max(reach, reachOf(boxes[lane]));
      for (int i = 0; i < 3; ++i) {
        node.center[i][lane] = boxes[lane].center[i];
        node.half[i][lane] = boxes[lane].half[i];
      }
    }
    const BoxF other = randomBox(random, 0.7 * scale, 0.5 * scale);
    const BoxFrames frames(first_from_second, reach + reachOf(other));
    ASSERT_TRUE(frames.usable());
    std::array<float, WideNode::kLanes> lower{};
    boxLowerBounds(node, frames, other, std::numeric_limits<float>::infinity(), lower);
    for (int lane = 0; lane < node.count; ++lane) {
      const Placed a{translated(Isometry3d::Identity(), vectorOf(boxes[lane].center)),
                     vectorOf(boxes[lane].half)};
      const Placed b{translated(first_from_second, vectorOf(other.center)), vectorOf(other.half)};
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
    WideNode node{};
    node.count = WideNode::kLanes;
    for (int lane = 0; lane < WideNode::kLanes; ++lane) {
      const BoxF box = randomBox(random, 0.3, 1.0);
      for (int i = 0; i < 3; ++i) {
        node.center[i][lane] = box.center[i];
        node.half[i][lane] = box.half[i];
      }
    }
    const BoxF other = randomBox(random, 0.3, 1.0);
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

std::vector<std::int64_t> targets() {
  std::vector<std::int64_t> found;
  const std::int64_t all = hwy::SupportedTargets();
  for (std::int64_t bit = 1; bit > 0 && bit <= all; bit <<= 1) {
    if ((all & bit) != 0) found.push_back(bit);
  }
  return found;
}

INSTANTIATE_TEST_SUITE_P(Targets, BoxBounds, testing::ValuesIn(targets()), [](const auto& target) {
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
