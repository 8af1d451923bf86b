// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/box_forest.hpp"
#include "broadphase/handles.hpp"
#include "broadphase/nearest_pairs.hpp"
#include "broadphase/pair_set.hpp"
#include "broadphase/partner_lists.hpp"
#include "broadphase/stamps.hpp"
#include "swept/core/broadphase/sweep_and_prune.hpp"

namespace swept {

/// Between calls, each box is in its room. Partners are all pairs whose rooms overlap, with a flag
/// whether the boxes themselves do; the flagged ones are the pairs.
///
/// Internally, boxes have numbers, which `rebuild` assigns in the order of the tree. Near boxes
/// then share cache lines and pages, whatever the order of their handles.
class SweepAndPrune::State {
 public:
  using Number = std::uint32_t;

  std::vector<BoxHandle> add(std::span<const Aabb> boxes);
  void remove(BoxHandle handle);
  void update(std::span<const BoxHandle> handles, std::span<const Aabb> boxes);
  void updateAll(std::span<const Aabb> boxes);

  const detail::Handles& handles() const { return handles_; }
  const Aabb& box(BoxHandle handle) const { return placed_[numbers_[handle]].box; }
  const Aabb& boxAt(Number number) const { return placed_[number].box; }
  BoxHandle handleAt(Number number) const { return placed_[number].owner; }
  const detail::BoxForest& forest() const { return forest_; }
  detail::PlacedForest placed() const { return {forest_, placed_}; }
  const detail::PairSet& pairs() const { return pairs_; }
  std::size_t bytes() const;

 private:
  static constexpr BoxHandle kNobody = detail::BoxTree::kNobody;

  Number takeNumber(BoxHandle handle);
  void resize();
  void stage(Number number, const Aabb& box);
  bool manyLeft() const;
  detail::PairKey key(Number a, Number b) const {
    return detail::pairKey(placed_[a].owner, placed_[b].owner);
  }
  int handleBits() const;
  template <typename Skip, typename Act>
  void forEach(std::span<const Number> numbers, const Skip& skip, const Act& act);
  template <typename Skip>
  void look(Number number, const Skip& skip);
  void settle();
  void relink(Number number);
  void link(Number a, Number b);
  void rebuild();
  void renumber();

  detail::Handles handles_;
  std::vector<Number> numbers_;            ///< by handle
  std::vector<detail::PlacedBox> placed_;  ///< by number, as is all below
  std::vector<detail::FloatBox> rooms_;    ///< m
  detail::Stamps moved_, kept_;
  std::vector<Number> free_;
  detail::BoxForest forest_;
  detail::PartnerLists partners_;
  detail::PairSet pairs_;
  // Data of the current change.
  std::vector<Number> changed_, left_, found_;
  std::vector<detail::PairKey> toggled_, keys_, scratch_;
  std::vector<std::uint32_t> counts_;
  std::vector<detail::PlacedBox> renumbered_;
};

}  // namespace swept
