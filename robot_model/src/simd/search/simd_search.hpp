// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "simd/compile/simd_model.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/kernels/simd_scratch.hpp"

namespace swept::detail {

struct SimdAnswer {
  enum class Kind : std::uint8_t {
    Free,     ///< all pairs, on all of [0, 1]
    Contact,  ///< the oracle said so; with SimdGoal::Prefix, and all before it is proven
    Open,     ///< scratch.rest is what is left
    TooMany,  ///< pairs would have to wait: nothing is known of those not in contact
  };
  Kind kind = Kind::Open;
  /// Of the earliest contact that the oracle confirmed; what begins there or later is not in
  /// `rest`.
  float horizon = std::numeric_limits<float>::infinity();
  int intervals = 0;          ///< sub-intervals examined
  float acceleration = 0.0F;  ///< m per unit t squared, bounds that of all ball centres
};

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

/// Exact geometry, asked by the lane tier.
class ExactOracle {
 public:
  /// Whether what the lanes point at is a contact.
  virtual bool isContact(const SimdContact& contact, double t) = 0;
  /// Whether a point of SimdHulls::inBody lies in the obstacle of the pair.
  virtual bool isInside(std::uint32_t pair, std::int32_t point, double t) = 0;
  virtual ExactAnswer look(std::uint32_t pair, double t, double half) = 0;

 protected:
  ~ExactOracle() = default;
};

/// What a search of a motion is after.
enum class SimdGoal : std::uint8_t {
  Verdict,  ///< the first contact that shows ends it
  Prefix,   ///< all that lies before the earliest contact
};

/// What a search of states does about contacts.
enum class SimdContacts : std::uint8_t {
  Sought,   ///< the lane in which one shows is not looked at any more
  Ignored,  ///< pairs that are in contact are left open, as all that is not proven apart
};

/// Of a motion that is compiled.
SimdAnswer searchMotion(SimdMotion& motion, ExactOracle& oracle, SimdGoal goal,
                        SimdScratch& scratch);
/// Of states: of the motion's begin in all lanes (SimdMode::State), or of eight (States). What is
/// found is in scratch.block: a lane is free if it is neither in `contactLanes` nor has open pairs.
/// Under SimdMode::State the search ends with the first contact, in any lane, and pairs of two
/// links are left open in the first lane alone.
void searchStates(const SimdModel& model, SimdMode mode, SimdContacts contacts,
                  SimdScratch& scratch);
/// Puts the open pairs of a lane into scratch.restArena.
void takeOpen(int lane, SimdScratch& scratch);

}  // namespace swept::detail
