// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "proof/confirmed_contacts.hpp"
#include "proof/proof_tier.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/exact_oracle.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// Tier 1: eight sub-intervals at once, in single precision.
class SimdTier final : public ProofTier {
 public:
  /// `mostIntervals`: most sub-intervals to examine. Adds those that it examines to `effort`. All
  /// arguments must outlive this.
  SimdTier(SimdMotion& motion, ExactOracle& oracle, const ConfirmedContacts& contacts,
           int mostIntervals, SimdScratch& scratch, Effort& effort)
      : motion_(motion),
        oracle_(oracle),
        contacts_(contacts),
        mostIntervals_(mostIntervals),
        scratch_(scratch),
        effort_(effort) {}

  /// Where not all pairs are open, those that are must be pairs with the world, on intervals of
  /// float-exact middles. Leaves `work` as it is if the motion does not fit single precision; all
  /// of it stays open if too many pairs would have to wait.
  void prove(ProofWork& work) override;

 private:
  SimdMotion& motion_;
  ExactOracle& oracle_;
  const ConfirmedContacts& contacts_;
  const int mostIntervals_;
  SimdScratch& scratch_;
  Effort& effort_;
};

/// How a search of states treats contacts.
enum class SimdContacts : std::uint8_t {
  Sought,   ///< the lane in which one shows is not looked at any more
  Ignored,  ///< pairs that are in contact are left open, as all that is not proven apart
};

/// Examines states: the motion's begin in all lanes (SimdMode::State), or eight states (States).
/// The result is in scratch.block: a lane is free if it is not in `contactLanes` and has no open
/// pairs. With SimdMode::State the search ends at the first contact, in any lane, and leaves pairs
/// of two links open in the first lane only.
void searchStates(const SimdModel& model, SimdMode mode, SimdContacts contacts,
                  SimdScratch& scratch);
/// Sets `pairs` to the open pairs of a lane.
void takeOpen(int lane, const SimdBlock& block, std::vector<std::uint32_t>& pairs);

}  // namespace swept::detail
