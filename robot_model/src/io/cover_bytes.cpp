// SPDX-License-Identifier: BSD-3-Clause
#include "io/cover_bytes.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace swept::detail {

namespace {

/// A level of a cover, without the padding between its fields, which may hold any bytes.
struct PackedLevel {
  double aimed;
  double largestOverhang;
  std::int64_t ballCount;
};

static_assert(sizeof(SphereCover::Node) == 7 * sizeof(float) + 3 * sizeof(int));
static_assert(sizeof(CoverBall) == 4 * sizeof(float));

template <typename Item>
void append(const std::vector<Item>& items, std::string& bytes) {
  const std::uint64_t count = items.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(items.data()), count * sizeof(Item));
}

/// Removes them from the front; false: there are too few.
template <typename Item>
bool take(std::string_view& bytes, std::vector<Item>& items) {
  std::uint64_t count = 0;
  if (bytes.size() < sizeof count) return false;
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  if (count > bytes.size() / sizeof(Item)) return false;
  items.resize(count);
  if (count > 0) std::memcpy(static_cast<void*>(items.data()), bytes.data(), count * sizeof(Item));
  bytes.remove_prefix(count * sizeof(Item));
  return true;
}

bool isBall(const CoverBall& ball) {
  return ball.center.allFinite() && std::isfinite(ball.radius) && ball.radius >= 0.0F;
}

bool isTree(const SphereCover& cover) {
  const auto count = static_cast<std::int64_t>(cover.nodes.size());
  for (std::int64_t i = 0; i < count; ++i) {
    const SphereCover::Node& node = cover.nodes[static_cast<std::size_t>(i)];
    if (!isBall(node.ball) || !(node.overhang >= 0.0F) || !(node.beyond >= 0.0F)) return false;
    if (std::isnan(node.inside) || node.childCount < 0 || node.level < 0) return false;
    if (node.level >= static_cast<int>(cover.levels.size())) return false;
    if (node.childCount == 0) continue;
    if (node.firstChild <= i || node.firstChild + std::int64_t{node.childCount} > count)
      return false;
  }
  return count > 0;
}

}  // namespace

std::string toBytes(const SphereCover& cover) {
  std::vector<PackedLevel> levels;
  for (const SphereCover::Level& level : cover.levels)
    levels.push_back({level.aimed, level.largestOverhang, level.ballCount});
  std::string bytes;
  append(cover.nodes, bytes);
  append(cover.inner, bytes);
  append(levels, bytes);
  return bytes;
}

std::optional<SphereCover> coverFromBytes(std::string_view bytes) {
  SphereCover cover;
  std::vector<PackedLevel> levels;
  if (!take(bytes, cover.nodes) || !take(bytes, cover.inner) || !take(bytes, levels)) return {};
  if (!bytes.empty()) return {};
  for (const PackedLevel& level : levels)
    cover.levels.push_back({level.aimed, static_cast<int>(level.ballCount), level.largestOverhang});
  for (const CoverBall& ball : cover.inner)
    if (!isBall(ball)) return {};
  if (!isTree(cover)) return {};
  return cover;
}

}  // namespace swept::detail
