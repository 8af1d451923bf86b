// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "proof/confirmed_contacts.hpp"
#include "proof/proof_tier.hpp"
#include "simd/compile/simd_field.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

/// The result of exact geometry for a pair at one time.
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

/// Exact geometry for the SIMD tier, at one time of a motion. It adds confirmed contacts to the
/// search's ConfirmedContacts.
class ExactOracle {
 public:
  /// Whether a contact found in single precision is one.
  virtual bool isContact(const SimdContact& contact, double t) = 0;
  /// Whether a point of SimdHulls::inBody lies in the obstacle of the pair.
  virtual bool isInside(std::uint32_t pair, std::int32_t point, double t) = 0;
  virtual ExactAnswer look(std::uint32_t pair, double t, double half) = 0;
  /// Whether the pair's link stays apart, by the pair's margin, on [t - half, t + half] from all of
  /// the obstacle, a cloud, that is within `radius` (m) of the points x +- g. False: not proven.
  virtual bool staysApart(std::uint32_t pair, double t, double half, const MovingPoint& point,
                          double radius) = 0;

 protected:
  ~ExactOracle() = default;
};

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

  /// Expects all pairs to be open. Leaves `work` as it is if the motion does not fit single
  /// precision, or if too many pairs would have to wait.
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
