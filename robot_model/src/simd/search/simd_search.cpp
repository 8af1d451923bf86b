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

/// m. Intervals whose inflation is below this gain nothing from halving that the exact tier does
/// not do better.
constexpr float kFinestInflation = 1e-3F;
/// Halvings after the first block, and sub-intervals in one generation, at most.
constexpr int kMostGenerations = 6;
constexpr std::size_t kMostItems = 256;

void forgetOpen(SimdBlock& block) {
  for (const std::uint32_t pair : block.open) block.openLanes[pair] = block.finalLanes[pair] = 0;
  block.open.clear();
}

/// Suspects of one motion that the oracle is asked about, at most: each costs more than a block.
constexpr int kMostLikelyContacts = 4;
/// Points of a link that exact geometry is asked about, of those that seem to be in an obstacle.
constexpr std::int32_t kMostPoints = 2;

class MotionSearch {
 public:
  MotionSearch(SimdMotion& motion, ExactOracle& oracle, SimdGoal goal, SimdScratch& scratch)
      : model_(motion.model()), motion_(motion), oracle_(oracle), goal_(goal), scratch_(scratch) {
    for (const Row& row : scratch.bounds[0].acceleration)
      for (const float value : row.lane)
        answer_.acceleration = std::max(answer_.acceleration, value);
  }

  SimdAnswer run() {
    SimdBlock& block = scratch_.block;
    block.mode = SimdMode::Motion;
    for (auto* items : {&scratch_.next, &scratch_.rest}) items->clear();
    for (auto* pairs : {&scratch_.nextArena, &scratch_.restArena}) pairs->clear();
    forgetOpen(block);
    if (first()) return contact();
    collect();
    for (int generation = 0; !scratch_.next.empty() && !tooMany(); ++generation) {
      std::swap(scratch_.now, scratch_.next);
      std::swap(scratch_.arena, scratch_.nextArena);
      scratch_.next.clear();
      scratch_.nextArena.clear();
      forgetBehind(scratch_.now);
      last_ = generation + 1 >= kMostGenerations || scratch_.now.size() > kMostItems / 2 ||
              answer_.intervals >= scratch_.mostIntervals;
      for (std::size_t i = 0; i < scratch_.now.size() && !tooMany(); i += kLanes) {
        if (examine(i)) return contact();
        collect();
      }
    }
    if (tooMany()) {
      answer_.kind = SimdAnswer::Kind::TooMany;
      return answer_;
    }
    forgetBehind(scratch_.rest);
    if (!scratch_.rest.empty() && dividePairs(motion_, oracle_, goal_, scratch_, answer_))
      return contact();
    if (!scratch_.rest.empty()) {
      answer_.kind = SimdAnswer::Kind::Open;
    } else {
      const bool met = answer_.horizon <= 1.0F;
      answer_.kind = met ? SimdAnswer::Kind::Contact : SimdAnswer::Kind::Free;
    }
    return answer_;
  }

 private:
  SimdAnswer contact() {
    answer_.kind = SimdAnswer::Kind::Contact;
    return answer_;
  }

  bool tooMany() const {
    return scratch_.nextArena.size() + scratch_.restArena.size() > scratch_.mostWaiting;
  }

  double timeOf(int lane) const { return static_cast<double>(scratch_.block.time.lane[lane]); }

  void forgetBehind(std::vector<SimdScratch::Item>& items) const {
    std::erase_if(items, [this](const SimdScratch::Item& item) {
      return item.time - item.half >= answer_.horizon;
    });
  }

  /// Lanes that begin no earlier than a contact.
  std::uint32_t lanesBehind() const {
    const SimdBlock& block = scratch_.block;
    std::uint32_t lanes = 0;
    for (int lane = 0; lane < kLanes; ++lane)
      if (block.time.lane[lane] - block.half.lane[lane] >= answer_.horizon) lanes |= 1U << lane;
    return lanes;
  }

  /// Whether the search is over with this contact.
  bool decides(int lane) {
    answer_.horizon = std::min(answer_.horizon, scratch_.block.time.lane[lane]);
    return goal_ == SimdGoal::Verdict;
  }

  /// Walks until it is through or the oracle has confirmed a contact that decides. Otherwise the
  /// walk is repeated for what lies before the contact, without looking for more; and a claim that
  /// is not confirmed is not made a second time.
  template <typename Walk>
  bool walk(const Walk& walkAll) {
    SimdBlock& block = scratch_.block;
    block.likelyContact = {};
    block.contactLanes = lanesBehind();
    block.stopAtContact = contacts_;
    const std::uint32_t behind = block.contactLanes;
    if (walkAll()) {
      const int lane = std::countr_zero(block.contactLanes & ~behind);
      const bool confirmed = oracle_.isContact(block.contacts[lane], timeOf(lane));
      if (confirmed && decides(lane)) return true;
      contacts_ = confirmed;
      block.contactLanes = lanesBehind();
      block.stopAtContact = false;
      walkAll();
      return false;
    }
    if (!contacts_ || block.likelyContact.lane < 0 || likelyContacts_ == kMostLikelyContacts)
      return false;
    ++likelyContacts_;
    const bool confirmed =
        isInside(block.likelyContact) ||
        oracle_.look(block.likelyContact.pair, timeOf(block.likelyContact.lane), 0.0).kind ==
            ExactAnswer::Kind::Contact;
    return confirmed && decides(block.likelyContact.lane);
  }

  /// Some point of the link's surface in an obstacle.
  bool isInside(const LikelyContact& likelyContact) {
    if (model_.sources[likelyContact.pair].obstacle < 0) return false;
    const PointsInside points = pointsInside(model_, likelyContact, scratch_);
    for (std::int32_t i = 0; i < std::min(points.count, kMostPoints); ++i)
      if (oracle_.isInside(likelyContact.pair, points.index[i], timeOf(likelyContact.lane)))
        return true;
    return false;
  }

  /// All pairs on eight sub-intervals.
  bool first() {
    SimdBlock& block = scratch_.block;
    for (int lane = 0; lane < kLanes; ++lane) {
      block.time.lane[lane] = (2.0F * static_cast<float>(lane) + 1.0F) / (2.0F * kLanes);
      block.half.lane[lane] = 1.0F / (2.0F * kLanes);
    }
    answer_.intervals += kLanes;
    motion_.place(model_.allBodies);
    return walk([&] { return walkWorld(model_, scratch_) || walkSelf(model_, scratch_); });
  }

  /// Divides what the block left open, and hands on what dividing does not help.
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
    const float time = block.time.lane[lane];
    const float half = block.half.lane[lane];
    if (time - half >= answer_.horizon) return;
    const bool fine = last_ || 0.5F * half * half * answer_.acceleration < kFinestInflation;
    const std::size_t rest = scratch_.restArena.size();
    const std::size_t next = scratch_.nextArena.size();
    for (const std::uint32_t pair : block.open) {
      if ((block.openLanes[pair] >> lane & 1U) == 0) continue;
      const bool final = fine || (block.finalLanes[pair] >> lane & 1U) != 0;
      (final ? scratch_.restArena : scratch_.nextArena).push_back(pair);
    }
    if (scratch_.restArena.size() > rest)
      scratch_.rest.push_back({time, half, rest, scratch_.restArena.size() - rest});
    const std::size_t count = scratch_.nextArena.size() - next;
    if (count == 0) return;
    const float part = half / static_cast<float>(parts);
    for (int i = 0; i < parts; ++i) {
      const float middle = time - half + part * static_cast<float>(2 * i + 1);
      if (middle - part < answer_.horizon) scratch_.next.push_back({middle, part, next, count});
    }
  }

  /// Up to eight of the current sub-intervals, each with its own pairs.
  bool examine(std::size_t from) {
    SimdBlock& block = scratch_.block;
    const std::size_t count = std::min<std::size_t>(kLanes, scratch_.now.size() - from);
    scratch_.wanted.clear();
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      // Lanes not in use repeat the first, and nothing is asked of them.
      const SimdScratch::Item& item = scratch_.now[from + (lane < count ? lane : 0)];
      block.time.lane[lane] = item.time;
      block.half.lane[lane] = item.half;
      if (lane >= count) continue;
      for (std::size_t i = item.first; i < item.first + item.count; ++i) {
        const std::uint32_t pair = scratch_.arena[i];
        if (scratch_.wantedLanes[pair] == 0) scratch_.wanted.push_back(pair);
        scratch_.wantedLanes[pair] |= static_cast<std::uint8_t>(1U << lane);
      }
    }
    answer_.intervals += static_cast<int>(count);
    std::ranges::sort(scratch_.wanted);
    place();
    const bool contact = walk([&] { return askAll(); });
    for (const std::uint32_t pair : scratch_.wanted) scratch_.wantedLanes[pair] = 0;
    return contact;
  }

  bool askAll() {
    for (std::size_t i = 0; i < scratch_.wanted.size();)
      if (askAt(i)) return true;
    return false;
  }

  /// The pair at `i`, and those after it that are of the same geometry with the world.
  bool askAt(std::size_t& i) {
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
    return walkPairs(model_, source.geometry, scratch_.asked, scratch_);
  }

  /// Only the bodies that the wanted pairs hang on.
  void place() {
    scratch_.bodyWanted.assign(model_.bodies.size(), 0);
    const auto want = [&](int body) {
      // From the body upwards: what carries one that is wanted is wanted already.
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
    motion_.place(scratch_.bodies);
  }

  const SimdModel& model_;
  SimdMotion& motion_;
  ExactOracle& oracle_;
  const SimdGoal goal_;
  bool contacts_ = true;  ///< looked for
  SimdScratch& scratch_;
  SimdAnswer answer_;
  int likelyContacts_ = 0;
  bool last_ = false;
};

}  // namespace

SimdAnswer searchMotion(SimdMotion& motion, ExactOracle& oracle, SimdGoal goal,
                        SimdScratch& scratch) {
  return MotionSearch(motion, oracle, goal, scratch).run();
}

void searchStates(const SimdModel& model, SimdMode mode, SimdContacts contacts,
                  SimdScratch& scratch) {
  SimdBlock& block = scratch.block;
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

void takeOpen(int lane, SimdScratch& scratch) {
  const SimdBlock& block = scratch.block;
  scratch.restArena.clear();
  for (const std::uint32_t pair : block.open)
    if ((block.openLanes[pair] >> lane & 1U) != 0) scratch.restArena.push_back(pair);
}

}  // namespace swept::detail
