// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "proof/confirmed_contacts.hpp"
#include "proof/proof_tier.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// What exact geometry says of a pair at one time.
struct ExactAnswer {
  enum class Kind : std::uint8_t {
    Open,
    Contact,  ///< at t
    Apart,    ///< on all of [t - half, t + half]
  };
  Kind kind = Kind::Open;
  bool directed = false;  ///< `towards` is known
  float towards[3] = {};  ///< unit, model frame: from the first body to the second
};

/// Exact geometry at one time of a motion, which the SIMD tier asks. It keeps the contacts that it
/// confirms in the search's ConfirmedContacts.
class ExactOracle {
 public:
  /// Whether what single precision takes for a contact is one.
  virtual bool isContact(const SimdContact& contact, double t) = 0;
  /// Whether a point of SimdHulls::inBody lies in the obstacle of the pair.
  virtual bool isInside(std::uint32_t pair, std::int32_t point, double t) = 0;
  virtual ExactAnswer look(std::uint32_t pair, double t, double half) = 0;

 protected:
  ~ExactOracle() = default;
};

/// Tier 1: eight sub-intervals at once, in single precision.
class SimdTier final : public ProofTier {
 public:
  /// `mostIntervals`: sub-intervals to examine. Adds those that it examines to `effort`. All have
  /// to outlive this.
  SimdTier(SimdMotion& motion, ExactOracle& oracle, const ConfirmedContacts& contacts,
           int mostIntervals, SimdScratch& scratch, Effort& effort)
      : motion_(motion),
        oracle_(oracle),
        contacts_(contacts),
        mostIntervals_(mostIntervals),
        scratch_(scratch),
        effort_(effort) {}

  /// Of a motion with all pairs open. Says nothing where that does not fit single precision, and
  /// where too many pairs would have to wait.
  void prove(ProofWork& work) override;

 private:
  SimdMotion& motion_;
  ExactOracle& oracle_;
  const ConfirmedContacts& contacts_;
  const int mostIntervals_;
  SimdScratch& scratch_;
  Effort& effort_;
};

/// What a search of states does about contacts.
enum class SimdContacts : std::uint8_t {
  Sought,   ///< the lane in which one shows is not looked at any more
  Ignored,  ///< pairs that are in contact are left open, as all that is not proven apart
};

/// Of states: of the motion's begin in all lanes (SimdMode::State), or of eight (States). What is
/// found is in scratch.block: a lane is free if it is neither in `contactLanes` nor has open pairs.
/// Under SimdMode::State the search ends with the first contact, in any lane, and pairs of two
/// links are left open in the first lane alone.
void searchStates(const SimdModel& model, SimdMode mode, SimdContacts contacts,
                  SimdScratch& scratch);
/// `pairs` becomes the pairs that are open in a lane.
void takeOpen(int lane, const SimdBlock& block, std::vector<std::uint32_t>& pairs);

}  // namespace swept::detail
