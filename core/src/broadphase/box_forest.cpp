// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/box_forest.hpp"

#include "broadphase/box_overlaps.hpp"

namespace swept::detail {

void BoxForest::insert(std::uint32_t owner, const FloatBox& box) {
  if (places_.size() <= owner) places_.resize(owner + 1);
  places_[owner] = {1, movers_.append(owner, box) & kSlotBits};
}

void BoxForest::move(std::uint32_t owner, const FloatBox& box) {
  BoxTree& tree = treeOf(owner);
  const BoxTree::Slot slot = places_[owner].slot;
  if (tree.hasRoom(slot, box)) return tree.move(slot, box);
  tree.erase(slot);
  insert(owner, box);
}

void BoxForest::erase(std::uint32_t owner) {
  treeOf(owner).erase(places_[owner].slot);
}

void BoxForest::gather(const BoxTree& tree) {
  for (const std::uint32_t owner : tree.owners())
    if (owner != BoxTree::kNobody) gathered_.push_back(owner);
}

void BoxForest::number(const BoxTree& tree) {
  const std::uint32_t mover = &tree == &movers_ ? 1 : 0;
  for (std::uint32_t slot = 0; slot < tree.slots(); ++slot)
    places_[tree.owner(slot)] = {mover & 1U, slot & kSlotBits};
}

/// The bounds keep the building work per moved box constant, up to a logarithm, and the work of a
/// search at most twice that in newly built trees.
void BoxForest::tidy(std::span<const FloatBox> boxes) {
  gathered_.clear();
  if (movers_.live() > 64 + settled_.live() / 8 || settled_.slots() > 64 + 2 * settled_.live()) {
    gather(settled_);
    gather(movers_);
    build(gathered_, boxes);
  } else if (movers_.unsorted() > 16 + movers_.live() / 8 ||
             movers_.slots() > 64 + 2 * movers_.live()) {
    gather(movers_);
    movers_.build(gathered_, boxes);
    number(movers_);
  }
}

void BoxForest::build(std::span<const std::uint32_t> owners, std::span<const FloatBox> boxes) {
  if (places_.size() < boxes.size()) places_.resize(boxes.size());
  movers_.clear();
  settled_.build(owners, boxes);
  number(settled_);
}

void BoxForest::ownBySlot() {
  settled_.ownBySlot();
  places_.resize(settled_.slots());
  number(settled_);
}

void BoxForest::findOverlaps(const FloatBox& box, std::vector<std::uint32_t>& owners) const {
  detail::findOverlaps(settled_, box, owners);
  detail::findOverlaps(movers_, box, owners);
}

std::size_t BoxForest::bytes() const {
  return settled_.bytes() + movers_.bytes() + places_.capacity() * sizeof(Place) +
         gathered_.capacity() * sizeof(std::uint32_t);
}

}  // namespace swept::detail
