// SPDX-License-Identifier: BSD-3-Clause
#include "simd/tables/table_builder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/pair_model.hpp"

namespace swept::detail {

namespace {

/// A table is not worth its time if the bodies are not apart, or only just, in this share of their
/// range: because of contact, although nothing else is.
constexpr double kMostOpen = 0.7;
constexpr int kProbes = 6;
/// Relative to the travel of points in a cell: with a smaller gap in its middle, few of its parts
/// are apart.
constexpr double kLeastGap = 0.1;
/// Number of parts along each joint of the smallest boxes that are compared.
constexpr int kFewestParts = 2;

/// Removes one of four quarters from a box of indices; false if there is no such quarter.
bool halve(int quarter, std::array<int, 2>& begin, std::array<int, 2>& end) {
  for (int k = 0; k < 2; ++k) {
    const bool second = (quarter >> k & 1) != 0;
    const int width = end[k] - begin[k];
    if (width < 2 && second) return false;
    if (width >= 2) (second ? begin : end)[k] = begin[k] + width / 2;
  }
  return true;
}

}  // namespace

TableBuilder::TableBuilder(const PairModel& model, const SimdModel& simd,
                           const SimdBodyPair& bodies, const TableMotion& motion,
                           PairSeparationTable::Pairs pairs)
    : motion_(motion), proof_(model, simd, bodies, motion_) {
  table_.joints = motion_.joints();
  table_.axes = motion_.axes();
  table_.cells.resize(static_cast<std::size_t>(table_.axes[0].cells) * table_.axes[1].cells);
  table_.pairs = std::move(pairs);
}

/// Sets the pair of the following steps.
void TableBuilder::choose(std::int32_t pair) {
  pair_ = pair;
  const auto index = static_cast<std::size_t>(pair);
  bit_ = static_cast<std::uint8_t>(1U << std::min(index, PairSeparationTable::kPairBits - 1));
  proof_.choose(table_.pairs[index]);
}

TableMotion::Parts TableBuilder::partsOf(const Region& region) const {
  Parts parts;
  for (int k = 0; k < table_.joints; ++k) {
    parts.begin[k] = region.begin[k] * PairSeparationTable::kParts;
    parts.end[k] = region.end[k] * PairSeparationTable::kParts;
  }
  return parts;
}

/// By single cells, evenly spread over the range.
bool TableBuilder::isMostlyOpen() {
  int open = 0;
  int probes = 0;
  for (int i = 0; i < kProbes; ++i) {
    for (int j = 0; j < (table_.joints == 2 ? kProbes : 1); ++j) {
      const int row = (2 * i + 1) * motion_.turn(0) / (2 * kProbes);
      const int column = (2 * j + 1) * motion_.turn(1) / (2 * kProbes);
      const Place place = motion_.placeOf(partsOf({{row, column}, {row + 1, column + 1}}));
      ++probes;
      for (std::size_t pair = 0; pair < table_.pairs.size(); ++pair) {
        choose(static_cast<std::int32_t>(pair));
        if (proof_.apartByBalls(place)) continue;
        if (proof_.apartWithin(place, proof_.compareWhereStopped(place, true).gap)) continue;
        ++open;
        break;
      }
    }
  }
  return open > kMostOpen * probes;
}

void TableBuilder::proveRegion(const Region& region) {
  choose(region.pair);
  const Place place = motion_.placeOf(partsOf(region));
  if (proof_.apartByBalls(place)) return;
  // If balls in the links meet for all values of the joints, there is nothing to prove.
  if (proof_.alwaysMeet() || haveMeetings(region))
    return markUnresolved(region, proof_.alwaysMeet(), false);
  const std::array<int, 2> width{region.end[0] - region.begin[0], region.end[1] - region.begin[1]};
  const bool single = width[0] == 1 && width[1] == 1;
  const PairProof::Compared found = proof_.compareWhereStopped(place, single);
  if (proof_.apartWithin(place, found.gap)) return;
  if (single) {
    // If the middle is known to be free of contact, no balls meet.
    if (found.touching || !found.tried) proof_.findMeeting(place, found);
    markUnresolved(region, found.touching, false);
    if (found.tried && !found.touching) startParts(region, found.gap);
    return;
  }
  splitRegion(region);
}

/// Into quarters.
void TableBuilder::splitRegion(const Region& region) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    Region child = region;
    if (halve(quarter, child.begin, child.end)) next_.push_back(child);
  }
}

/// A contact in all of them is known already.
bool TableBuilder::haveMeetings(const Region& region) const {
  for (int i = region.begin[0]; i < region.end[0]; ++i)
    for (int j = region.begin[1]; j < region.end[1]; ++j)
      if (table_.cells[i * table_.axes[1].cells + j].meeting < 0) return false;
  return true;
}

void TableBuilder::markUnresolved(const Region& region, bool touching, bool coarse) {
  const bool meets = !coarse && proof_.meet();
  if (meets) table_.meetings.push_back({proof_.meetingOfA(), proof_.meetingOfB(), pair_});
  const auto last = static_cast<std::int32_t>(table_.meetings.size()) - 1;
  for (int i = region.begin[0]; i < region.end[0]; ++i) {
    for (int j = region.begin[1]; j < region.end[1]; ++j) {
      PairSeparationTable::Cell& cell = table_.cells[i * table_.axes[1].cells + j];
      cell.openPairs |= bit_;
      cell.touching = cell.touching || touching;
      cell.coarse = cell.coarse || coarse;
      if (meets && cell.meeting < 0) cell.meeting = last;
    }
  }
}

void TableBuilder::prove(int& work) {
  proof_.work = work;
  if (!probed_) {
    probed_ = true;
    worthwhile_ = !isMostlyOpen();
    const std::array<int, 2> all{std::min(motion_.turn(0), table_.axes[0].cells),
                                 std::min(motion_.turn(1), table_.axes[1].cells)};
    for (std::size_t pair = 0; pair < table_.pairs.size() && worthwhile_; ++pair)
      level_.push_back({{0, 0}, all, static_cast<std::int32_t>(pair)});
  }
  while (proof_.work > 0 && !proven()) {
    if (at_ == level_.size()) {
      level_.swap(next_);
      next_.clear();
      at_ = 0;
    }
    proveRegion(level_[at_++]);
  }
  work = proof_.work;
}

/// If the middle of an open cell is free by a gap, some of the cell is free.
void TableBuilder::startParts(const Region& region, double gap) {
  const bool shared = table_.pairs.size() > PairSeparationTable::kPairBits &&
                      static_cast<std::size_t>(pair_) + 1 >= PairSeparationTable::kPairBits;
  if (shared || !(gap > 0.0)) return;
  PartMask mask;
  mask.cell = region.begin[0] * table_.axes[1].cells + region.begin[1];
  mask.pair = pair_;
  if (table_.joints == 1) mask.open = 0x0101010101010101U;
  nextParts_.push_back({partsOf(region), {}, gap, pair_, static_cast<std::int32_t>(masks_.size())});
  masks_.push_back(mask);
}

/// The parts that points cannot reach from the middle within the gap; returns whether none is left
/// open.
bool TableBuilder::clearParts(const PartRegion& region) {
  constexpr int kParts = PairSeparationTable::kParts;
  std::uint64_t& mask = masks_[static_cast<std::size_t>(region.mask)].open;
  bool done = true;
  for (int i = region.parts.begin[0]; i < region.parts.end[0]; ++i) {
    for (int j = region.parts.begin[1]; j < region.parts.end[1]; ++j) {
      const std::uint64_t bit = std::uint64_t{1} << (i % kParts * kParts + j % kParts);
      if ((mask & bit) == 0) continue;
      if (motion_.travelTo(region.parts, i, j, region.levers) < region.gap)
        mask &= ~bit;
      else
        done = false;
    }
  }
  return done;
}

void TableBuilder::splitParts(const PartRegion& region) {
  for (int quarter = 0; quarter < 4; ++quarter) {
    PartRegion child = region;
    if (halve(quarter, child.parts.begin, child.parts.end)) nextParts_.push_back(child);
  }
}

void TableBuilder::proveParts(PartRegion& region) {
  const PartMask& mask = masks_[static_cast<std::size_t>(region.mask)];
  // Proving a part that another pair leaves open gains nothing.
  if (table_.cells[static_cast<std::size_t>(mask.cell)].touching) return;
  const bool whole = region.gap > 0.0;
  const bool last = region.parts.end[0] - region.parts.begin[0] <= kFewestParts;
  if (!whole && clearParts(region)) return;
  choose(region.pair);
  const Place place = motion_.placeOf(region.parts);
  if (whole) {
    region.levers = proof_.closeLevers(place);
    if (!(region.gap > kLeastGap * TableMotion::travel(place, region.levers))) return;
  } else {
    const double travel = TableMotion::travel(place, region.levers);
    const double contact = last ? travel + proof_.slack() : proof_.margin();
    const PairProof::Compared found = proof_.compare(place, contact, travel);
    if (found.touching) return;
    region.gap = found.gap;
  }
  if (clearParts(region)) return;
  region.gap = 0.0;
  if (!last) splitParts(region);
}

void TableBuilder::refine(int& work) {
  proof_.work = work;
  while (proof_.work > 0 && !refined()) {
    if (partAt_ == partLevel_.size()) {
      partLevel_.swap(nextParts_);
      nextParts_.clear();
      partAt_ = 0;
    }
    proveParts(partLevel_[partAt_++]);
  }
  work = proof_.work;
}

std::shared_ptr<const PairSeparationTable> TableBuilder::finish() {
  if (!worthwhile_) return nullptr;
  level_.erase(level_.begin(), level_.begin() + static_cast<std::ptrdiff_t>(at_));
  for (const std::vector<Region>* regions : {&level_, &next_}) {
    for (const Region& region : *regions) {
      choose(region.pair);
      markUnresolved(region, false, true);
    }
  }
  setParts(masks_, table_);
  repeatTurns();
  sum();
  return std::make_shared<const PairSeparationTable>(std::move(table_));
}

void TableBuilder::repeatTurns() {
  const int columns = table_.axes[1].cells;
  for (int i = 0; i < table_.axes[0].cells; ++i)
    for (int j = 0; j < columns; ++j)
      table_.cells[i * columns + j] =
          table_.cells[i % motion_.turn(0) * columns + j % motion_.turn(1)];
}

void TableBuilder::sum() {
  const int rows = table_.axes[0].cells;
  const int columns = table_.axes[1].cells;
  table_.open.assign(static_cast<std::size_t>(rows + 1) * (columns + 1), 0);
  for (int i = 0; i < rows; ++i) {
    std::uint32_t line = 0;
    for (int j = 0; j < columns; ++j) {
      line += table_.cells[i * columns + j].openPairs != 0 ? 1 : 0;
      table_.open[(i + 1) * (columns + 1) + j + 1] = table_.open[i * (columns + 1) + j + 1] + line;
    }
  }
}

}  // namespace swept::detail
