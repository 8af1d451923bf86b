// SPDX-License-Identifier: BSD-3-Clause
#include "simd/search/simd_search.hpp"

#include <algorithm>
#include <bit>

#include "simd/kernels/link_points.hpp"
#include "simd/kernels/self_walk.hpp"
#include "simd/kernels/simd_kinematics.hpp"
#include "simd/kernels/world_walk.hpp"
#include "simd/search/simd_division.hpp"

namespace swept::detail {

namespace {

/// m. Inflation below which halving gains nothing that the exact tier does not do better.
constexpr float kFinestInflation = 1e-3F;
/// Most halvings after the first block, and most sub-intervals in one level of these.
constexpr int kMostLevels = 6;
constexpr std::size_t kMostIntervals = 256;

void forgetOpen(SimdBlock& block) {
  for (const std::uint32_t pair : block.open) block.openLanes[pair] = block.finalLanes[pair] = 0;
  block.open.clear();
}

/// Most likely contacts of one motion to ask the oracle about. Each costs more than a block.
constexpr int kMostLikelyContacts = 4;
/// Most points of a link to ask exact geometry about, of those that seem to be in an obstacle.
constexpr std::int32_t kMostPoints = 2;

class MotionSearch {
 public:
  explicit MotionSearch(SimdSearch& search)
      : search_(search),
        model_(search.motion.model()),
        oracle_(search.oracle),
        contacts_(search.contacts),
        work_(search.work),
        scratch_(search.scratch) {}

  void run() {
    SimdBlock& block = scratch_.block;
    block.mode = SimdMode::Motion;
    search_.ofChange = !work_.everything;
    work_.next.clear();
    if (search_.ofChange) std::swap(work_.next, work_.open);
    work_.open.clear();
    work_.everything = true;
    forgetOpen(block);
    if (!search_.ofChange) {
      if (first()) return;
      collect();
    } else if (!scratch_.curved) {
      search_.motion.bound();
    }
    for (int level = 0; !work_.next.intervals.empty() && !tooMany(); ++level) {
      std::swap(work_.now, work_.next);
      work_.next.clear();
      forgetBehind(work_.now);
      const std::size_t count = work_.now.intervals.size();
      last_ = level + 1 >= kMostLevels || count > kMostIntervals / 2 || search_.isSpent();
      for (std::size_t i = 0; i < count && !tooMany(); i += kLanes) {
        if (examine(i)) return;
        collect();
      }
    }
    if (tooMany()) return;
    forgetBehind(work_.open);
    if (!work_.open.intervals.empty() && dividePairs(search_)) return;
    work_.everything = false;
    if (work_.open.intervals.empty()) work_.provenUntil = std::min(contacts_.horizon(), 1.0);
  }

 private:
  bool tooMany() const { return work_.next.pairs.size() + work_.open.pairs.size() > kMostWaiting; }

  double timeOf(int lane) const { return static_cast<double>(scratch_.block.time.lane[lane]); }
  double halfOf(int lane) const { return static_cast<double>(scratch_.block.half.lane[lane]); }

  void forgetBehind(OpenWork& work) const {
    std::erase_if(work.intervals, [this](const OpenInterval& interval) {
      return interval.begin >= contacts_.horizon();
    });
  }

  /// Lanes that begin at a contact or later.
  std::uint32_t lanesBehind() const {
    std::uint32_t lanes = 0;
    if (!contacts_.any()) return lanes;
    for (int lane = 0; lane < kLanes; ++lane)
      if (timeOf(lane) - halfOf(lane) >= contacts_.horizon()) lanes |= 1U << lane;
    return lanes;
  }

  /// Walks until the end, or until the oracle confirms a contact that settles the search. After any
  /// other claim it walks again, for the time before the contact, and seeks no more contacts in
  /// this block. So a claim that is not confirmed is not made twice.
  template <typename Walk>
  bool walk(const Walk& walkAll) {
    SimdBlock& block = scratch_.block;
    block.likelyContact = {};
    block.contactLanes = lanesBehind();
    block.stopAtContact = seeksContacts_;
    const std::uint32_t behind = block.contactLanes;
    if (walkAll()) {
      const int lane = std::countr_zero(block.contactLanes & ~behind);
      seeksContacts_ = oracle_.isContact(block.contacts[lane], timeOf(lane));
      if (contacts_.settle()) return true;
      block.contactLanes = lanesBehind();
      block.stopAtContact = false;
      walkAll();
      return false;
    }
    if (!seeksContacts_ || block.likelyContact.lane < 0 || likelyContacts_ == kMostLikelyContacts)
      return false;
    ++likelyContacts_;
    if (!isInside(block.likelyContact))
      oracle_.look(block.likelyContact.pair, timeOf(block.likelyContact.lane), 0.0);
    return contacts_.settle();
  }

  /// Whether a point of the link's surface is in an obstacle.
  bool isInside(const LikelyContact& likelyContact) {
    if (model_.sources[likelyContact.pair].obstacle < 0) return false;
    const PointsInside points = pointsInside(model_, likelyContact, scratch_);
    for (std::int32_t i = 0; i < std::min(points.count, kMostPoints); ++i)
      if (oracle_.isInside(likelyContact.pair, points.index[i], timeOf(likelyContact.lane)))
        return true;
    return false;
  }

  /// Examines all pairs on eight sub-intervals.
  bool first() {
    search_.examined += kLanes;
    search_.motion.placeEighths();
    return walk([&] {
      if (scratch_.block.stopAtContact && lookAtWorld(model_, scratch_)) return true;
      search_.motion.setMoving();
      if (walkWorld(model_, scratch_)) return true;
      search_.motion.boundLinks();
      return walkSelf(model_, scratch_);
    });
  }

  /// Divides the block's open intervals. Leaves those that dividing does not help to the next step.
  void collect() {
    SimdBlock& block = scratch_.block;
    if (block.open.empty()) return;
    std::uint32_t failed = 0;
    for (const std::uint32_t pair : block.open) failed |= block.openLanes[pair];
    const int parts = 2 * std::popcount(failed) <= kLanes / 2 ? 4 : 2;
    for (std::uint32_t left = failed; left != 0; left &= left - 1)
      collectLane(std::countr_zero(left), parts);
    forgetOpen(block);
  }

  void collectLane(int lane, int parts) {
    const SimdBlock& block = scratch_.block;
    const double begin = timeOf(lane) - halfOf(lane);
    const double end = timeOf(lane) + halfOf(lane);
    if (begin >= contacts_.horizon()) return;
    const bool fine = last_ || search_.inflation(block.half.lane[lane]) < kFinestInflation;
    OpenWork& open = work_.open;
    OpenWork& next = work_.next;
    const std::size_t firstOpen = open.pairs.size();
    const std::size_t firstNext = next.pairs.size();
    for (const std::uint32_t pair : block.open) {
      if ((block.openLanes[pair] >> lane & 1U) == 0) continue;
      const bool final = fine || (block.finalLanes[pair] >> lane & 1U) != 0;
      (final ? open : next).pairs.push_back(pair);
    }
    if (open.pairs.size() > firstOpen)
      open.intervals.push_back({begin, end, firstOpen, open.pairs.size() - firstOpen});
    const std::size_t count = next.pairs.size() - firstNext;
    if (count == 0) return;
    const double length = (end - begin) / parts;
    for (int i = 0; i < parts; ++i) {
      const double at = begin + i * length;
      if (at < contacts_.horizon()) next.intervals.push_back({at, at + length, firstNext, count});
    }
  }

  /// Examines up to eight of the current sub-intervals, each with its own pairs.
  bool examine(std::size_t from) {
    SimdBlock& block = scratch_.block;
    const std::vector<OpenInterval>& intervals = work_.now.intervals;
    const std::size_t count = std::min<std::size_t>(kLanes, intervals.size() - from);
    scratch_.wanted.clear();
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // Unused lanes repeat the first, and have no pairs.
      const OpenInterval& interval = intervals[from + (lane < count ? lane : 0)];
      block.time.lane[lane] = static_cast<float>(interval.middle());
      block.half.lane[lane] = static_cast<float>(interval.half());
      if (lane >= count) continue;
      for (const std::uint32_t pair : work_.now.pairsOf(interval)) {
        if (scratch_.wantedLanes[pair] == 0) scratch_.wanted.push_back(pair);
        scratch_.wantedLanes[pair] |= static_cast<std::uint8_t>(1U << lane);
      }
    }
    search_.examined += static_cast<int>(count);
    std::ranges::sort(scratch_.wanted);
    wantBodies();
    const bool looks = search_.ofChange && seeksContacts_;
    if (looks) {
      search_.motion.placeFrames(scratch_.bodies);
    } else {
      search_.motion.place(scratch_.bodies);
    }
    bool moving = !looks;
    const bool contact = walk([&] {
      if (looks && block.stopAtContact && lookAtAll()) return true;
      if (!moving) search_.motion.setVelocities(scratch_.bodies);
      moving = true;
      return askAll(looks);
    });
    for (const std::uint32_t pair : scratch_.wanted) scratch_.wantedLanes[pair] = 0;
    return contact;
  }

  bool askAll(bool looked) {
    for (std::size_t i = 0; i < scratch_.wanted.size();)
      if (askAt(i, looked)) return true;
    return false;
  }

  /// The outermost links first, where most contacts are. All pairs are with the world.
  bool lookAtAll() {
    for (std::size_t last = scratch_.wanted.size(); last > 0;) {
      const int geometry = model_.sources[scratch_.wanted[last - 1]].geometry;
      scratch_.asked.clear();
      for (; last > 0 && model_.sources[scratch_.wanted[last - 1]].geometry == geometry; --last) {
        const std::uint32_t pair = scratch_.wanted[last - 1];
        scratch_.asked.push_back({model_.sources[pair].obstacle, scratch_.wantedLanes[pair]});
      }
      if (lookAtPairs(model_, geometry, scratch_.asked, scratch_)) return true;
    }
    return false;
  }

  /// Asks about the pair at `i` and those after it that have the same geometry and are with the
  /// world.
  bool askAt(std::size_t& i, bool looked) {
    const std::uint32_t pair = scratch_.wanted[i];
    const SimdPairSource& source = model_.sources[pair];
    if (source.obstacle < 0) {
      ++i;
      return walkPair(model_, pair, scratch_.wantedLanes[pair], scratch_);
    }
    scratch_.asked.clear();
    for (; i < scratch_.wanted.size(); ++i) {
      const SimdPairSource& next = model_.sources[scratch_.wanted[i]];
      if (next.obstacle < 0 || next.geometry != source.geometry) break;
      scratch_.asked.push_back({next.obstacle, scratch_.wantedLanes[scratch_.wanted[i]]});
    }
    return walkPairs(model_, source.geometry, scratch_.asked, scratch_, looked);
  }

  /// Only the bodies that carry the wanted pairs.
  void wantBodies() {
    scratch_.bodyWanted.assign(model_.bodies.size(), 0);
    const auto want = [&](int body) {
      // From the body upwards: the ancestors of a wanted body are wanted already.
      const std::vector<int>& path = model_.ancestors[body];
      for (std::size_t i = path.size(); i-- > 0 && scratch_.bodyWanted[path[i]] == 0;)
        scratch_.bodyWanted[path[i]] = 1;
    };
    for (const std::uint32_t pair : scratch_.wanted) {
      const SimdPairSource& source = model_.sources[pair];
      want(model_.geometryBody[source.geometry]);
      if (source.obstacle < 0) want(model_.geometryBody[source.other]);
    }
    scratch_.bodies.clear();
    for (const int body : model_.allBodies)
      if (scratch_.bodyWanted[body] != 0) scratch_.bodies.push_back(body);
  }

  SimdSearch& search_;
  const SimdModel& model_;
  ExactOracle& oracle_;
  const ConfirmedContacts& contacts_;
  ProofWork& work_;
  SimdScratch& scratch_;
  bool seeksContacts_ = true;
  int likelyContacts_ = 0;
  bool last_ = false;
};

}  // namespace

void SimdTier::prove(ProofWork& work) {
  if (!motion_.model().usable || mostIntervals_ <= 0 || !motion_.compile()) return;
  SimdSearch search{.motion = motion_,
                    .oracle = oracle_,
                    .contacts = contacts_,
                    .work = work,
                    .scratch = scratch_,
                    .mostIntervals = mostIntervals_};
  scratch_.oracle = &oracle_;
  MotionSearch(search).run();
  scratch_.oracle = nullptr;
  effort_.lanes += search.examined;
}

void searchStates(const SimdModel& model, SimdMode mode, SimdContacts contacts,
                  SimdScratch& scratch) {
  SimdBlock& block = scratch.block;
  scratch.oracle = nullptr;  // a search that was left by an exception has not done so
  forgetOpen(block);
  block.mode = mode;
  block.given = mode == SimdMode::States;
  block.stopAtContact = contacts == SimdContacts::Sought;
  block.contactLanes = 0;
  block.likelyContact = {};
  block.time = Row{};
  block.half = Row{};
  placeBodies(model, scratch.motion, model.allBodies, block);
  if (!walkWorld(model, scratch)) walkSelf(model, scratch);
}

void takeOpen(int lane, const SimdBlock& block, std::vector<std::uint32_t>& pairs) {
  pairs.clear();
  for (const std::uint32_t pair : block.open)
    if ((block.openLanes[pair] >> lane & 1U) != 0) pairs.push_back(pair);
}

}  // namespace swept::detail
