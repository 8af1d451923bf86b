// SPDX-License-Identifier: BSD-3-Clause
// Balls inside two links that meet. Included once per instruction set.
#if defined(SWEPT_SIMD_SELF_CONTACTS) == defined(HWY_TARGET_TOGGLE)
#ifdef SWEPT_SIMD_SELF_CONTACTS
#undef SWEPT_SIMD_SELF_CONTACTS
#else
#define SWEPT_SIMD_SELF_CONTACTS
#endif

#include <algorithm>
#include <bit>
#include <cstdint>

#include "simd/kernels/f8.hpp"
#include "simd/kernels/placed_ball.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {

/// The bodies of two links.
struct LinkStates {
  const SimdBodyState* a = nullptr;
  const SimdBodyState* b = nullptr;
};

/// Searches contacts of two links, if the block requests it.
class SelfContacts {
 public:
  SelfContacts(const SimdModel& model, SimdScratch& scratch, const LinkStates& states)
      : model_(model), scratch_(scratch), block_(scratch.block), states_(states) {}

  /// Tests balls inside two links, or points of them, in the lane in which they are nearest.
  HWY_INLINE bool probe(std::uint32_t pair, const SimdNode& a, const Segment& atA,
                        const SimdNode& b, const Segment& atB, Lanes lanes) {
    if (!block_.stopAtContact) return false;
    const V3 between = atB.x - atA.x;
    const F8 squared = dot(between, between);
    const float near = kProbeShare * (a.radius + b.radius);
    lanes &= below(squared, set(near * near));
    return lanes != 0 && probe(pair, a.geometry, b.geometry, lowestLane(squared, lanes));
  }

  /// The same in one lane.
  bool probe(std::uint32_t pair, std::int32_t geometryA, std::int32_t geometryB, int lane) {
    const SimdModel::InnerBalls& ofA = model_.meetingRowsOf[geometryA];
    const SimdModel::InnerBalls& ofB = model_.meetingRowsOf[geometryB];
    if (ofA.count == 0 || ofB.count == 0) return false;
    const SimdModel::Probes& aroundA = model_.meetingRows[ofA.first];
    const SimdModel::Probes& aroundB = model_.meetingRows[ofB.first];
    const V3 atA = placedAt(*states_.a, lane, aroundA);
    Row centers[3];
    store3(placedAt(*states_.b, lane, aroundB), centers);
    const F8 radiusA = load(aroundA.inside);
    for (std::int32_t k = 0; k < ofB.count; ++k) {
      const V3 to = set3({centers[0].lane[k], centers[1].lane[k], centers[2].lane[k]}) - atA;
      const F8 reach = radiusA + set(aroundB.inside.lane[k]);
      const Lanes near = below(dot(to, to), reach * reach) & (kAllLanes >> (kLanes - ofA.count));
      if (near != 0 && probeRows(pair, ofA.first + 1, near, ofB.first + 1 + k, lane)) return true;
    }
    return false;
  }

  /// At the middle of a sub-interval, two balls inside the links meet.
  bool touches(std::uint32_t pair, float insideA, const V3& atA, float insideB, const V3& atB,
               Lanes lanes) {
    if (!block_.stopAtContact) return false;
    // Either ball reduced by the rounding of its position, and of the point.
    const float ofA = insideA - 2.0F * scratch_.rounding;
    const float ofB = insideB - 2.0F * scratch_.rounding;
    if (!(ofA > 0.0F && ofB > 0.0F)) return false;
    const V3 between = atB - atA;
    lanes &= below(dot(between, between), set(kMeeting * (ofA + ofB) * (ofA + ofB)));
    // A point on the line between the centres that is in both balls, by the same share.
    const F8 share = set(ofA / (ofA + ofB));
    return lanes != 0 && claim(block_, pair, lanes, along(atA, share, between), 0.0F);
  }

 private:
  /// Relative to the sum of the radii around two links: balls inside links farther apart hardly
  /// meet.
  static constexpr float kProbeShare = 0.75F;

  /// A row of eight of one link with some rows of the other's.
  bool probeRows(std::uint32_t pair, std::int32_t firstA, Lanes rowsA, std::int32_t rowB,
                 int lane) {
    const SimdModel::Probes& eightB = model_.meetingRows[rowB];
    Row centers[3];
    store3(placedAt(*states_.b, lane, eightB), centers);
    for (; rowsA != 0; rowsA &= rowsA - 1) {
      const SimdModel::Probes& eightA = model_.meetingRows[firstA + std::countr_zero(rowsA)];
      const V3 atA = placedAt(*states_.a, lane, eightA);
      float meeting[3];
      if (anyMeets(atA, eightA, centers, eightB) && meets(atA, eightA, centers, eightB, meeting))
        return claim(block_, pair, 1U << lane, set3(meeting), 0.0F);
    }
    return false;
  }

  /// Whether any two of eight by eight balls seem to meet, ignoring roundings and without branches:
  /// most often none do.
  HWY_INLINE static bool anyMeets(const V3& atA, const SimdModel::Probes& eightA,
                                  const Row (&centers)[3], const SimdModel::Probes& eightB) {
    const F8 insideA = load(eightA.inside);
    F8 least = set(1.0F);
    for (int k = 0; k < kLanes; ++k) {
      const V3 to = set3({centers[0].lane[k], centers[1].lane[k], centers[2].lane[k]}) - atA;
      const F8 reach = insideA + set(eightB.inside.lane[k]);
      least = smaller(least, subtractProduct(dot(to, to), reach, reach));
    }
    return below(least, set(0.0F)) != 0;
  }

  /// Whether any two of them do meet, and at which point, m.
  ///
  /// Lemma: either centre is off by at most the rounding. So balls whose centres are nearer than
  /// the sum of the radii minus 4 roundings have a common point, and so have a ball and a point,
  /// which is a ball of radius 0. A motion's witness must be in both links by more than roundings;
  /// there, points do not count.
  bool meets(const V3& atA, const SimdModel::Probes& eightA, const Row (&centers)[3],
             const SimdModel::Probes& eightB, float (&meeting)[3]) const {
    for (int k = 0; k < kLanes; ++k) {
      const V3 to = set3({centers[0].lane[k], centers[1].lane[k], centers[2].lane[k]}) - atA;
      const float inB = eightB.inside.lane[k] - 2.0F * scratch_.rounding;
      const F8 reach = load(eightA.inside) + set(inB - 2.0F * scratch_.rounding);
      const Lanes found =
          below(dot(to, to), set(kMeeting) * reach * reach) & above(reach, set(0.0F));
      if (found == 0) continue;
      const int which = std::countr_zero(found);
      const float inA = eightA.inside.lane[which] - 2.0F * scratch_.rounding;
      if (block_.mode == SimdMode::Motion && !(inA > 0.0F && inB > 0.0F)) continue;
      const float share = std::clamp(inA / (inA + inB), 0.0F, 1.0F);
      Row point[3];
      store3(along(atA, set(share), to), point);
      for (int i = 0; i < 3; ++i) meeting[i] = point[i].lane[which];
      return true;
    }
    return false;
  }

  const SimdModel& model_;
  SimdScratch& scratch_;
  SimdBlock& block_;
  const LinkStates& states_;
};

}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
