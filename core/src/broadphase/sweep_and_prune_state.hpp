// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/box_forest.hpp"
#include "broadphase/handles.hpp"
#include "broadphase/pair_set.hpp"
#include "broadphase/partner_lists.hpp"
#include "broadphase/stamps.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"

namespace swept {

/// Between calls: each box is in its room; partners are all whose rooms overlap, and know whether
/// they themselves do; these are the pairs.
class SweepAndPrune::State {
 public:
  void add(std::span<const Aabb> boxes, std::vector<BoxHandle>& handles);
  void remove(BoxHandle handle);
  void update(std::span<const BoxHandle> handles, std::span<const Aabb> boxes);
  void updateAll(std::span<const Aabb> boxes);
  /// Builds everything from the boxes and their rooms.
  void rebuild();

  const detail::Handles& handles() const { return handles_; }
  const Aabb& box(BoxHandle handle) const { return boxes_[handle]; }
  const detail::BoxForest& forest() const { return forest_; }
  const detail::PairSet& pairs() const { return pairs_; }
  std::size_t bytes() const;

 private:
  void resize();
  void stage(BoxHandle handle, const Aabb& box);
  bool manyLeft() const;
  void prefetch(BoxHandle handle) const;
  template <typename Act>
  void forEach(std::span<const BoxHandle> handles, const Act& act);
  void settleLeavers();
  void relink(BoxHandle handle);
  template <typename Skip>
  void look(BoxHandle handle, const Skip& skip);
  void link(BoxHandle a, BoxHandle b);
  int handleBits() const;

  detail::Handles handles_;
  std::vector<Aabb> boxes_;              ///< m
  std::vector<detail::FloatBox> rooms_;  ///< m
  detail::Stamps moved_, kept_;
  detail::BoxForest forest_;
  detail::PartnerLists partners_;
  detail::PairSet pairs_;
  // Of the change at work.
  std::vector<BoxHandle> left_, found_;
  std::vector<detail::PairKey> toggled_, near_, scratch_;
  std::vector<std::uint32_t> counts_;
};

}  // namespace swept
