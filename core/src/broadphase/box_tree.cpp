// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/box_tree.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace swept::detail {
namespace {

constexpr std::size_t kLanes = BoxBlock::kLanes;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
/// Half of the largest coordinate that `build` distinguishes: sums and differences stay finite.
constexpr float kFarthest = 1e37F;
constexpr std::uint32_t kSizeClasses = 64;

std::size_t blocksFor(std::size_t count) {
  return (count + kLanes - 1) / kLanes;
}

float clamped(float x) {
  return std::clamp(x, -kFarthest, kFarthest);
}

float largestExtent(const FloatBox& box) {
  float largest = 0.0F;
  for (int k = 0; k < 3; ++k)
    largest = std::max(largest, clamped(box.upper[k]) - clamped(box.lower[k]));
  return largest;
}

/// Size class in powers of four above the usual size; all boxes up to that size are alike.
std::uint32_t fourfold(float extent, float usual) {
  const float ratio = extent / usual;
  if (!(ratio >= 4.0F)) return 0;
  return std::min(static_cast<std::uint32_t>(std::ilogb(std::min(ratio, kFarthest)) / 2),
                  kSizeClasses - 1);
}

}  // namespace

FloatBox BoxBlock::box(std::size_t lane) const {
  FloatBox box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = lower[k][lane];
    box.upper[k] = upper[k][lane];
  }
  return box;
}

void BoxBlock::set(std::size_t lane, const FloatBox& box) {
  for (int k = 0; k < 3; ++k) {
    lower[k][lane] = box.lower[k];
    upper[k][lane] = box.upper[k];
  }
}

FloatBox BoxBlock::bounds() const {
  FloatBox result;
  for (int k = 0; k < 3; ++k) {
    float least = kInfinity, most = -kInfinity;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // In this order of arguments a NaN changes nothing.
      least = lower[k][lane] < least ? lower[k][lane] : least;
      most = upper[k][lane] > most ? upper[k][lane] : most;
    }
    result.lower[k] = least;
    result.upper[k] = most;
  }
  return result;
}

BoxBlock BoxBlock::empty() {
  BoxBlock block;
  for (int k = 0; k < 3; ++k) {
    block.lower[k].fill(kNan);
    block.upper[k].fill(kNan);
  }
  return block;
}

void BoxTree::makeRoomFor(std::size_t slots) {
  std::size_t count = slots;
  for (std::size_t level = 0; count > 1 || level == 0; ++level) {
    count = blocksFor(count);
    const bool isNew = level >= height_ && level > 0;
    if (levels_[level].size() < count) levels_[level].resize(count, BoxBlock::empty());
    if (isNew) {
      // The tree built so far hangs below the first lane of its new top.
      levels_[level][0].set(0, levels_[level - 1][0].bounds());
    }
    height_ = std::max(height_, level + 1);
  }
}

void BoxTree::refit(Slot slot) {
  std::size_t block = slot / kLanes;
  for (std::size_t level = 1; level < height_; ++level, block /= kLanes) {
    const FloatBox bounds = levels_[level - 1][block].bounds();
    if (levels_[level][block / kLanes].box(block % kLanes) == bounds) return;
    levels_[level][block / kLanes].set(block % kLanes, bounds);
  }
}

BoxTree::Slot BoxTree::append(std::uint32_t owner, const FloatBox& box) {
  const auto slot = static_cast<Slot>(owners_.size());
  makeRoomFor(owners_.size() + 1);
  owners_.push_back(owner);
  ++live_;
  move(slot, box);
  return slot;
}

void BoxTree::move(Slot slot, const FloatBox& box) {
  levels_[0][slot / kLanes].set(slot % kLanes, box);
  refit(slot);
}

void BoxTree::erase(Slot slot) {
  FloatBox none;
  none.lower.fill(kNan);
  none.upper.fill(kNan);
  owners_[slot] = kNobody;
  --live_;
  move(slot, none);
}

void BoxTree::clear() {
  for (std::vector<BoxBlock>& level : levels_) level.clear();
  limits_.clear();
  owners_.clear();
  height_ = live_ = sorted_ = 0;
}

bool BoxTree::hasRoom(Slot slot, const FloatBox& box) const {
  const std::size_t block = slot / kLanes;
  return block < limits_.size() && limits_[block].contains(box);
}

/// A few large boxes among small ones would make large blocks of them all, so the sizes are kept
/// apart. The median decides what is small.
void BoxTree::classify() {
  const std::size_t middle = items_.size() / 2;
  std::nth_element(
      items_.begin(), items_.begin() + static_cast<std::ptrdiff_t>(middle), items_.end(),
      [](const Item& a, const Item& b) { return largestExtent(a.box) < largestExtent(b.box); });
  const float usual =
      std::max(largestExtent(items_[middle].box), std::numeric_limits<float>::min());
  for (Item& item : items_)
    item.sizeClass = kSizeClasses - 1 - fourfold(largestExtent(item.box), usual);
}

/// Halves at the median of the widest axis, at the boundary of the highest possible block level.
/// The depth is the tree's number of bits, whatever the boxes.
void BoxTree::arrange(std::size_t first, std::size_t last) {
  if ((last - 1) / kLanes == first / kLanes) return;
  std::size_t chunk = kLanes;
  while ((last - 1) / (chunk * kLanes) != first / (chunk * kLanes)) chunk *= kLanes;
  // The multiple of the chunk nearest to the middle, strictly inside.
  std::size_t cut = (first + (last - first) / 2 + chunk / 2) / chunk * chunk;
  if (cut >= last) cut -= chunk;
  if (cut <= first) cut += chunk;
  std::array<float, 3> least, most;
  least.fill(kInfinity);
  most.fill(-kInfinity);
  for (std::size_t i = first; i < last; ++i) {
    for (int k = 0; k < 3; ++k) {
      least[k] = std::min(least[k], items_[i].center[k]);
      most[k] = std::max(most[k], items_[i].center[k]);
    }
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (most[k] - least[k] > most[axis] - least[axis]) axis = k;
  const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(cut), at(last), [axis](const Item& a, const Item& b) {
    return a.center[axis] < b.center[axis];
  });
  arrange(first, cut);
  arrange(cut, last);
}

void BoxTree::build(std::span<const std::uint32_t> owners, std::span<const FloatBox> boxes) {
  items_.clear();
  for (const std::uint32_t owner : owners) {
    Item item{boxes[owner], {}, owner, 0};
    for (int k = 0; k < 3; ++k)
      item.center[k] = 0.5F * (clamped(item.box.lower[k]) + clamped(item.box.upper[k]));
    items_.push_back(item);
  }
  clear();
  if (items_.empty()) return;
  classify();
  std::array<std::size_t, kSizeClasses + 1> starts{};
  for (const Item& item : items_) ++starts[item.sizeClass + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  if (starts[kSizeClasses - 1] > 0) {
    std::sort(items_.begin(), items_.end(),
              [](const Item& a, const Item& b) { return a.sizeClass < b.sizeClass; });
  }
  for (auto start = starts.begin(); start + 1 != starts.end(); ++start)
    if (start[0] < start[1]) arrange(start[0], start[1]);

  live_ = sorted_ = items_.size();
  makeRoomFor(items_.size());
  for (const Item& item : items_) {
    const std::size_t slot = owners_.size();
    levels_[0][slot / kLanes].set(slot % kLanes, item.box);
    owners_.push_back(item.owner);
  }
  bound();
}

void BoxTree::bound() {
  for (std::size_t level = 1; level < height_; ++level) {
    for (std::size_t block = 0; block < levels_[level - 1].size(); ++block)
      levels_[level][block / kLanes].set(block % kLanes, levels_[level - 1][block].bounds());
  }
  for (const BoxBlock& block : levels_[0]) {
    // Half the block's size to all sides.
    FloatBox limit = block.bounds();
    const float room = 0.5F * largestExtent(limit);
    for (int k = 0; k < 3; ++k) {
      limit.lower[k] -= room;
      limit.upper[k] += room;
    }
    limits_.push_back(limit);
  }
}

std::size_t BoxTree::bytes() const {
  std::size_t sum = limits_.capacity() * sizeof(FloatBox) +
                    owners_.capacity() * sizeof(std::uint32_t) + items_.capacity() * sizeof(Item);
  for (const std::vector<BoxBlock>& level : levels_) sum += level.capacity() * sizeof(BoxBlock);
  return sum;
}

}  // namespace swept::detail
