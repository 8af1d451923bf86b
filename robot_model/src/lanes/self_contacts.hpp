// SPDX-License-Identifier: BSD-3-Clause
// Balls inside two links that meet. Included once per instruction set.
#if defined(SWEPT_LANES_SELF_CONTACTS) == defined(HWY_TARGET_TOGGLE)
#ifdef SWEPT_LANES_SELF_CONTACTS
#undef SWEPT_LANES_SELF_CONTACTS
#else
#define SWEPT_LANES_SELF_CONTACTS
#endif

#include <algorithm>
#include <bit>

#include "lanes/f8.hpp"
#include "lanes/placed_ball.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {

/// The bodies of two links.
struct LinkStates {
  const LaneBodyState* a = nullptr;
  const LaneBodyState* b = nullptr;
};

/// Looks for contacts of two links, where the block asks for them.
class SelfContacts {
 public:
  SelfContacts(const LaneModel& model, LaneScratch& scratch, const LinkStates& states)
      : model_(model), scratch_(scratch), block_(scratch.block), states_(states) {}

  /// Looks at the largest balls inside two links, in the lane in which they are nearest.
  HWY_INLINE bool probe(std::uint32_t pair, const LaneNode& a, const Segment& atA,
                        const LaneNode& b, const Segment& atB, Lanes lanes) {
    if (!block_.stopAtContact) return false;
    const LaneModel::InnerBalls& ofA = model_.probesOf[a.geometry];
    const LaneModel::InnerBalls& ofB = model_.probesOf[b.geometry];
    if (ofA.count == 0 || ofB.count == 0) return false;
    const V3 between = atB.x - atA.x;
    const F8 squared = dot(between, between);
    const float near = kProbeShare * (a.radius + b.radius);
    lanes &= below(squared, set(near * near));
    if (lanes == 0) return false;
    const int lane = lowestLane(squared, lanes);
    const std::int32_t rowsA = std::min(ofA.count, kProbeRows);
    const std::int32_t rowsB = std::min(ofB.count, kProbeRows);
    V3 atRowA[kProbeRows];
    for (std::int32_t i = 0; i < rowsA; ++i)
      atRowA[i] = placedAt(*states_.a, lane, model_.probes[ofA.first + i]);
    for (std::int32_t j = 0; j < rowsB; ++j) {
      const LaneModel::Probes& eightB = model_.probes[ofB.first + j];
      Row centers[3];
      store3(placedAt(*states_.b, lane, eightB), centers);
      for (std::int32_t i = 0; i < rowsA; ++i) {
        const LaneModel::Probes& eightA = model_.probes[ofA.first + i];
        float meeting[3];
        if (anyMeets(atRowA[i], eightA, centers, eightB) &&
            meets(atRowA[i], eightA, centers, eightB, meeting))
          return claim(block_, pair, 1U << lane, set3(meeting), 0.0F);
      }
    }
    return false;
  }

  /// At a middle, two balls inside the links meet.
  bool touches(std::uint32_t pair, float insideA, const V3& atA, float insideB, const V3& atB,
               Lanes lanes) {
    if (!block_.stopAtContact) return false;
    // Either ball less what its position, and that of the point, may be off.
    const float ofA = insideA - 2.0F * scratch_.rounding;
    const float ofB = insideB - 2.0F * scratch_.rounding;
    if (!(ofA > 0.0F && ofB > 0.0F)) return false;
    const V3 between = atB - atA;
    lanes &= below(dot(between, between), set(kMeeting * (ofA + ofB) * (ofA + ofB)));
    // A point of the line between the centres that is in both balls, by the same share.
    const F8 share = set(ofA / (ofA + ofB));
    return lanes != 0 && claim(block_, pair, lanes, along(atA, share, between), 0.0F);
  }

 private:
  /// Rows of eight balls inside either link that are looked at.
  static constexpr std::int32_t kProbeRows = 2;
  /// Of the sum of the radii around two links: balls inside farther apart hardly meet.
  static constexpr float kProbeShare = 0.75F;

  /// Whether any two of eight by eight balls seem to meet, with no regard to roundings and with no
  /// branch: most often none do.
  HWY_INLINE static bool anyMeets(const V3& atA, const LaneModel::Probes& eightA,
                                  const Row (&centers)[3], const LaneModel::Probes& eightB) {
    const F8 insideA = load(eightA.inside);
    F8 least = set(1.0F);
    for (int k = 0; k < kLanes; ++k) {
      const V3 to = set3({centers[0].lane[k], centers[1].lane[k], centers[2].lane[k]}) - atA;
      const F8 reach = insideA + set(eightB.inside.lane[k]);
      least = smaller(least, subtractProduct(dot(to, to), reach, reach));
    }
    return below(least, set(0.0F)) != 0;
  }

  /// Whether any two of them do meet, and in which point, m.
  bool meets(const V3& atA, const LaneModel::Probes& eightA, const Row (&centers)[3],
             const LaneModel::Probes& eightB, float (&meeting)[3]) const {
    for (int k = 0; k < kLanes; ++k) {
      const V3 to = set3({centers[0].lane[k], centers[1].lane[k], centers[2].lane[k]}) - atA;
      const float inB = eightB.inside.lane[k] - 2.0F * scratch_.rounding;
      const F8 reach = load(eightA.inside) + set(inB - 2.0F * scratch_.rounding);
      const Lanes found = below(dot(to, to), set(kMeeting) * reach * reach);
      if (found == 0) continue;
      const int which = std::countr_zero(found);
      const float inA = eightA.inside.lane[which] - 2.0F * scratch_.rounding;
      if (!(inA > 0.0F && inB > 0.0F)) continue;
      Row point[3];
      store3(along(atA, set(inA / (inA + inB)), to), point);
      for (int i = 0; i < 3; ++i) meeting[i] = point[i].lane[which];
      return true;
    }
    return false;
  }

  const LaneModel& model_;
  LaneScratch& scratch_;
  LaneBlock& block_;
  const LinkStates& states_;
};

}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
