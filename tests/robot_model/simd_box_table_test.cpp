// SPDX-License-Identifier: BSD-3-Clause
// Boxes of motions in half of single precision: what is far in it is far, on each instruction set.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "graph/box_table.hpp"
#include "simd_targets.hpp"

namespace swept::simd_test {
namespace {

using detail::BodySpace;
using detail::BoxKey;
using detail::BoxRows;
using detail::BoxTable;
using detail::MotionBoxes;
using detail::SingleBox;
using detail::TouchedPiece;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(BoxRows, AKeyIsThatOfAnInterval) {
  std::vector<float> values{0.0F, -0.0F, 1e-30F, 0x1p-15F, 0.3F, 1.0F, 131071.0F, 1e30F, kInfinity};
  std::mt19937 random(1);
  while (values.size() < 20'000) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    const float scale = std::ldexp(1.0F, static_cast<int>(random() % 40) - 20);
    if (!std::isnan(value)) values.push_back(random() % 2 == 0 ? value : std::fmod(value, scale));
  }
  for (std::size_t i = values.size(); i-- > 0;) values.push_back(-values[i]);
  std::ranges::sort(values);
  std::int16_t before = std::numeric_limits<std::int16_t>::min();
  for (const float value : values) {
    const std::int16_t key = BoxKey::of(value);
    ASSERT_GE(key, before) << value;
    ASSERT_LE(BoxKey::least(key), value);
    ASSERT_GE(BoxKey::most(key), value);
    if (std::abs(value) >= 0x1p-14F && std::abs(value) < 0x1p16F) {
      ASSERT_LE(BoxKey::most(key) - BoxKey::least(key), 0x1p-10F * std::abs(value));
    }
    before = key;
  }
  EXPECT_EQ(BoxKey::of(-0.0F), BoxKey::of(0.0F));
  EXPECT_EQ(BoxKey::most(BoxKey::of(kInfinity)), kInfinity);
  EXPECT_EQ(BoxKey::least(BoxKey::of(-kInfinity)), -kInfinity);
}

SingleBox randomBox(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> middle(-1.0, 1.0), half(0.0, 0.5 * size);
  const Eigen::Vector3d at(middle(random), middle(random), middle(random));
  const Eigen::Vector3d reach(half(random), half(random), half(random));
  if (random() % 50 == 0) return detail::unboundedBox();
  return detail::singleBox(at - reach, at + reach);
}

struct Tally {
  std::size_t asked = 0, touching = 0, found = 0;

  std::string text() const {
    return std::to_string(asked) + " boxes, " + std::to_string(touching) + " touching, " +
           std::to_string(found) + " found";
  }
};

/// What touches the body is found, at the right place; what is found besides is within the rounding
/// of keys.
void expectFound(std::mt19937& random, Tally& tally) {
  const std::size_t pieces = 1 + random() % 5, motions = 1 + random() % 60;
  BoxTable table(pieces);
  std::vector<std::vector<SingleBox>> boxes(motions);
  for (std::size_t i = 0; i < motions; ++i) {
    table.resize(i + 1);
    for (std::size_t k = 0; k < pieces * MotionBoxes::kParts; ++k)
      boxes[i].push_back(randomBox(random, 0.3));
    table.put(i, boxes[i]);
  }
  WorldBody body{.name = "body", .parts = {}};
  const bool isFlat = random() % 8 == 0;
  for (std::size_t i = 1 + random() % 3; i > 0; --i) {
    const double angle = static_cast<double>(random() % 100) * 0.05;
    Eigen::Isometry3d pose(Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()));
    pose.translation() = Eigen::Vector3d(0.2, 0.1 * static_cast<double>(i), -0.3);
    if (isFlat) {
      body.parts.push_back({makeHalfSpace({0.3, 0.2, 1.0}, -0.5), Eigen::Isometry3d::Identity()});
    } else {
      body.parts.push_back({Box{{0.1, 0.2, 0.3}}, pose});
    }
  }
  const BodySpace space(body, 1.0, 0.01, 1e-13), wide(body, 1.0, 0.015, 1e-13);
  const std::size_t first = random() % motions;
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> found;
  std::uint32_t before = 0;
  for (const TouchedPiece& piece : table.touching(space, first)) {
    ASSERT_GE(piece.motion, std::max<std::size_t>(before, first));
    ASSERT_LT(piece.motion, motions);
    ASSERT_NE(piece.parts, 0U);
    before = piece.motion;
    ASSERT_TRUE(found.emplace(std::pair(piece.motion, piece.piece), piece.parts).second);
  }
  for (std::size_t i = first; i < motions; ++i)
    for (std::size_t piece = 0; piece < pieces; ++piece)
      for (std::size_t part = 0; part < MotionBoxes::kParts; ++part) {
        const SingleBox& box = boxes[i][part * pieces + piece];
        const auto at = found.find({i, piece});
        const bool isFound = at != found.end() && (at->second >> part & 1U) != 0;
        ++tally.asked;
        tally.touching += space.touches(box) ? 1 : 0;
        tally.found += isFound ? 1 : 0;
        ASSERT_TRUE(isFound || !space.touches(box)) << i << ' ' << piece << ' ' << part;
        ASSERT_TRUE(!isFound || wide.touches(box)) << i << ' ' << piece << ' ' << part;
      }
}

TEST(BoxTable, FindsAllThatTouchesABody) {
  tallyOnAllTargets<Tally>([](Tally& tally) {
    std::mt19937 random(3);
    for (int round = 0; round < 60 && !testing::Test::HasFatalFailure(); ++round)
      expectFound(random, tally);
    EXPECT_GT(tally.touching, tally.asked / 100);
    EXPECT_LT(tally.found, tally.asked / 2);
  });
}

}  // namespace
}  // namespace swept::simd_test
